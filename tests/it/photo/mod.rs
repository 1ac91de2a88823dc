//! Photos read, and the stages of the search in them.

mod files;
mod stages;
