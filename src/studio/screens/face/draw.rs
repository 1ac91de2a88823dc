//! The page of a face: the photo with its points, the cartoon beside it, and the chosen point in words.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::calibrating;
use super::desk::{FaceDesk, told};
use super::page::FaceScreen;
use super::points::{self, CHOSEN as CHOSEN_INK, FOUND, RULE, SET};
use crate::pose::Emotion;
use crate::project::{FaceShot, LessonFace};
use crate::studio::app::colours::Colours;
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::View;
use crate::studio::widgets::picture::FacePicture;
use crate::studio::widgets::text::{BOLD, CHOSEN, DIM, cells, folded, head, put, put_short};

/// Where the two pictures and the words are.
#[derive(Debug, Clone, Copy)]
pub(in crate::studio) struct FaceLayout {
    pub photo: Rect,
    pub cartoon: Rect,
    pub words: Rect,
}

impl FaceLayout {
    /// The places on a screen: head and foot take a line each, the words five or seven at the bottom.
    pub(crate) fn of(area: Rect, desk: &FaceDesk) -> Self {
        let rows = if area.height < 30 { 5 } else { 7 };
        let top = Rect::new(area.x + 1, area.y + 1, area.width - 2, area.height - 3 - rows);
        let most = top.width * 2 / 5;
        let wanted = desk.figure.as_ref().map_or(most, |f| FacePicture::size_in(f, (most, top.height).into()).width);
        let cartoon = Rect { x: top.right() - wanted, width: wanted, ..top };
        let photo = Rect { width: cartoon.x - top.x - 2, ..top };
        Self { photo, cartoon, words: Rect::new(area.x + 1, top.bottom() + 1, area.width - 2, rows) }
    }
}

/// Draws the page of a face.
pub(super) fn face(view: &mut View<'_>, project: &OpenProject, screen: &FaceScreen) {
    let (area, colours) = (view.area, view.shell.colours);
    let buffer = &mut *view.buffer;
    let (desk, lesson) = (&screen.desk, &project.lesson);
    let lesson_face = &lesson.faces[desk.face];
    let (told_standing, style) = project.standing(colours);
    let path = [lesson.manifest.title.as_str(), &lesson_face.entry.name, desk.shot.name()];
    head(buffer, area, &path, told_standing, style);
    let layout = FaceLayout::of(area, desk);
    match (&desk.photo, desk.stage) {
        (Some(_), Some(_)) => screen.stage.put(buffer, layout.photo),
        (Some(photo), None) => {
            points::put(buffer, layout.photo, photo, desk, &desk.points(lesson_face), colours);
        }
        (None, _) => {
            let name = &lesson_face.entry.name;
            let text = match (lesson_face.photo_of(desk.shot), desk.shot) {
                (Some(_), _) => "reading the photo…".into(),
                (None, Emotion::Neutral) => "there is no photo".into(),
                (None, e) => format!(
                    "There is no photo of {e}: it is modelled after everybody's face. Put this face's own there as faces/{name}/{e}.png."
                ),
            };
            for (line, y) in folded(&text, layout.photo.width).iter().zip(layout.photo.y + 1..layout.photo.bottom()) {
                put(buffer, layout.photo.x, y, layout.photo.width, line, DIM);
            }
        }
    }
    match &desk.figure {
        Some(_) => screen.cartoon.put(buffer, layout.cartoon),
        None => {
            for (line, y) in folded("no cartoon yet", layout.cartoon.width).iter().zip(layout.cartoon.y + 1..) {
                put(buffer, layout.cartoon.x, y, layout.cartoon.width, line, DIM);
            }
        }
    }
    words(buffer, layout.words, colours, desk, lesson_face);
}

fn words(buffer: &mut Buffer, area: Rect, colours: Colours, desk: &FaceDesk, lesson_face: &LessonFace) {
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
    let points = desk.points(lesson_face);
    match points.iter().find(|p| p.0 == desk.point) {
        Some((_, placed)) => {
            say(&desk.point.name(), BOLD.patch(colours.ink(CHOSEN_INK)));
            say(&format!("  {}", desk.point.meaning()), BOLD);
            say(&format!("   x {:.1}  y {:.1}   {}", placed.at.x, placed.at.y, told(placed)), Style::new());
            let hand = points.iter().filter(|p| p.1.how == crate::face::How::Hand).count();
            let mut second = area.x;
            let mut note = |text: &str, style: Style| {
                second += put_short(buffer, second, area.y + 1, area.right().saturating_sub(second), text, style);
            };
            note("•", colours.ink(FOUND));
            note(" found  ", DIM);
            note("◦", colours.ink(RULE));
            note(" by rule  ", DIM);
            note("■", colours.ink(SET));
            note(&format!(" by hand ({hand})   "), DIM);
            note(if desk.both { "both sides move" } else { "one side moves" }, DIM);
            let mouth = desk.mouth.map_or_else(String::new, |m| format!(", mouth {}", m.letter()));
            note(&format!("   shown: {}{mouth}", desk.emotion.name()), DIM);
        }
        None => match lesson_face.shot(desk.shot) {
            None => say("no points yet: r finds them, o places them by hand", BOLD),
            Some(FaceShot { photo: None, .. }) => say(&format!("{} is modelled", desk.shot), BOLD),
            Some(FaceShot { foreign: Some(path), .. }) => {
                let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
                let count = desk.dots.len();
                say(&format!("{count} points of {name}, which have no names: change them there"), BOLD);
            }
            Some(_) => say("no points yet: C finds them", BOLD),
        },
    }
    shots(buffer, Rect { y: area.y + 2, height: 1, ..area }, colours, desk, lesson_face);
    let mut y = area.y + 3;
    if let Some(stage) = desk.stage.and_then(|s| desk.stages.get(s)) {
        put_short(buffer, area.x, y, area.width, &stage.0, BOLD);
        y += 1;
    }
    let file = lesson_face.calibration.as_ref().filter(|_| desk.stage.is_none());
    if let Some(file) = file.filter(|_| !desk.is_stale) {
        put_short(buffer, area.x, y, area.width, &calibrating::told(file, desk.shot), Style::new());
        y += 1;
    }
    let of_calibration = match file {
        Some(_) if desk.is_stale => {
            vec!["the points were changed since the face was calibrated: C does that again".into()]
        }
        Some(file) => calibrating::remarks(file),
        None if lesson_face.shots.iter().any(|s| s.photo.is_some()) => {
            vec!["this face was never calibrated: C does that, for its own emotions and for tracking videos".into()]
        }
        None => Vec::new(),
    };
    for line in desk.remarks.iter().chain(&of_calibration).flat_map(|r| folded(&format!("! {r}"), area.width)) {
        if y >= area.bottom() {
            break;
        }
        let width = cells(&line).min(area.width);
        put_short(buffer, area.x, y, width.max(1), &line, colours.warning());
        y += 1;
    }
}

/// The seven shots in a line: the one that is looked at, those that there are, those that are modelled.
fn shots(buffer: &mut Buffer, area: Rect, colours: Colours, desk: &FaceDesk, face: &LessonFace) {
    let mut x = area.x;
    for emotion in Emotion::ALL {
        let is_there = face.photo_of(emotion).is_some();
        let sign = if is_there { "●" } else { "○" };
        let here = if emotion == desk.shot { CHOSEN } else { Style::new() };
        let ink = if is_there { colours.of_emotion(emotion) } else { DIM };
        x += put(buffer, x, area.y, area.right().saturating_sub(x), sign, ink);
        let room = area.right().saturating_sub(x);
        x += put(buffer, x, area.y, room, emotion.name(), here.patch(if is_there { Style::new() } else { DIM }));
        x += 2;
    }
    let missing = Emotion::ALL.iter().filter(|e| face.photo_of(**e).is_none()).count();
    if missing > 0 {
        put_short(buffer, x, area.y, area.right().saturating_sub(x), "○ no photo", DIM);
    }
}
