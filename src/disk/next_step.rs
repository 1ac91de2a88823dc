//! The steps that a message can advise, named so that every face words them for its own users: the command line as
//! commands and flags, the studio as keys, a program that uses the library as it likes.

use std::fmt;

/// A piece of work that the program does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Task {
    /// Finding when each syllable is spoken.
    Align,
    /// Learning a person's seven emotions from photos.
    Calibrate,
    /// Converting a timing file, a ratio record or an annotation.
    Convert,
    /// Exporting projects.
    Export,
    /// Finding the points of a face in its photo.
    FindFace,
    /// Joining the parts of a divided export.
    Merge,
    /// Making a project.
    New,
    /// Opening a project in the studio.
    Open,
    /// Following the face in a video.
    Track,
    /// Training an active appearance model.
    TrainModel,
}

/// An input or a choice of a [`Task`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Setting {
    /// Positions of both eyes, mouth and chin in a photo.
    Anchors,
    /// A clip by its name.
    Clip,
    /// A face by its name, or the folder of one.
    Face,
    /// The format to write.
    Format,
    /// The frames to write.
    Frames,
    /// The method of tracking.
    Method,
    /// The neutral photo.
    Neutral,
    /// The frame of a video that is the neutral photo.
    NeutralFrame,
    /// The folder or file to write to.
    Out,
    /// A ratio record.
    Ratios,
    /// Whether an author's own data are replaced.
    Replace,
    /// The script.
    Script,
    /// One part of a divided export.
    Shard,
    /// The recording.
    Speech,
    /// The writing system of a script.
    System,
    /// A tier of a timing file by its name.
    Tier,
    /// A timing file.
    Timing,
    /// A video.
    Video,
}

/// One step: a task with its settings, or settings of the task at hand.
///
/// Printed by [`fmt::Display`] it is a noun phrase that names no program and no key.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct NextStep {
    /// The task; `None` for the one that the user has just asked for.
    pub task: Option<Task>,
    /// Its settings, each with a value where one is known.
    pub settings: Vec<(Setting, Option<String>)>,
}

impl Task {
    /// This task with a setting.
    #[must_use]
    pub(crate) fn with(self, setting: Setting, value: impl Into<String>) -> NextStep {
        NextStep::from(self).with(setting, value)
    }

    /// A noun phrase.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Align => "aligning",
            Self::Calibrate => "calibrating",
            Self::Convert => "converting",
            Self::Export => "exporting",
            Self::FindFace => "finding the face",
            Self::Merge => "merging",
            Self::New => "making a project",
            Self::Open => "the studio",
            Self::Track => "tracking",
            Self::TrainModel => "training",
        }
    }
}

impl Setting {
    /// This setting with a value.
    #[must_use]
    pub(crate) fn of(self, value: impl Into<String>) -> NextStep {
        NextStep::default().with(self, value)
    }

    /// A noun phrase.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Anchors => "the positions of eyes, mouth and chin",
            Self::Clip => "the clip",
            Self::Face => "the face",
            Self::Format => "the format",
            Self::Frames => "the frames",
            Self::Method => "the method",
            Self::Neutral => "a neutral photo",
            Self::NeutralFrame => "the number of the neutral frame",
            Self::Out => "the output folder",
            Self::Ratios => "a ratio record",
            Self::Replace => "replacing",
            Self::Script => "a script",
            Self::Shard => "part",
            Self::Speech => "a recording",
            Self::System => "the writing system",
            Self::Tier => "the tier",
            Self::Timing => "a timing file",
            Self::Video => "a video",
        }
    }
}

impl NextStep {
    /// The same with one setting more, whose value is left to the user.
    #[must_use]
    pub(crate) fn and(mut self, setting: Setting) -> Self {
        self.settings.push((setting, None));
        self
    }

    /// The same with one setting more.
    #[must_use]
    pub(crate) fn with(mut self, setting: Setting, value: impl Into<String>) -> Self {
        self.settings.push((setting, Some(value.into())));
        self
    }
}

impl From<Task> for NextStep {
    fn from(task: Task) -> Self {
        Self { task: Some(task), settings: Vec::new() }
    }
}

impl From<Setting> for NextStep {
    fn from(setting: Setting) -> Self {
        Self { task: None, settings: vec![(setting, None)] }
    }
}

impl fmt::Display for NextStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut between = "";
        if let Some(task) = self.task {
            f.write_str(task.name())?;
            between = " with ";
        }
        for (setting, value) in &self.settings {
            write!(f, "{between}{}", setting.name())?;
            if let Some(value) = value {
                write!(f, " {value}")?;
            }
            between = " and ";
        }
        Ok(())
    }
}
