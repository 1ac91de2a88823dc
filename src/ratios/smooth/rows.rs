//! Smoothing both ways, for files.

use super::local::{shares, tricube};
use super::noise::{deviation, third_difference};
use super::{likeness, parts, with_parts};
use crate::pose::Ratios;
use crate::ratios::{Record, Tracks};

/// A curve is taken only where it brings noise down to this share of its variance; else a simpler one is.
const ENOUGH: f64 = 0.4;

/// Takes the noise out of a record, looking `width` seconds each way ([`SMOOTH_WIDTH`](super::SMOOTH_WIDTH) is a good one). Sums stay 1. Lost
/// frames (confidence 0) neither count nor change: bridge them afterwards.
pub fn smooth_record(record: &mut Record, width: f64) {
    let rows: Vec<_> = record.rows.iter().map(|r| (r.time, r.ratios.0, r.confidence > 0.0)).collect();
    for (row, (_, old, _), new) in
        record.rows.iter_mut().zip(&rows).zip(smoothed(&rows, width)).map(|((a, b), c)| (a, b, c))
    {
        if new != *old {
            row.ratios = within(Ratios(new).closed(), old);
        }
    }
}

/// What was smoothed, without the ratios below 0 that a curve makes of rows that have none.
fn within(ratios: Ratios, old: &[f64; 7]) -> Ratios {
    if old.iter().any(|v| *v < 0.0) || ratios.0.iter().all(|v| *v >= 0.0) {
        return ratios;
    }
    let kept = ratios.0.map(|v| v.max(0.0));
    let sum: f64 = kept.iter().sum();
    Ratios(kept.map(|v| v / sum))
}

/// Takes the noise out of tracks as [`smooth_record`] does out of ratios; gaze, lids, mouth and head each by themselves.
pub fn smooth_tracks(tracks: &mut Tracks, width: f64) {
    let of = |row: &_| parts(row);
    let all: Vec<_> = tracks.rows.iter().map(|r| (r.time, of(r), r.confidence > 0.0)).collect();
    let gaze = smoothed(&all.iter().map(|(t, p, sure)| (*t, p.0, *sure)).collect::<Vec<_>>(), width);
    let lids = smoothed(&all.iter().map(|(t, p, sure)| (*t, p.1, *sure)).collect::<Vec<_>>(), width);
    let mouth = smoothed(&all.iter().map(|(t, p, sure)| (*t, p.2, *sure)).collect::<Vec<_>>(), width);
    let head = smoothed(&all.iter().map(|(t, p, sure)| (*t, p.3, *sure)).collect::<Vec<_>>(), width);
    for (i, row) in tracks.rows.iter_mut().enumerate() {
        *row = with_parts(row, (gaze[i], lids[i], mouth[i], head[i]));
    }
}

/// Rows of time, values and whether they count.
fn smoothed<const N: usize>(rows: &[(f64, [f64; N], bool)], width: f64) -> Vec<[f64; N]> {
    let noise: [f64; N] = std::array::from_fn(|c| {
        let four = rows.windows(4).filter(|w| w.iter().all(|r| r.2));
        deviation(four.map(|w| third_difference([w[0].1[c], w[1].1[c], w[2].1[c], w[3].1[c]])))
    });
    let mut start = 0;
    let mut value = |i: usize| {
        let (now, here, sure) = rows[i];
        while rows[start].0 <= now - width && start < i {
            start += 1;
        }
        if !sure {
            return here;
        }
        let near = rows[start..].iter().take_while(|r| r.0 < now + width).filter(|r| r.2);
        let (mut steps, mut weights, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (time, row, _) in near {
            let u = (time - now) / width;
            let weight = tricube(u) * likeness(&here, row, &noise);
            if weight > 0.0 {
                steps.push(u);
                weights.push(weight);
                values.push(row);
            }
        }
        let good = |s: &Vec<f64>| s.iter().map(|v| v * v).sum::<f64>() <= ENOUGH;
        let bent = || shares::<3>(&steps, &weights).filter(good);
        let straight = || shares::<2>(&steps, &weights).filter(good);
        let Some(shares) = bent().or_else(straight).or_else(|| shares::<1>(&steps, &weights)) else { return here };
        std::array::from_fn(|c| shares.iter().zip(&values).map(|(s, v)| s * v[c]).sum())
    };
    (0..rows.len()).map(&mut value).collect()
}
