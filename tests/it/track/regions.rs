//! The region tracker beside the model's.

use super::*;
use lianpu::ratios::TrackRow;
use lianpu::track::by_regions;

/// One number of a row of tracks.
type Pick<'a> = &'a dyn Fn(&TrackRow) -> f64;

/// Pearson's correlation.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len() as f64;
    let (ma, mb) = (a.iter().sum::<f64>() / n, b.iter().sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(x, y)| f(x - ma, y - mb)).sum::<f64>();
    sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt().max(1e-12)
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn regions_follow_eyes_and_mouth_much_as_the_model_does() {
    let Some(franck) = &*FRANCK else { return };
    let source = Source::of(&franck.folder.join("frames"), 25.0).unwrap();
    let neutral = franck.folder.join("calibration/0565.jpg");
    let face = lianpu::face::create(&Photo::read(&neutral).unwrap(), "", None, None).unwrap().face;
    let began = std::time::Instant::now();
    let regions = by_regions(&source, &face, Some(&franck.calibration), &Options::default(), &mut |_, _| true).unwrap();
    println!("by regions: {:.2?}, {:?}", began.elapsed(), regions.notes);
    let model = tracked(franck, &source);
    if let Some(out) = std::env::var_os("TRACK_OUT") {
        std::fs::write(Path::new(&out).join("regions.csv"), regions.tracks.to_csv()).unwrap();
        std::fs::write(Path::new(&out).join("regions_ratios.csv"), regions.record.to_csv()).unwrap();
    }
    let of = |t: &Tracked, f: Pick| t.tracks.rows.iter().map(f).collect::<Vec<f64>>();
    let pairs: [(&str, Pick); 8] = [
        ("lids", &|r| 0.5 * (r.lids.left + r.lids.right)),
        ("mouth opening", &|r| r.mouth.up + r.mouth.down),
        ("mouth width", &|r| r.mouth.left + r.mouth.right),
        ("gaze x", &|r| r.gaze.x),
        ("gaze y", &|r| r.gaze.y),
        ("head x", &|r| r.head.x),
        ("head y", &|r| r.head.y),
        ("head roll", &|r| r.head.roll),
    ];
    let found = pairs.map(|(name, f)| (name, correlation(&of(&regions, f), &of(&model, f))));
    println!("  {found:.2?}");
    // Where the head is regions know; what eyes and mouth do they know roughly.
    let least = [0.1, 0.4, 0.2, -1.0, 0.1, 0.95, 0.9, 0.85];
    assert!(found.iter().zip(least).all(|((_, c), least)| *c > least), "{found:?}");
    let rows = &regions.record.rows;
    let kept = rows.iter().filter(|r| r.confidence > 0.0 && r.confidence < 0.5).count();
    println!(
        "  lost {}, old regions kept in {kept} of {}",
        rows.iter().filter(|r| r.confidence == 0.0).count(),
        rows.len()
    );
    assert!(rows.iter().filter(|r| r.confidence == 0.0).count() < 40 && kept < 120);
    assert!(rows.iter().all(|r| (r.ratios.sum() - 1.0).abs() < 1e-9));
}
