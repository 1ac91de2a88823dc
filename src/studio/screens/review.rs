//! The list of what there is to look at in a clip.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;

use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::stack::{Context, Effect, Flow, Screen, View};
use crate::studio::widgets::boxed::boxed;
use crate::studio::widgets::prompt::Spotted;
use crate::studio::widgets::text::{BOLD, CHOSEN, cells, put, put_short};

/// Places of the clip below, one of them chosen.
#[derive(Debug)]
pub(crate) struct ReviewScreen {
    list: Vec<Spotted>,
    chosen: usize,
}

impl ReviewScreen {
    /// A list with the number of what is chosen in it.
    #[must_use]
    pub(crate) const fn new(list: Vec<Spotted>, chosen: usize) -> Self {
        Self { list, chosen }
    }
}

impl Screen for ReviewScreen {
    fn place(&self) -> Place {
        Place::Doubts
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        match action {
            Action::Choose(by) => {
                let last = self.list.len().saturating_sub(1) as i32;
                self.chosen = (self.chosen as i32 + by).clamp(0, last) as usize;
            }
            // What concerns the whole clip is nowhere to go to.
            Action::GoThere => {
                if let Some(spot) = self.list.get(self.chosen).filter(|spot| spot.at.is_some()) {
                    cx.ask(Effect::GoTo(spot.clone()));
                }
            }
            Action::Close => cx.close(),
            _ => return Flow::Passed,
        }
        Flow::Taken
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        doubts(view.buffer, view.area, &self.list, self.chosen);
        None
    }
}

/// The places to look at, one a line.
fn doubts(buffer: &mut Buffer, area: Rect, list: &[Spotted], chosen: usize) {
    const WIDEST: u16 = 60;
    let time = |s: &Spotted| s.at.map_or(String::new(), |at| format!("{at:.2} s"));
    let times = list.iter().map(|s| cells(&time(s))).max().unwrap_or(0) + 2;
    let texts = list.iter().map(|s| cells(&s.text)).max().unwrap_or(0);
    let width = (times + texts).clamp(40, WIDEST.min(area.width.saturating_sub(8)).max(40));
    let height = (list.len() as u16).min(area.height.saturating_sub(4));
    let title = format!("{} to look at: Enter goes there", list.len());
    let inside = boxed(buffer, area, width, height, &title);
    let first = (chosen + 1).saturating_sub(usize::from(height));
    for ((index, spotted), y) in list.iter().enumerate().skip(first).zip(inside.y..inside.bottom()) {
        let style = if index == chosen { CHOSEN } else { Style::new() };
        if index == chosen {
            buffer.set_style(Rect::new(inside.x, y, inside.width, 1), CHOSEN);
        }
        put(buffer, inside.x, y, times, &time(spotted), style);
        put_short(buffer, inside.x + times, y, inside.width.saturating_sub(times), &spotted.text, style.patch(BOLD));
    }
}
