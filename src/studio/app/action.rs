//! What a key can ask for. The key table says which keys ask for what; `execute` alone carries it out.

/// One thing to do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Move the choice in a list by so many.
    Choose(i32),
    /// Open what is chosen.
    Open,
    /// Go back to where one came from, or leave.
    Back,
    /// Leave the studio.
    Quit,
    /// Show every key of this place.
    Help,
    /// Scroll the help by so many lines.
    Scroll(i32),
    /// Move the cursor by so many frames.
    Frames(i32),
    /// Move the cursor by so many hundredths of a second.
    Centis(i32),
    /// Move the cursor by so many screens.
    Screens(i32),
    /// Move the cursor to the first instant.
    First,
    /// Move the cursor to the last instant.
    Last,
    /// Move to another syllable.
    Syllable(i32),
    /// Move to another key on the lane.
    Key(i32),
    /// Choose another lane.
    Lane(i32),
    /// Show less or more of the time: 1 is nearer, -1 farther.
    Zoom(i32),
    /// Show the whole clip.
    Fit,
    /// Play, or stop playing.
    Play,
    /// Begin again at the end, or not.
    Loop,
    /// Move the start of the syllable.
    Start(Nudge),
    /// Move the end of the syllable.
    End(Nudge),
    /// Open a gap before (-1) or after (1) the syllable: its own edge moves, and no neighbour.
    Gap(i32),
    /// Change what is under the cursor: a key's value, or the syllable's reading.
    Edit,
    /// Change the syllable's reading.
    Reading,
    /// Add a key to the lane.
    Add,
    /// Move the key by so many frames.
    MoveKey(i32),
    /// Take the key away.
    Delete,
    /// Mark one end of a stretch, then the other.
    Mark,
    /// Take the last range edit at the cursor away.
    DeleteRange,
    /// Take the last change back.
    Undo,
    /// Make the change again.
    Redo,
    /// Write the lesson's files.
    Save,
    /// Export the clip or the lesson.
    Export,
    /// Draw everything anew.
    Redraw,
    /// Put a letter into the prompt.
    Type(char),
    /// Take the letter before the caret away.
    Rub,
    /// Take the letter after the caret away.
    RubAhead,
    /// Take everything before the caret away.
    RubLine,
    /// Move the caret by so many letters.
    Caret(i32),
    /// Accept the prompt.
    Accept,
    /// Save, then go on with what was asked.
    SaveAndGo,
    /// Drop the changes, then go on with what was asked.
    DropAndGo,
    /// Leave with the changes in the journal, which the next run brings back.
    KeepAndGo,
    /// Close what lies on top and change nothing.
    Close,
    /// Open the face of the clip.
    Face,
    /// Choose another feature point.
    Point(i32),
    /// Go to a feature point by its name.
    GoTo,
    /// Move the feature point by so many pixels of the photo.
    Move(i32, i32),
    /// Let both sides of the face move, or one.
    Both,
    /// Find the face's points again.
    FindAgain,
    /// Give the feature point back to the search.
    Release,
    /// Place the face by hand, where the search fails.
    Anchors,
    /// Take the place of the cross.
    Cross,
    /// The next way for hair to fall.
    Hair,
    /// Show the cartoon with another emotion.
    Emotion(i32),
    /// Show the cartoon with another mouth shape.
    Mouth(i32),
    /// Go to another shot of the face.
    Shot(i32),
    /// Calibrate the face from its shots.
    Calibrate,
    /// Show another stage of the search.
    Stage(i32),
    /// Find the clip's times in its sound.
    Align,
    /// Follow the face in the clip's video, or stop doing so.
    Follow,
    /// Show the video beside the drawing, or not.
    Video,
    /// Go to another place that the alignment is not sure of.
    Doubt(i32),
    /// List the places that the alignment is not sure of.
    Doubts,
    /// Go to the chosen place of that list.
    GoThere,
    /// Show the sound as a wave, as a spectrogram, or both.
    SoundView,
    /// Show the pitch of the voice, or not.
    Tone,
    /// Mark where syllables are heard, for words to be typed onto.
    Places,
    /// Begin to tap syllables along with the sound.
    Tap,
    /// While tapping: go on from where it stands, mark the start of a syllable.
    TapStart,
    /// While tapping: mark the end of a syllable, before a pause.
    TapEnd,
    /// While tapping: take the last mark back and go a second back.
    TapBack,
    /// While tapping: at full speed, or at half.
    TapSpeed,
    /// While tapping: choose the syllable that comes next.
    TapNext(i32),
    /// Measure how late taps come.
    TapMeasure,
    /// Keep what was tapped.
    TapKeep,
    /// Drop what was tapped.
    TapDrop,
}

/// How far a boundary is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nudge {
    /// By so many steps of 10 ms.
    Centis(i32),
    /// By so many frames.
    Frames(i32),
}
