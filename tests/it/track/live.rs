//! Frames as they come.

use super::*;
use lianpu::ratios::LprReader;
use lianpu::track::{Live, relay};

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn live_frames_are_answered_one_by_one_and_near_what_the_whole_video_gives() {
    let Some(franck) = &*FRANCK else { return };
    let stage = staged(franck, 100, 100, |n, g| if (50..55).contains(&n) { pixels(g, |_, _| 7) } else { g.clone() });
    let source = Source::of(stage.path(), 25.0).unwrap();
    let whole = tracked(franck, &source);
    let mut live = Live::new(&franck.model, &franck.calibration, &Options::default()).unwrap();
    let mut worst = 0.0_f64;
    for (frame, row) in source.frames().unwrap().map(Result::unwrap).zip(&whole.record.rows) {
        let moment = live.next(&frame.grey, frame.number, frame.time);
        assert_eq!((moment.row.frame, moment.row.confidence == 0.0), (row.frame, (50..55).contains(&row.frame)));
        if moment.row.confidence > 0.0 {
            let off = moment.row.ratios.0.iter().zip(row.ratios.0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            worst = worst.max(off);
        }
    }
    println!("live against whole: ratios off by {worst:.3} at most");
    assert!(worst < 0.25);
}

/// A writer that is closed after so many bytes, as a pipe is whose reader has gone.
struct Closing(usize);

impl std::io::Write for Closing {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.0 < bytes.len() {
            return Err(std::io::ErrorKind::BrokenPipe.into());
        }
        self.0 -= bytes.len();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_stream_of_frames_becomes_a_record_and_a_cut_or_a_closed_pipe_ends_it_cleanly() {
    let Some(franck) = &*FRANCK else { return };
    let mut bytes = b"YUV4MPEG2 W360 H288 F25:1 Cmono XCOLORRANGE=FULL\n".to_vec();
    for n in 0..12 {
        bytes.extend(b"FRAME\n");
        bytes.extend(Grey::read(&frame_path(franck, n)).unwrap().pixels());
    }
    let mut out = Vec::new();
    let done = relay(&bytes[..], &mut out, &franck.model, &franck.calibration, &Options::default()).unwrap();
    assert_eq!(done, (12, 0));
    let read = |out: &[u8]| {
        let mut reader = LprReader::new(out).unwrap();
        std::iter::from_fn(|| reader.next_moment().ok().flatten()).count()
    };
    println!("12 frames: {} bytes", out.len());
    assert_eq!(read(&out), 12);
    let mut part = Vec::new();
    let cut = &bytes[..bytes.len() - 1000];
    let fault = relay(cut, &mut part, &franck.model, &franck.calibration, &Options::default()).unwrap_err();
    assert!(fault.what().contains("frame 11"), "{fault}");
    assert_eq!(read(&part), 11);
    let fault = relay(&bytes[..], Closing(60), &franck.model, &franck.calibration, &Options::default()).unwrap_err();
    let cause = std::error::Error::source(&fault).and_then(|e| e.downcast_ref::<std::io::Error>());
    assert_eq!(cause.map(std::io::Error::kind), Some(std::io::ErrorKind::BrokenPipe), "{fault}");
}
