//! Makes the ratio record of `projects/seven-emotions`: a walk through the seven emotions and their mixtures.
//!
//! ```sh
//! cargo run --features tools --example seven-emotions > projects/seven-emotions/clips/walk/ratios.csv
//! ```

#![allow(clippy::print_stdout, reason = "printing is what it does")]

use lianpu::pose::{Emotion, Ratios};
use lianpu::ratios::{Record, Row};

const FPS: f64 = 25.0;

/// Seconds that a face is held, and seconds on the way to the next.
const HOLD: f64 = 0.8;
const WAY: f64 = 0.6;

fn main() {
    let mut stations: Vec<Ratios> = Vec::new();
    for emotion in &Emotion::ALL[1..] {
        stations.push(Ratios::NEUTRAL);
        stations.push(Ratios::pure(*emotion));
    }
    stations.push(Ratios::NEUTRAL);
    // Mixtures: glad surprise, fearful surprise, bitter smile, cold anger, and one with negative ratios as a
    // decomposition gives them.
    for mixture in [
        [0.0, 0.6, 0.0, 0.0, 0.0, 0.0, 0.4],
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.5],
        [0.1, 0.5, 0.0, 0.0, 0.4, 0.0, 0.0],
        [0.2, 0.0, 0.4, 0.4, 0.0, 0.0, 0.0],
        [0.66, -0.17, 0.08, -0.18, 0.44, 0.17, 0.0],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ] {
        stations.push(Ratios(mixture));
    }
    let step = HOLD + WAY;
    let frames = (step * stations.len() as f64 * FPS) as u32;
    let row = |frame: u32| {
        let time = f64::from(frame) / FPS;
        let place = ((time / step) as usize).min(stations.len() - 1);
        let next = stations[(place + 1).min(stations.len() - 1)];
        let u = ((time - place as f64 * step - HOLD) / WAY).clamp(0.0, 1.0);
        // No jerk at either end of the way.
        let eased = u * u * u * (u * (6.0 * u - 15.0) + 10.0);
        Row { frame, time, ratios: stations[place].lerp(next, eased), confidence: 1.0 }
    };
    let record = Record { rows: (0..frames).map(row).collect() };
    print!("{}", record.to_csv());
}
