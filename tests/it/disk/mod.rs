//! Files in and out: saves that are cut off, links, pipes and devices.

mod commit;
mod doors;
