//! The tests of the rooms, a module a room, in one program: linking takes longer than testing. Tests that drive a terminal
//! or a browser have programs of their own.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

mod aam;
mod calibration;
mod cli;
mod disk;
mod export;
mod face;
mod figure;
mod forms;
mod geometry;
mod layers;
mod photo;
mod project;
mod ratios;
mod script;
mod speech;
mod studio;
mod support;
mod timeline;
mod timing;
mod track;
