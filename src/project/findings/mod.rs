//! The findings of a project: what is missing, odd or wrong, and where its times and ratios deserve a look.

mod check;
mod doubts;

pub use check::{Finding, check, check_quality};
pub use doubts::{Concern, Doubt};
