//! The forms that a lesson is handed on in, by name.

use std::str::FromStr;

use crate::disk::suggestion;

/// A form that a clip or a lesson is exported in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// One SVG file a frame.
    Svg,
    /// One PNG file a frame.
    Png,
    /// A clip as one animated SVG.
    Smil,
    /// A lesson as one page that plays it: picture, sound and script.
    Html,
    /// A lesson as an electronic book that reads itself aloud.
    Epub,
    /// A clip as a Lottie animation.
    Lottie,
    /// A clip as a video by ffmpeg: H.264 and AAC.
    Mp4,
    /// A clip as a video by ffmpeg: VP9 and Opus, with alpha.
    Webm,
    /// A clip as an animated GIF.
    Gif,
    /// A clip as an animated PNG.
    Apng,
    /// The times as a Praat TextGrid.
    TextGrid,
    /// The times as SubRip subtitles.
    Srt,
    /// The times as WebVTT subtitles, syllable by syllable.
    Vtt,
    /// The mouth shapes as Rhubarb Lip Sync writes them: TSV, XML and JSON.
    Rhubarb,
    /// The mouth shapes as Moho and Papagayo read them.
    Moho,
    /// A clip's sound.
    Wav,
    /// The seven ratios of every frame, as CSV and JSON.
    Ratios,
    /// The same in the compact record.
    Lpr,
    /// A table of every frame's pose.
    Poses,
    /// The nine mouth shapes as pictures.
    Mouths,
    /// The figure in layers, for drawing programs.
    Layers,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 21] = [
        Self::Svg,
        Self::Png,
        Self::Smil,
        Self::Html,
        Self::Epub,
        Self::Lottie,
        Self::Mp4,
        Self::Webm,
        Self::Gif,
        Self::Apng,
        Self::TextGrid,
        Self::Srt,
        Self::Vtt,
        Self::Rhubarb,
        Self::Moho,
        Self::Wav,
        Self::Ratios,
        Self::Lpr,
        Self::Poses,
        Self::Mouths,
        Self::Layers,
    ];

    /// Its name on the command line and in file names.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Smil => "smil",
            Self::Html => "html",
            Self::Epub => "epub",
            Self::Lottie => "lottie",
            Self::Mp4 => "mp4",
            Self::Webm => "webm",
            Self::Gif => "gif",
            Self::Apng => "apng",
            Self::TextGrid => "textgrid",
            Self::Srt => "srt",
            Self::Vtt => "vtt",
            Self::Rhubarb => "rhubarb",
            Self::Moho => "moho",
            Self::Wav => "wav",
            Self::Ratios => "ratios",
            Self::Lpr => "lpr",
            Self::Poses => "poses",
            Self::Mouths => "mouths",
            Self::Layers => "layers",
        }
    }

    /// Whether it is one file a frame.
    #[must_use]
    pub(crate) const fn is_frames(self) -> bool {
        matches!(self, Self::Svg | Self::Png)
    }

    /// Whether it is text made of a clip's times, which a `Job` carries ready.
    #[must_use]
    pub(crate) const fn is_text(self) -> bool {
        matches!(self, Self::TextGrid | Self::Srt | Self::Vtt | Self::Poses)
    }

    /// Whether it is a clip's frames packed into one moving picture.
    #[must_use]
    pub(crate) const fn is_moving(self) -> bool {
        matches!(self, Self::Mp4 | Self::Webm | Self::Gif | Self::Apng)
    }

    /// Whether all clips go into one file.
    #[must_use]
    pub(crate) const fn is_of_the_lesson(self) -> bool {
        matches!(self, Self::Html | Self::Epub)
    }
}

impl FromStr for Format {
    type Err = String;

    /// Blanks around it and large letters do not matter.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim().to_lowercase();
        let text = text.as_str();
        Self::ALL.into_iter().find(|f| f.name() == text).ok_or_else(|| {
            format!("`{text}` is no export format; {}", suggestion(text, "formats", &Self::ALL.map(Self::name)))
        })
    }
}
