//! How close, how steady, and what is left of blinks and closures.

use super::*;
use lianpu::aam::{Fitter, Start};
use lianpu::track::Follower;

/// The points of every frame as another tracker sees them.
fn agreement(franck: &Franck) -> Vec<Vec<Point>> {
    let table = std::fs::read_to_string(franck.folder.join("agreement_points.csv")).unwrap();
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').skip(1).map(|v| v.parse().unwrap()).collect();
        numbers.chunks_exact(2).map(|c| Point::new(c[0], c[1])).collect()
    };
    table.lines().skip(1).map(row).collect()
}

/// The opening of both eyes and of the lips in a shape, in pupil distances.
fn openings(franck: &Franck, shape: &[Point]) -> [f64; 2] {
    let at = |name| franck.calibration.binding().at(shape, name).unwrap();
    let pupils = at(P::P3_6).distance(at(P::P3_5));
    let eyes = at(P::P3_2).distance(at(P::P3_4)) + at(P::P3_1).distance(at(P::P3_3));
    [0.5 * eyes / pupils, at(P::P2_2).distance(at(P::P2_3)) / pupils]
}

/// Dips of a series to below `share` of its median: from where to where, and how deep.
fn dips(series: &[f64], share: f64) -> Vec<(usize, usize, f64)> {
    let mut sorted = series.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    let mut found: Vec<(usize, usize, f64)> = Vec::new();
    for (n, v) in series.iter().map(|v| v / median).enumerate().filter(|(_, v)| *v < share) {
        match found.last_mut() {
            Some((_, to, least)) if *to + 1 == n => (*to, *least) = (n, least.min(v)),
            _ => found.push((n, n, v)),
        }
    }
    found
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_talking_man_is_tracked_without_loss_closely_steadily_and_with_his_blinks() {
    let Some(franck) = &*FRANCK else { return };
    let source = Source::of(&franck.folder.join("frames"), 25.0).unwrap();
    let began = std::time::Instant::now();
    let tracked = tracked(franck, &source);
    println!("frames to ratios: {:.2?}, {:?}", began.elapsed(), tracked.notes);
    if let Some(out) = std::env::var_os("TRACK_OUT") {
        std::fs::write(Path::new(&out).join("ratios.csv"), tracked.record.to_csv()).unwrap();
        std::fs::write(Path::new(&out).join("tracks.csv"), tracked.tracks.to_csv()).unwrap();
    }
    assert_eq!(tracked.record.rows.len(), 1241);
    assert!(tracked.record.rows.iter().all(|r| r.confidence >= 0.5 && (r.ratios.sum() - 1.0).abs() < 1e-9));

    // The shapes behind it, and what a fit alone gives that holds nothing.
    let truth = agreement(franck);
    let mut follower = Follower::new(&franck.model, &franck.calibration);
    let mut fitter = Fitter::new(&franck.model);
    let (mut shapes, mut raw) = (Vec::new(), Vec::<Vec<Point>>::new());
    for frame in source.frames().unwrap() {
        let grey = frame.unwrap().grey;
        shapes.push(follower.next(&grey).unwrap().points.clone());
        raw.push(fitter.fit(&grey, Start::Near(raw.last().unwrap_or(&shapes[0]))).points);
    }
    let pupils: Vec<f64> = truth.iter().map(|t| t[152].distance(t[153])).collect();
    let off = |n: usize| {
        shapes[n].iter().zip(&truth[n]).map(|(a, b)| a.distance(*b)).sum::<f64>() / truth[n].len() as f64 / pupils[n]
    };
    let agreement = 100.0 * (0..shapes.len()).map(off).sum::<f64>() / shapes.len() as f64;
    let mut trembles: Vec<f64> = shapes
        .windows(4)
        .zip(&pupils)
        .map(|(w, pupils)| {
            let third = |k: usize| {
                let at = |i: usize| w[i][k].to_vec2();
                (at(3) - 3.0 * at(2) + 3.0 * at(1) - at(0)).hypot2()
            };
            let square = (0..w[0].len()).map(third).sum::<f64>() / w[0].len() as f64;
            100.0 * (square / 20.0).sqrt() / pupils
        })
        .collect();
    trembles.sort_by(f64::total_cmp);
    let jitter = trembles[trembles.len() / 2];
    println!("agreement {agreement:.2} %, jitter {jitter:.3} %");
    assert!(agreement <= 2.0 && jitter <= 0.09);

    // Blinks: as the fit has them, and as they come out at the end.
    let opening = |shapes: &[Vec<Point>], which: usize| -> Vec<f64> {
        shapes.iter().map(|s| openings(franck, s)[which]).collect()
    };
    let [fitted, seen] = [&raw, &truth].map(|s| opening(s, 0));
    let lids: Vec<f64> = tracked.tracks.rows.iter().map(|r| 0.5 * (r.lids.left + r.lids.right)).collect();
    let blinks = dips(&fitted, 0.5);
    let kept: Vec<f64> = blinks
        .iter()
        .map(|(from, to, _)| {
            lids[from.saturating_sub(1)..=(to + 1).min(lids.len() - 1)].iter().copied().fold(9.0, f64::min)
        })
        .collect();
    println!(
        "blinks: {} in the fit, {} in the other tracker's points, {} in the track",
        blinks.len(),
        dips(&seen, 0.5).len(),
        dips(&lids, 0.5).len()
    );
    println!("  fit {:.2?}\n  track {kept:.2?}", blinks.iter().map(|b| b.2).collect::<Vec<_>>());
    // Closures of the mouth.
    let lips = opening(&raw, 1);
    let gap: Vec<f64> = tracked.tracks.rows.iter().map(|r| r.mouth.up + r.mouth.down).collect();
    println!("mouth: gap of the fit {:.3?}, of the track {:.3?}", quantiles(&lips), quantiles(&gap));
    // A blink that the fit has is one in the track, and about as deep.
    let shallow = blinks.iter().zip(&kept).filter(|(b, kept)| **kept > b.2 + 0.12).count();
    assert!(blinks.len() >= 10 && shallow == 0, "{shallow} of {} blinks are cut", blinks.len());
    let shut = lips.iter().zip(&gap).filter(|(lips, gap)| **lips < 0.01 && **gap > 0.15).count();
    println!("  {shut} frames with closed lips come out open");
    assert!(shut <= 6);
}
