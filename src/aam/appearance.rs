//! How the look varies: a mean texture and a few modes, free of brightness and contrast.

use super::shape::principal;

/// Learns from readings of the same table, taken where each face's shape lies: the mean texture, then its modes, the
/// strongest first, each with the standard deviation along it as a share of a face's contrast. All are orthogonal to a constant and to each other, of length 1; what fills a reading up stays 0.
/// None where a reading is one flat grey.
pub(super) fn textures(readings: &[Vec<f32>], live: &[bool], share: f64, most: usize) -> Option<Vec<(Vec<f64>, f64)>> {
    let levelled: Vec<Vec<f64>> = readings.iter().map(|r| normal(r, live)).collect::<Option<_>>()?;
    let n = levelled.first()?.len();
    let mut mean = vec![0.0; n];
    for r in &levelled {
        mean.iter_mut().zip(r).for_each(|(m, v)| *m += v);
    }
    unit(&mut mean)?;
    // What is left of each face beside the mean texture at its own contrast.
    let rest: Vec<Vec<f64>> = levelled
        .iter()
        .map(|r| {
            let along = super::shape::dot(r, &mean);
            r.iter().zip(&mean).map(|(v, m)| v - along * m).collect()
        })
        .collect();
    let mut found = vec![(mean, 0.0)];
    let dof = (readings.len().max(2) - 1) as f64;
    found.extend(principal(&rest, share, most).into_iter().map(|(mode, square)| (mode, (square / dof).sqrt())));
    Some(found)
}

/// A reading with the mean 0 and the length 1.
pub(super) fn normal(reading: &[f32], live: &[bool]) -> Option<Vec<f64>> {
    let count = live.iter().filter(|l| **l).count().max(1) as f64;
    let mean = reading.iter().map(|v| f64::from(*v)).sum::<f64>() / count;
    let mut out: Vec<f64> =
        reading.iter().zip(live).map(|(v, live)| if *live { f64::from(*v) - mean } else { 0.0 }).collect();
    unit(&mut out)?;
    Some(out)
}

fn unit(v: &mut [f64]) -> Option<()> {
    let length = super::shape::dot(v, v).sqrt();
    if length < 1e-6 {
        return None;
    }
    v.iter_mut().for_each(|v| *v /= length);
    Some(())
}
