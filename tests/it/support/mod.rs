//! What several tests use.

pub mod average_face;
pub mod chance;
pub mod discs;
pub mod faulty_disk;
pub mod golden_picture;
pub mod inked;
pub mod studio_bench;
pub mod test_data;
pub mod two_clips;
