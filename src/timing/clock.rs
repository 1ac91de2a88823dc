//! Times as text: seconds with a point, and the clocks of subtitles.

/// Seconds with at most 6 decimals: a microsecond is far below a sample of speech.
pub(super) fn seconds(time: f64) -> String {
    let rounded = (time * 1e6).round() / 1e6;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

/// A finite number with digits and perhaps a point and a sign; nothing where it is none.
pub(super) fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let begins = text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
    // `inf` and `nan` are words.
    text.parse().ok().filter(|number: &f64| begins && number.is_finite())
}

/// A label as one line without tabs: blanks of any kind become `blank`.
pub(super) fn one_line(label: &str, blank: &str) -> String {
    label.split_whitespace().collect::<Vec<_>>().join(blank)
}

/// `00:00:01,250`; `point` stands before the milliseconds.
pub(super) fn clock(time: f64, point: char) -> String {
    let ms = (time * 1e3).round().max(0.0) as u64;
    format!("{:02}:{:02}:{:02}{point}{:03}", ms / 3_600_000, ms / 60_000 % 60, ms / 1000 % 60, ms % 1000)
}

/// The seconds of a clock: `[hours:]minutes:seconds` with a comma or a point before the fraction, which may be
/// missing. Nothing where it is no clock.
pub(super) fn parse_clock(text: &str) -> Option<f64> {
    let text = text.trim();
    let (whole, fraction) = text.split_once([',', '.']).unwrap_or((text, "0"));
    let digits = |s: &str| !s.is_empty() && s.len() <= 9 && s.bytes().all(|b| b.is_ascii_digit());
    let parts: Vec<&str> = whole.split(':').collect();
    if !(2..=3).contains(&parts.len()) || !parts.iter().all(|p| digits(p)) || !digits(fraction) {
        return None;
    }
    let mut seconds = 0.0;
    for (index, part) in parts.iter().enumerate() {
        let value: f64 = part.parse().ok()?;
        // Minutes beside hours and seconds beside minutes stay below 60; the first number may be any.
        if index > 0 && value >= 60.0 {
            return None;
        }
        seconds = seconds * 60.0 + value;
    }
    Some(seconds + format!("0.{fraction}").parse::<f64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_come_with_and_without_hours_and_with_either_point() {
        assert_eq!(parse_clock("01:02:03,250"), Some(3723.25));
        assert_eq!(parse_clock("02:03.5"), Some(123.5));
        assert_eq!(parse_clock("90:00"), Some(5400.0));
        for bad in ["", "3", "1:60", "1:2:3:4", "-1:00", "1:nan", "00:01,-5", "00:01,"] {
            assert_eq!(parse_clock(bad), None, "{bad}");
        }
        assert_eq!(clock(3723.2504, ','), "01:02:03,250");
        assert_eq!(clock(59.9996, '.'), "00:01:00.000");
        assert_eq!(seconds(0.1 + 0.2), "0.3");
    }
}
