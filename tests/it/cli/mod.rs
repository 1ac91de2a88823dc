//! The program as its users call it.

mod calls;
mod escapes;
mod readme;
