//! The studio: projects, clips and timelines on a terminal, edited by keys.
//!
//! The way of a key: `app::terminal` reads it, the key table (`app::keys`) turns it into an `Action`, and the stack of
//! screens (`app::stack`) carries it out: the top screen takes it or passes it on. Each screen (`screens`) has its state,
//! its actions and its drawing, and there is no screen without what it needs. Work that takes time is a `Job` that runs in
//! a thread and comes back to the stack. The studio owns no project data: every edit is a change of the project.

mod app;
mod player;
mod screens;
mod widgets;

pub use app::aligner::Aligner;
pub use app::colours::Colours;
pub use app::export::{ExportRequest, Exporter, Progress, export};
pub use app::keys::{Place, key_list};
pub use app::lane::Lane;
pub use app::project::{OpenProject, SharedProject};
pub use app::run::run;
pub use app::shell::{Hear, Message, Shell};
pub use app::stack::{Report, SharedEditor};
pub use app::studio::Studio;
pub use player::{Caption, Played, Player, Show, play, play_live};
pub use screens::face::desk::FaceDesk;
pub use screens::face::page::FaceScreen;
pub use screens::tapping::TappingScreen;
pub use screens::tapping::clock::{Phase, Tapping};
