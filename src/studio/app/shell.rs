//! What all screens share and no project has: the message at the foot, how sound is shown, what is to be heard.

use std::sync::{Arc, Mutex};

use super::aligner::{Aligner, Aligning};
use super::colours::Colours;
use super::export::Exporter;
use super::heard::SoundView;
use super::wording;
use crate::disk::Fault;
use crate::media::Sound;

/// What all screens share.
pub struct Shell {
    /// The message at the foot.
    pub message: Option<Message>,
    /// What is being waited for.
    pub busy: Option<String>,
    /// What the terminal can show.
    pub colours: Colours,
    /// How sound is shown.
    pub view: SoundView,
    /// Whether the pitch of the voice is shown.
    pub tone: bool,
    /// Whether videos are shown beside drawings.
    pub shows_video: bool,
    /// The seconds by which a tap comes after the sound, once that was measured.
    pub latency: Option<f64>,
    /// What is to be heard, until the player has taken it.
    pub hear: Option<Hear>,
    /// Whether there is a player for sound on this side of the connection.
    pub can_hear: bool,
    /// Whether it was said that playing is silent.
    pub said_silent: bool,
    /// Whether the studio is to be left.
    pub leaving: bool,
    /// Whether the whole screen is to be drawn anew.
    pub redraw: bool,
    /// Makes exports, one at a time.
    pub exporter: Arc<Mutex<Exporter>>,
    /// Finds times.
    pub aligner: Aligner,
    /// The search for times that is under way: one at a time, of whichever project.
    pub aligning: Option<Aligning>,
}

/// Something to be heard, or silence. Times are in seconds of the sound; a speed of 1 is as it was spoken.
#[derive(Debug, Clone)]
pub enum Hear {
    /// A sound from a time on.
    Clip {
        /// The sound; silence where there is none.
        sound: Option<Arc<Sound>>,
        /// Seconds.
        from: f64,
        /// The speed.
        speed: f64,
    },
    /// Nothing yet: the sound that will be heard next, to be made ready.
    Soon {
        /// The sound; silence where there is none.
        sound: Option<Arc<Sound>>,
        /// Seconds.
        from: f64,
        /// The speed.
        speed: f64,
    },
    /// Clicks at these times.
    Clicks(Vec<f64>),
    /// Nothing more.
    Nothing,
}

/// A message at the foot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// Its text.
    pub text: String,
    /// Whether something could not be done.
    pub is_fault: bool,
}

impl Shell {
    /// The state of a studio that was just opened.
    #[must_use]
    pub(crate) fn new(colours: Colours, exporter: Exporter) -> Self {
        Self {
            message: None,
            busy: None,
            colours,
            view: SoundView::default(),
            tone: false,
            shows_video: false,
            latency: None,
            hear: None,
            can_hear: false,
            said_silent: false,
            leaving: false,
            redraw: false,
            exporter: Arc::new(Mutex::new(exporter)),
            aligner: Aligner::default(),
            aligning: None,
        }
    }

    /// Shows a message.
    pub(crate) fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), is_fault: false });
    }

    /// Shows that something could not be done, and what to do.
    pub(crate) fn refuse(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), is_fault: true });
    }

    /// Shows a fault in one line: what went wrong, and what to do.
    pub(crate) fn say_fault(&mut self, fault: &Fault) {
        self.refuse(wording::in_a_line(fault));
    }
}
