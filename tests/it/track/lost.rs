//! What cannot be seen is lost, said, and found again.

use super::*;

/// Frames of a stage, and what is known of the same ones unharmed; which of them are lost, and how wrong the others are.
fn judge(name: &str, franck: &Franck, first: usize, stage: &Path, moved: impl Fn(usize) -> Option<f64>) -> Vec<bool> {
    let tracked = tracked(franck, &Source::of(stage, 25.0).unwrap());
    let count = tracked.record.rows.len();
    let whole = staged(franck, first, count, |_, g| g.clone());
    let truth = self::tracked(franck, &Source::of(whole.path(), 25.0).unwrap());
    let lost: Vec<bool> = tracked.record.rows.iter().map(|r| r.confidence == 0.0).collect();
    let mut worst = [0.0_f64; 2];
    for n in (0..count).filter(|n| !lost[*n]) {
        let (a, b) = (&tracked.record.rows[n].ratios, &truth.record.rows[n].ratios);
        worst[0] = a.0.iter().zip(b.0).map(|(x, y)| (x - y).abs()).fold(worst[0], f64::max);
        let (a, b) = (&tracked.tracks.rows[n].lids, &truth.tracks.rows[n].lids);
        worst[1] = (a.left - b.left).abs().max((a.right - b.right).abs()).max(worst[1]);
        assert!(moved(n).is_some(), "{name}: frame {n} shows no face and is not lost");
    }
    assert!(worst[0] < 0.45 && worst[1] < 0.3, "{name}: what is not lost is wrong: {worst:?}");
    println!(
        "{name}: lost {} of {count}; elsewhere ratios off by {:.3}, lids by {:.3} at most; {:?}",
        lost.iter().filter(|l| **l).count(),
        worst[0],
        worst[1],
        tracked.notes
    );
    lost
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn what_cannot_be_seen_is_lost_said_and_found_again() {
    let Some(franck) = &*FRANCK else { return };
    let black = staged(franck, 100, 60, |n, g| if (20..30).contains(&n) { pixels(g, |_, _| 0) } else { g.clone() });
    let lost = judge("black", franck, 100, black.path(), |n| (!(20..30).contains(&n)).then_some(0.0));
    assert_eq!((0..60).filter(|n| lost[*n]).collect::<Vec<_>>(), (20..30).collect::<Vec<_>>());

    // A hand comes up over mouth and nose and goes.
    let hand = |n: usize, g: &Grey| {
        let top = 300 - 18 * (n as isize - 15).clamp(0, 10) + 18 * (n as isize - 35).clamp(0, 10);
        let (w, from) = (g.width() as isize, g.pixels());
        pixels(g, |x, y| {
            let inside = y > top + (x - 175).pow(2) / 60;
            if inside {
                (130 + (x * 7 + y * 3) % 11 + ((x - 140) % 28 < 3) as isize * -25) as u8
            } else {
                from[(y * w + x) as usize]
            }
        })
    };
    let stage = staged(franck, 100, 60, hand);
    if let Some(out) = std::env::var_os("TRACK_OUT") {
        std::fs::copy(stage.path().join("24.png"), Path::new(&out).join("hand.png")).unwrap();
    }
    let lost = judge("hand", franck, 100, stage.path(), |_| Some(0.0));
    assert!((24..36).all(|n| lost[n]) && !(0..20).chain(41..60).any(|n| lost[n]), "{lost:?}");

    // He leaves to the right and comes back from the left.
    let away = |n: usize| match n as isize {
        n @ 0..20 => n * 12,
        n @ 20..40 => n * 12,
        n => (n - 59) * 12,
    };
    let stage = staged(franck, 100, 60, |n, g| shifted(g, away(n)));
    let lost = judge("away", franck, 100, stage.path(), |n| (away(n).abs() < 170).then_some(0.0));
    assert!(!lost[..10].iter().chain(&lost[53..]).any(|l| *l), "{lost:?}");

    // A cut to another man, and back to where he sits elsewhere.
    let other = test_data::find("faces/imm_frontal").map(|f| Grey::read(&f.join("01_01.jpg")).unwrap());
    let other = other.map(|o| {
        let image = image::GrayImage::from_raw(o.width() as u32, o.height() as u32, o.pixels().to_vec()).unwrap();
        image::imageops::resize(&image, 360, 288, image::imageops::FilterType::Triangle).into_raw()
    });
    if let Some(other) = other {
        let cut = |n: usize, g: &Grey| match n {
            0..20 => g.clone(),
            20..40 => Grey::new(360, 288, other.clone()),
            _ => shifted(g, 70),
        };
        let stage = staged(franck, 100, 60, cut);
        let lost = judge("cut", franck, 100, stage.path(), |n| (!(20..40).contains(&n)).then_some(0.0));
        assert_eq!((0..60).filter(|n| lost[*n]).collect::<Vec<_>>(), (20..40).collect::<Vec<_>>());
    }

    // The camera hangs.
    let held = Grey::read(&frame_path(franck, 120)).unwrap();
    let stage = staged(franck, 100, 60, |n, g| if (20..30).contains(&n) { held.clone() } else { g.clone() });
    let tracked = tracked(franck, &Source::of(stage.path(), 25.0).unwrap());
    assert!(tracked.record.rows.iter().all(|r| r.confidence > 0.5), "a frame like the one before is no harm");
}
