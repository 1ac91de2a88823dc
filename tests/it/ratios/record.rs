//! The ratio record: how small it is, how true, and what damage does to it.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use std::path::Path;

use lianpu::aam::{Annotation, Fit, Fitter, Kind, Model, Options, Start};
use lianpu::calibration::{Binding, Calibration, Choice, Shape, Source};
use lianpu::face::FeaturePoint as P;
use lianpu::geometry::Point;
use lianpu::photo::Grey;
use lianpu::pose::{Gaze, Head, Lids, Ratios};
use lianpu::ratios::{LprReader, LprWriter, Moment, MouthMoves, Record, Row, TrackRow, Tracks, Whole, to_lpr};
use proptest::prelude::*;

fn load(folder: &Path, name: &str) -> (Grey, Vec<Point>) {
    let grey = Grey::read(&folder.join(format!("{name}.jpg"))).unwrap();
    let list = Annotation::read(&folder.join(format!("{name}.pts"))).unwrap();
    let points = list[0].in_pixels([grey.width(), grey.height()]);
    (grey, points)
}

/// Frames a second of the talking man.
const FPS: f64 = 25.0;

/// The talking man tracked, his seven calibration shots taken for emotions: 1241 frames of real movement and noise.
fn franck() -> Option<Record> {
    let folder = test_data::find("faces/franck")?;
    let shots: Vec<_> = ["0075", "0260", "0565", "1080", "1090", "1095", "1195"]
        .iter()
        .map(|name| load(&folder.join("calibration"), name))
        .collect();
    let pairs: Vec<(&Grey, &[Point])> = shots.iter().map(|(g, s)| (g, &s[..])).collect();
    let model = Model::train(&pairs, &Options { detect: false, ..Options::of(Kind::Person) }).unwrap();
    let shapes = std::array::from_fn(|i| Shape { points: shots[i].1.clone(), source: Source::Marked });
    let binding = Binding::of_rows(154, vec![(P::P3_6, vec![(152, 1.0)]), (P::P3_5, vec![(153, 1.0)])]);
    let calibration = Calibration::new(shapes, binding).unwrap();
    let mut fitter = Fitter::new(&model);
    let mut before: Option<Fit> = None;
    let row = |n: u32| {
        let grey = Grey::read(&folder.join(format!("frames/{n:04}.jpg"))).unwrap();
        let fit = match &before {
            Some(before) => fitter.follow(&grey, before),
            None => fitter.fit(&grey, Start::Points(&shots[0].1)),
        };
        let ratios = calibration.read(&fit.points, Choice::Paper).unwrap().ratios;
        let row = Row { frame: n, time: f64::from(n) / FPS, ratios, confidence: fit.confidence };
        before = Some(fit);
        row
    };
    Some(Record { rows: (0..1241).map(row).collect() })
}

/// The largest and the mean error of the seven ratios.
fn errors(a: &Record, b: &Record) -> (f64, f64) {
    assert_eq!(a.rows.len(), b.rows.len());
    let pairs = a.rows.iter().zip(&b.rows);
    let all: Vec<f64> = pairs.flat_map(|(a, b)| (0..7).map(|i| (a.ratios.0[i] - b.ratios.0[i]).abs())).collect();
    (all.iter().copied().fold(0.0, f64::max), all.iter().sum::<f64>() / all.len() as f64)
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn the_record_of_a_talking_man_is_small_and_true() {
    let Some(record) = franck() else { return };
    let bytes = to_lpr(&record, None, FPS).unwrap();
    let back = Whole::read(&bytes[..]).unwrap();
    let (most, mean) = errors(&record, &back.record);
    let count = record.rows.len();
    println!(
        "file: {count} frames in {} bytes, {:.2} a frame; error at most {most:.5}, mean {mean:.5}",
        bytes.len(),
        bytes.len() as f64 / count as f64
    );
    assert!(back.damage.is_none() && back.fps == FPS && back.tracks.is_none());
    assert!(bytes.len() <= 5000 && most <= 0.01 && mean <= 0.005, "{} {most} {mean}", bytes.len());
    for (a, b) in record.rows.iter().zip(&back.record.rows) {
        assert_eq!((a.frame, a.time), (b.frame, b.time));
        assert!((a.confidence - b.confidence).abs() <= 1.0 / 32.0 && (b.ratios.sum() - 1.0).abs() <= 1e-9);
    }
    let mut live = LprWriter::new(Vec::new(), FPS, false).unwrap();
    for row in &record.rows {
        live.push(&Moment { row: *row, track: None }).unwrap();
    }
    let live = live.finish().unwrap();
    println!("live, a packet a frame: {} bytes, {:.0} a second", live.len(), live.len() as f64 / count as f64 * FPS);
    assert_eq!(errors(&record, &Whole::read(&live[..]).unwrap().record), (most, mean));
}

/// A record with tracks: the walk of the seven emotions, and a face that looks about, blinks and speaks.
fn walk() -> (Record, Tracks) {
    let text = std::fs::read_to_string("projects/seven-emotions/clips/walk/ratios.csv").unwrap();
    let record = Record::parse(&text).unwrap();
    let of = |row: &Row| {
        let t = row.time;
        let open = if t % 3.0 < 0.12 { 0.0 } else { 1.0 };
        let track = TrackRow {
            frame: row.frame,
            time: t,
            gaze: Gaze { x: 0.4 * (0.7 * t).sin(), y: 0.1 * (1.3 * t).cos() },
            lids: Lids { left: open, right: open },
            mouth: MouthMoves { up: 0.1, down: (6.0 * t).sin().max(0.0), left: 0.03 * (5.0 * t).sin(), right: 0.0 },
            head: Head { x: 0.1 * (0.3 * t).sin(), y: 0.0, roll: 4.0 * (0.5 * t).sin() },
            confidence: row.confidence,
        };
        (row.frame % 50 != 7).then_some(track)
    };
    let tracks = Tracks { rows: record.rows.iter().filter_map(of).collect() };
    (record, tracks)
}

#[test]
fn the_walk_of_the_seven_emotions_is_smaller_still_and_tracks_come_back_as_an_eye_sees_them() {
    let (record, tracks) = walk();
    let alone = to_lpr(&record, None, FPS).unwrap();
    let both = to_lpr(&record, Some(&tracks), FPS).unwrap();
    let back = Whole::read(&both[..]).unwrap();
    let (most, mean) = errors(&record, &back.record);
    let count = record.rows.len();
    println!(
        "{count} frames: {} bytes, {} with tracks; error at most {most:.5}, mean {mean:.5}",
        alone.len(),
        both.len()
    );
    assert!(alone.len() < 1000 && both.len() < 5 * count && most <= 0.01 && mean <= 0.005);
    let found = back.tracks.unwrap();
    assert_eq!(found.rows.len(), tracks.rows.len());
    for (a, b) in tracks.rows.iter().zip(&found.rows) {
        assert_eq!((a.frame, a.time), (b.frame, b.time));
        assert!((a.gaze.x - b.gaze.x).abs() < 0.02 && (a.lids.left - b.lids.left).abs() < 0.02);
        assert!((a.mouth.down - b.mouth.down).abs() < 0.02 && (a.mouth.left - b.mouth.left).abs() < 0.01);
        assert!((a.head.x - b.head.x).abs() < 0.005 && (a.head.roll - b.head.roll).abs() < 0.1);
    }
    assert_eq!(to_lpr(&record, Some(&tracks), FPS).unwrap(), both, "the same input, the same bytes");
}

/// What can be read of bytes: the frames, and how it ended.
fn played(bytes: &[u8]) -> (Vec<Moment>, Option<String>) {
    let mut reader = match LprReader::new(bytes) {
        Ok(reader) => reader,
        Err(fault) => return (Vec::new(), Some(fault.to_string())),
    };
    let mut moments = Vec::new();
    loop {
        match reader.next_moment() {
            Ok(Some(moment)) => moments.push(moment),
            Ok(None) => return (moments, None),
            Err(fault) => {
                assert!(reader.next_moment().unwrap().is_none(), "after a fault it is over");
                return (moments, Some(fault.to_string()));
            }
        }
    }
}

#[test]
fn a_record_cut_or_damaged_at_any_byte_plays_up_to_there_and_says_so() {
    let (record, tracks) = walk();
    let record = Record { rows: record.rows[..160].to_vec() };
    for packet in [1, 64] {
        let mut writer = LprWriter::new(Vec::new(), FPS, true).unwrap().in_packets_of(packet);
        for row in &record.rows {
            let track = tracks.rows.iter().find(|t| t.frame == row.frame).copied();
            writer.push(&Moment { row: *row, track }).unwrap();
        }
        let bytes = writer.finish().unwrap();
        let (whole, said) = played(&bytes);
        assert!(whole.len() == 160 && said.is_none());
        let mut before = 0;
        for end in 0..bytes.len() {
            let (moments, said) = played(&bytes[..end]);
            assert!(said.is_some(), "cut at {end} of {}", bytes.len());
            assert!(moments.len() >= before && moments[..] == whole[..moments.len()]);
            before = moments.len();
        }
        assert_eq!(before, 160, "without its end mark every frame is there, and it counts as cut");
        let mut damaged = bytes.clone();
        for at in 0..bytes.len() {
            for by in [1, 0x80, 0xFF] {
                damaged[at] ^= by;
                let (moments, said) = played(&damaged);
                assert!(said.is_some(), "byte {at} changed by {by}");
                assert!(moments[..] == whole[..moments.len()], "byte {at} changed by {by}");
                damaged[at] ^= by;
            }
        }
    }
}

#[test]
fn every_frame_of_a_live_record_is_there_as_soon_as_its_bytes_are() {
    let (record, _) = walk();
    let (mut reader, mut writer) = std::io::pipe().map(|(r, w)| (Some(r), Some(w))).unwrap();
    let mut out = LprWriter::new(writer.take().unwrap(), FPS, false).unwrap();
    let mut back = LprReader::new(reader.take().unwrap()).unwrap();
    for row in &record.rows {
        out.push(&Moment { row: *row, track: None }).unwrap();
        // It would wait for ever for a byte that has not been sent.
        assert_eq!(back.next_moment().unwrap().unwrap().row.frame, row.frame);
    }
    drop(out.finish().unwrap());
    assert!(back.next_moment().unwrap().is_none());
}

#[test]
fn what_cannot_be_written_is_refused_and_later_versions_are_named() {
    for fps in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        assert!(LprWriter::new(Vec::new(), fps, false).is_err());
    }
    let row = |frame, time, ratio: f64| Row {
        frame,
        time,
        ratios: Ratios([1.0 - ratio, ratio, 0.0, 0.0, 0.0, 0.0, 0.0]),
        confidence: 1.0,
    };
    let mut writer = LprWriter::new(Vec::new(), FPS, false).unwrap();
    writer.push(&Moment { row: row(3, 0.12, 0.5), track: None }).unwrap();
    for bad in [row(3, 0.16, 0.0), row(4, 0.12, 0.0), row(4, f64::NAN, 0.0), row(4, 0.16, f64::NAN), row(4, 0.16, 1e9)]
    {
        assert!(writer.push(&Moment { row: bad, track: None }).is_err(), "{bad:?}");
    }
    let mut bytes = writer.finish().unwrap();
    bytes[4] = 2;
    assert!(LprReader::new(&bytes[..]).unwrap_err().what().contains("version 2"));
    assert!(LprReader::new(&b"frame,time"[..]).is_err() && LprReader::new(&b""[..]).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_record_comes_back(
        rows in prop::collection::vec((1..400_u32, prop::array::uniform6(prop_oneof![-1.5..1.5_f64, Just(0.0), Just(1.0), -900.0..900.0_f64]), prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64]), 1..40),
        fps in prop_oneof![Just(25.0), Just(30.0), Just(30_000.0 / 1001.0), 1.0..240.0_f64],
        shift in prop_oneof![Just(0.0), 0.0..10.0_f64],
        tremble in prop::bool::ANY,
        packet in 1..70_u32,
    ) {
        let mut frame = 0;
        let mut made = Vec::new();
        for (gap, six, confidence) in rows {
            frame += gap;
            let shake = if tremble { f64::from(gap % 7) * 1e-4 } else { 0.0 };
            let time = f64::from(frame) / fps + shift + shake;
            let mut ratios = [0.0; 7];
            ratios[1..].copy_from_slice(&six.map(|v| v / 6.0));
            let row = Row { frame, time, ratios: Ratios(ratios).closed(), confidence };
            made.push(row);
        }
        made.dedup_by(|b, a| (b.time * 1e6).round() <= (a.time * 1e6).round());
        let mut writer = LprWriter::new(Vec::new(), fps, false).unwrap().in_packets_of(packet);
        for row in &made {
            writer.push(&Moment { row: *row, track: None }).unwrap();
        }
        let bytes = writer.finish().unwrap();
        let (moments, said) = played(&bytes);
        prop_assert!(said.is_none(), "{said:?}");
        prop_assert_eq!(moments.len(), made.len());
        for (a, b) in made.iter().zip(&moments) {
            let b = b.row;
            prop_assert_eq!(a.frame, b.frame);
            prop_assert!((a.time - b.time).abs() <= 1e-6);
            prop_assert!((0..7).all(|i| (a.ratios.0[i] - b.ratios.0[i]).abs() <= 0.01 + 1e-9), "{:?} {:?}", a, b);
            prop_assert!((b.ratios.sum() - 1.0).abs() <= 1e-9);
            prop_assert!((a.confidence - b.confidence).abs() <= 1.0 / 32.0 && (a.confidence == 0.0) == (b.confidence == 0.0));
        }
    }

    #[test]
    fn random_bytes_are_no_record_and_no_panic(bytes in prop::collection::vec(any::<u8>(), 0..600), tracks in any::<bool>()) {
        played(&bytes);
        // With a good head and good check sums, so that the decoder sees them.
        let mut record = LprWriter::new(Vec::new(), 25.0, tracks).unwrap().finish().unwrap();
        record.truncate(18);
        let mut check = record[14..18].to_vec();
        for payload in bytes.chunks(120) {
            let mut packet = vec![payload.len() as u8 + 1];
            packet.extend(payload);
            let mut hash = crc32fast::Hasher::new();
            hash.update(&check);
            hash.update(&packet);
            check = hash.finalize().to_le_bytes().to_vec();
            record.extend(packet);
            record.extend(&check);
        }
        let (moments, said) = played(&record);
        prop_assert!(said.is_some() || moments.is_empty());
        for moment in moments {
            prop_assert!(moment.row.ratios.0.iter().all(|r| r.is_finite()) && (0.0..=1.0).contains(&moment.row.confidence));
        }
    }
}
