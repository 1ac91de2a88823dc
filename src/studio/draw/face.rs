//! The page of a face: the photo with its points, the cartoon beside it, and the chosen point in words.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::lists::{folded, standing};
use super::{BOLD, DIM, Pictures, cells, head, put, put_short};
use crate::studio::face_desk::{FaceDesk, told};
use crate::studio::photo_picture::{self, CHOSEN, FOUND, RULE, SET};
use crate::studio::picture::FacePicture;
use crate::studio::state::State;

/// Where the two pictures and the words are.
#[derive(Debug, Clone, Copy)]
pub(in crate::studio) struct FaceLayout {
    pub photo: Rect,
    pub cartoon: Rect,
    pub words: Rect,
}

impl FaceLayout {
    /// The places on a screen: head and foot take a line each, the words four at the bottom.
    pub fn of(area: Rect, desk: &FaceDesk) -> Self {
        let top = Rect::new(area.x + 1, area.y + 1, area.width - 2, area.height - 7);
        let most = top.width * 2 / 5;
        let wanted = desk.figure.as_ref().map_or(most, |f| FacePicture::size_in(f, (most, top.height).into()).width);
        let cartoon = Rect { x: top.right() - wanted, width: wanted, ..top };
        let photo = Rect { width: cartoon.x - top.x - 2, ..top };
        Self { photo, cartoon, words: Rect::new(area.x + 1, top.bottom() + 1, area.width - 2, 4) }
    }
}

pub(super) fn face(buffer: &mut Buffer, area: Rect, state: &State, pictures: Pictures<'_>) {
    let (Some(desk), Some(lesson)) = (&state.face, state.lesson()) else { return };
    let Some(lesson_face) = lesson.faces.get(desk.face) else { return };
    let (told_standing, style) = standing(lesson, state.colours);
    head(buffer, area, &[&lesson.manifest.title, &lesson_face.entry.name], told_standing, style);
    let layout = FaceLayout::of(area, desk);
    match (&desk.photo, desk.stage) {
        (Some(_), Some(_)) => pictures.stage.put(buffer, layout.photo),
        (Some(photo), None) => {
            photo_picture::put(buffer, layout.photo, photo, desk, lesson_face.face.as_ref(), state.colours);
        }
        (None, _) => {
            let text = if lesson_face.photo.is_some() { "reading the photo…" } else { "there is no photo" };
            put(buffer, layout.photo.x, layout.photo.y + 1, layout.photo.width, text, DIM);
        }
    }
    match &desk.figure {
        Some(_) => pictures.cartoon.put(buffer, layout.cartoon),
        None => {
            for (line, y) in folded("no cartoon yet", layout.cartoon.width).iter().zip(layout.cartoon.y + 1..) {
                put(buffer, layout.cartoon.x, y, layout.cartoon.width, line, DIM);
            }
        }
    }
    words(buffer, layout.words, state, desk);
}

fn words(buffer: &mut Buffer, area: Rect, state: &State, desk: &FaceDesk) {
    let Some(lesson_face) = state.lesson().and_then(|l| l.faces.get(desk.face)) else { return };
    let mut x = area.x;
    let mut say = |text: &str, style: Style| {
        x += put_short(buffer, x, area.y, area.right().saturating_sub(x), text, style);
    };
    if let Some(placing) = &desk.placing {
        say(&format!("Put the cross on {} ", placing.wanted()), BOLD);
        say(&format!("({} of 4)", placing.given.len() + 1), Style::new());
        let at =
            format!("arrows move it, Enter sets it, o gives up   x {:.0}  y {:.0}", placing.cross.x, placing.cross.y);
        put_short(buffer, area.x, area.y + 1, area.width, &at, Style::new());
        return;
    }
    match lesson_face.face.as_ref().and_then(|f| Some((f, *f.placed(desk.point)?))) {
        Some((face, placed)) => {
            say(&desk.point.name(), BOLD.patch(state.colours.ink(CHOSEN)));
            say(&format!("  {}", desk.point.meaning()), BOLD);
            say(&format!("   x {:.1}  y {:.1}   {}", placed.at.x, placed.at.y, told(&placed)), Style::new());
            let hand = crate::face::FeaturePoint::all()
                .filter_map(|p| face.placed(p))
                .filter(|p| p.how == crate::face::How::Hand)
                .count();
            let mut second = area.x;
            let mut note = |text: &str, style: Style| {
                second += put_short(buffer, second, area.y + 1, area.right().saturating_sub(second), text, style);
            };
            note("•", state.colours.ink(FOUND));
            note(" found  ", DIM);
            note("◦", state.colours.ink(RULE));
            note(" by rule  ", DIM);
            note("■", state.colours.ink(SET));
            note(&format!(" by hand ({hand})   "), DIM);
            note(if desk.both { "both sides move" } else { "one side moves" }, DIM);
            let mouth = desk.mouth.map_or_else(String::new, |m| format!(", mouth {}", m.letter()));
            note(&format!("   shown: {}{mouth}", desk.emotion.name()), DIM);
        }
        None => say("no points yet: r finds them, o places them by hand", BOLD),
    }
    let mut y = area.y + 2;
    if let Some(stage) = desk.stage.and_then(|s| desk.stages.get(s)) {
        put_short(buffer, area.x, y, area.width, &stage.0, BOLD);
        y += 1;
    }
    for line in desk.remarks.iter().flat_map(|r| folded(&format!("! {r}"), area.width)) {
        if y >= area.bottom() {
            break;
        }
        let width = cells(&line).min(area.width);
        put_short(buffer, area.x, y, width.max(1), &line, state.colours.warning());
        y += 1;
    }
}
