//! Reading the chronological form: the tiers, then their labels by rising time, each behind the number of its tier.

use super::super::Timing;
use super::super::layer::Layer;
use super::super::tiers::{MAX_TIERS, too_many_tiers};
use super::read::Reader;
use crate::disk::{Fault, Result};

/// Reads what follows the first line.
///
/// # Errors
/// With the line and what was found there.
pub(super) fn parse(reader: &mut Reader) -> Result<Timing> {
    reader.text(&[], "the first line, in quotes")?;
    let end = reader.span("the file")?;
    let (count, line) = reader.number(&[], "the number of tiers")?;
    if count > MAX_TIERS as f64 {
        return Err(too_many_tiers().line(line));
    }
    let mut layers = Vec::new();
    while layers.len() < count as usize {
        let number = layers.len() + 1;
        let points = reader.class()?;
        let (name, _) = reader.text(&[], &format!("the name of tier {number}"))?;
        reader.span(&format!("tier `{name}`"))?;
        layers.push((Layer::new(&name), points));
    }
    while reader.next_value().is_some() {
        let (number, line) = reader.number(&[], "the number of a tier")?;
        let place = if number >= 1.0 { number as usize - 1 } else { usize::MAX };
        let Some((layer, points)) = layers.get_mut(place) else {
            return Err(Fault::new(format!("found `{number}` where the number of a tier is expected"))
                .line(line)
                .help(format!("tiers are numbered from 1 to {count}; is something missing just before it?")));
        };
        let (start, line) = reader.number(&[], "the start of a label")?;
        let end = if *points { start } else { reader.number(&[], "the end of a label")?.0 };
        let (label, _) = reader.text(&[], "the label, in quotes")?;
        layer.lay(start, end, &label).map_err(|fault| fault.line(line))?;
    }
    reader.nothing_left()?;
    let mut timing = Timing { duration: end, ..Timing::default() };
    for (layer, points) in layers {
        let (tier, until) = layer.done();
        if !(points && tier.intervals.is_empty()) {
            timing.add_read(tier, until)?;
        }
    }
    Ok(timing)
}
