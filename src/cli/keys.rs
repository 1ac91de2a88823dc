//! `lianpu keys`.

use std::io::Write;

use super::print::say;
use crate::disk::Result;
use crate::studio::key_list;

/// Print the keys of the studio and of the player, place by place.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {}

/// Prints the keys.
pub(crate) fn run(_: &Args, out: &mut dyn Write) -> Result<()> {
    say(out, key_list())
}
