//! The stretch of time that is on the screen.

/// The shortest stretch that is shown, in seconds: some frames, so that a column is a few samples and no less.
const SHORTEST: f64 = 0.2;

/// Where the cursor lands when it has left the window, as a share of it.
const LANDING: f64 = 0.15;

/// From when and how much is shown, in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// The first instant.
    pub from: f64,
    /// How much.
    pub span: f64,
}

impl Window {
    /// All of a clip.
    #[must_use]
    pub(crate) fn whole(duration: f64) -> Self {
        Self { from: 0.0, span: duration.max(SHORTEST) }
    }

    /// The end of it.
    #[must_use]
    pub(crate) fn to(&self) -> f64 {
        self.from + self.span
    }

    /// Which of `columns` a time falls into; it may lie before the first or after the last.
    #[must_use]
    pub(crate) fn column(&self, time: f64, columns: u16) -> i32 {
        // A boundary that is a column's edge up to rounding lies in that column.
        ((time - self.from) / self.span * f64::from(columns) + 1e-6).floor().clamp(-1e6, 1e6) as i32
    }

    /// The same, where it is on the screen.
    #[must_use]
    pub(crate) fn shown_column(&self, time: f64, columns: u16) -> Option<u16> {
        u16::try_from(self.column(time, columns)).ok().filter(|c| *c < columns)
    }

    /// The time at the left edge of a column.
    #[must_use]
    pub(crate) fn time_of(&self, column: f64, columns: u16) -> f64 {
        self.from + self.span * column / f64::from(columns.max(1))
    }

    /// Half or twice as much, the time `about` staying where it is.
    #[must_use]
    pub(crate) fn zoomed(&self, steps: i32, about: f64, duration: f64) -> Self {
        let span = (self.span * 0.5_f64.powi(steps)).clamp(SHORTEST.min(duration.max(1e-3)), duration.max(SHORTEST));
        let share = ((about - self.from) / self.span).clamp(0.0, 1.0);
        Self { from: about - share * span, span }.kept_in(duration)
    }

    /// Moved as far as is needed for `time` to be on the screen: by a page, so that the next steps need nothing new.
    #[must_use]
    pub(crate) fn following(&self, time: f64, duration: f64) -> Self {
        // The last instant stands on the right edge, which is still in sight.
        if time >= self.from - 1e-9 && (time < self.to() || (time - duration).abs() < 1e-9 && time <= self.to() + 1e-9)
        {
            return *self;
        }
        let landing = if time < self.from { 1.0 - LANDING } else { LANDING };
        Self { from: time - landing * self.span, span: self.span }.kept_in(duration)
    }

    fn kept_in(self, duration: f64) -> Self {
        Self { from: self.from.min(duration - self.span).max(0.0), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_the_cursor_where_it_is_and_never_leaves_the_clip() {
        let whole = Window::whole(10.0);
        let near = whole.zoomed(2, 4.0, 10.0);
        assert!((near.span - 2.5).abs() < 1e-9 && near.column(4.0, 100) == whole.column(4.0, 100));
        assert_eq!(near.zoomed(-9, 4.0, 10.0), whole);
        assert!(whole.zoomed(30, 9.99, 10.0).to() <= 10.0 + 1e-9);
    }

    #[test]
    fn the_window_follows_the_cursor_by_pages_and_stays_while_it_is_in_sight() {
        let window = Window { from: 2.0, span: 1.0 };
        assert_eq!(window.following(2.5, 10.0), window);
        assert!((window.following(3.0, 10.0).from - 2.85).abs() < 1e-9);
        assert!((window.following(1.9, 10.0).from - 1.05).abs() < 1e-9);
        assert_eq!(Window { from: 9.0, span: 1.0 }.following(10.0, 10.0).from, 9.0);
        assert_eq!(window.following(99.0, 10.0).from, 9.0);
    }
}
