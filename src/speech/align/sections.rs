//! Where somebody has set boundaries, a recording falls into parts that are searched one by one.

use super::features::FRAMES;
use super::search::Section;
use crate::speech::Pin;

/// The sections of a recording of so many frames and a script of so many syllables: each pinned syllable is one of its
/// own. Pins that contradict each other are obeyed as far as they go; those beyond the script are none.
#[must_use]
pub(crate) fn sections(frames: usize, syllables: usize, pins: &[Pin]) -> Vec<Section> {
    let mut pins: Vec<&Pin> = pins.iter().filter(|p| p.syllable < syllables).collect();
    pins.sort_by_key(|p| p.syllable);
    pins.dedup_by_key(|p| p.syllable);
    let mut sections = Vec::new();
    let (mut frame, mut syllable) = (0, 0);
    for pin in pins {
        let at = |time: f64| (time.max(0.0) * FRAMES).round() as usize;
        let from = at(pin.start).clamp(frame, frames);
        let to = at(pin.end).clamp(from, frames);
        if pin.syllable > syllable {
            sections.push(Section { from: frame, to: from, first: syllable, last: pin.syllable, full: false });
        }
        sections.push(Section { from, to, first: pin.syllable, last: pin.syllable + 1, full: true });
        (frame, syllable) = (to, pin.syllable + 1);
    }
    if syllable < syllables {
        sections.push(Section { from: frame, to: frames, first: syllable, last: syllables, full: false });
    }
    sections
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pin(syllable: usize, start: f64, end: f64) -> Pin {
        Pin { syllable, start, end }
    }

    #[test]
    fn every_syllable_is_in_one_section_and_sections_follow_each_other() {
        for pins in [
            vec![],
            vec![pin(0, 0.1, 0.3)],
            vec![pin(4, 1.0, 2.0), pin(2, 0.5, 0.9)],
            vec![pin(2, 0.9, 0.5), pin(3, -1.0, f64::INFINITY), pin(9, 0.0, 1.0)],
            vec![pin(1, f64::NAN, 0.5), pin(1, 0.2, 0.3)],
        ] {
            let sections = sections(400, 5, &pins);
            let (mut frame, mut syllable) = (0, 0);
            for section in &sections {
                assert_eq!(section.first, syllable);
                assert!(section.from >= frame && section.to >= section.from && section.last > section.first);
                (frame, syllable) = (section.to, section.last);
            }
            assert!(frame <= 400 && syllable == 5, "{sections:?}");
        }
    }
}
