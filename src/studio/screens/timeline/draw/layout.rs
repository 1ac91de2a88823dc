//! Where everything of the timeline lies on a screen.

use ratatui::layout::Rect;

use crate::project::Clip;
use crate::studio::app::heard::SoundView;
use crate::studio::app::lane::Lane;
use crate::studio::app::shell::Shell;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::photo_picture;
use crate::studio::widgets::picture::FacePicture;
use crate::timeline::Track;

/// Cells left of the lanes, for their names.
const NAMES: u16 = 9;

/// Cells right of the lanes, for the letters of the curves.
const LETTERS: u16 = 5;

/// Columns that the panel keeps beside the video: a ratio's name, its number and a short bar.
const PANEL: u16 = 26;

/// Rows from which on there is room for every lane of keys, and for wave and spectrogram both.
const TALL: u16 = 26;

/// Columns a phone needs in the mean for its name to be read.
const READABLE: f64 = 2.2;

/// The places of the timeline's parts.
#[derive(Debug, Clone)]
pub(in crate::studio) struct Layout {
    pub area: Rect,
    pub face: Rect,
    /// The frame of the video; no width where it is not shown.
    pub video: Rect,
    pub panel: Rect,
    pub ruler: Rect,
    /// The outline of the sound; no height where it is not shown.
    pub wave: Rect,
    /// Its frequencies; no height where they are not shown.
    pub spectrum: Rect,
    /// The pitch of the voice; no height where it is not shown.
    pub tone: Rect,
    pub said: Rect,
    pub pinyin: Rect,
    /// The phones; no height where they cannot be read.
    pub phones: Rect,
    pub mouth: Rect,
    pub curves: Rect,
    /// The lanes of keys below; none of its own where one row shows them all.
    pub keys: Vec<(Option<Lane>, Rect)>,
}

impl Layout {
    /// The layout of the timeline in a terminal that has room for it.
    pub(crate) fn of(area: Rect, editor: &Editor, clip: &Clip, shell: &Shell) -> Self {
        let columns = area.width - NAMES - LETTERS;
        let shows_phones = editor.columns_a_phone(clip, columns).is_some_and(|c| c >= READABLE);
        // Head and foot take a line each; ruler, said, pinyin and mouth one each.
        let room = area.height - 2;
        let is_tall = room >= TALL;
        let key_rows = if is_tall { 4 } else { 1 };
        let least = 4 + key_rows;
        let spare = room.saturating_sub(least + 2 + 3 + 12);
        let (mut curves, wave) = ((3 + spare * 3 / 10).min(12), (2 + spare / 5).min(6));
        let phones = u16::from(shows_phones);
        // On a low screen the curves give a row to the phones: zooming leaves the face alone.
        curves -= phones;
        let (wave, spectrum) = match shell.view {
            SoundView::Wave => (wave, 0),
            SoundView::Both if is_tall => (wave, wave + 2),
            // Frequencies need more rows than an outline.
            _ => (0, wave + u16::from(room >= 20)),
        };
        let tone = match shell.tone {
            true if room >= 20 => 3 + u16::from(is_tall),
            true => 2,
            false => 0,
        };
        if is_tall {
            // The face keeps its size as long as the curves have rows to spare.
            let more = tone + if wave > 0 { spectrum } else { 0 };
            curves -= more.min(curves.saturating_sub(5));
        }
        let top = room - least - phones - curves - wave - spectrum - tone;
        // The face has its shape, the panel the rest.
        let upper = Rect::new(area.x, area.y + 1, area.width, top);
        let most = upper.width.saturating_sub(40);
        let face_width = FacePicture::size_in(&editor.figure, (most, top).into()).width;
        let face = Rect { x: upper.x + 1, width: face_width, ..upper };
        // The video stands beside the face as high as it, where the panel keeps room for its words.
        let room_beside = upper.right().saturating_sub(face.right() + 2 + PANEL);
        let video = match editor.footage.picture().filter(|_| shell.shows_video) {
            Some(photo) if room_beside >= 12 => {
                let view = crate::geometry::Rect::new(0.0, 0.0, photo.width() as f64, photo.height() as f64);
                let size = photo_picture::size_in(view, (room_beside, top).into());
                Rect { x: face.right() + 1, width: size.width, ..upper }
            }
            _ => Rect { x: face.right(), width: 0, ..upper },
        };
        let left = video.right() + 2;
        let panel = Rect { x: left, width: area.right().saturating_sub(left + 1), ..upper };
        let mut y = upper.bottom();
        let mut next = |height| {
            let rows = Rect::new(area.x + NAMES, y, area.width - NAMES - LETTERS, height);
            y += height;
            rows
        };
        let (ruler, wave, spectrum, tone, said) = (next(1), next(wave), next(spectrum), next(tone), next(1));
        let (pinyin, phones, mouth, curves) = (next(1), next(phones), next(1), next(curves));
        let own = |lane: &Lane| matches!(lane, Lane::Keys(t) if *t != Track::Mouth);
        let keys = match key_rows {
            1 => vec![(Some(editor.lane).filter(own), next(1))],
            _ => Lane::ALL.iter().filter(|l| own(l)).map(|l| (Some(*l), next(1))).collect(),
        };
        Self { area, face, video, panel, ruler, wave, spectrum, tone, said, pinyin, phones, mouth, curves, keys }
    }

    /// How many columns of time there are.
    pub(crate) fn columns(&self) -> u16 {
        self.ruler.width
    }

    /// The last row of the lanes.
    pub(crate) fn bottom(&self) -> u16 {
        self.keys.last().map_or(self.curves.bottom(), |(_, r)| r.bottom())
    }
}
