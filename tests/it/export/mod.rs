//! Exports: their frames, parts and manifests.

mod frames;
mod merge;
mod parts;
