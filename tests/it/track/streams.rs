//! Streams of frames: YUV4MPEG2 in its kinds, cut and damaged; videos by ffmpeg, and by a program that plays it.

use super::*;
use lianpu::media::{Ffmpeg, Scan, Y4m};

/// A stream of `frames` pictures of 6 × 4 pixels.
fn stream(head: &str, size: usize, frames: usize) -> Vec<u8> {
    let mut bytes = format!("YUV4MPEG2 W6 H4 {head}\n").into_bytes();
    for n in 0..frames {
        bytes.extend(b"FRAME\n");
        bytes.extend((0..size).map(|i| (16 + 10 * n + i % 24) as u8));
    }
    bytes
}

#[test]
fn every_kind_of_stream_is_read_and_its_greys_are_the_same() {
    let mut greys = Vec::new();
    for (kind, size) in [
        ("C420jpeg", 36),
        ("C420mpeg2 Ip", 36),
        ("C422 A1:1", 48),
        ("C444 Ib", 72),
        ("Cmono", 24),
        ("C411", 40),
        ("C444alpha", 96),
        ("", 36),
    ] {
        let bytes = stream(&format!("F30000:1001 {kind}"), size, 3);
        let mut y4m = Y4m::new(&bytes[..]).unwrap();
        assert!((y4m.fps() - 29.97).abs() < 0.01 && y4m.size() == [6, 4], "{kind}");
        assert_eq!(y4m.scan() == Scan::Interlaced, kind.contains("Ib"));
        let frames: Vec<_> = std::iter::from_fn(|| y4m.next_frame().unwrap()).collect();
        assert_eq!(frames.len(), 3, "{kind}");
        assert_eq!((frames[2].number, frames[2].photo().unwrap().width()), (2, 6));
        greys.push(frames[1].grey.clone());
    }
    assert!(greys.windows(2).all(|w| w[0] == w[1]));
    let full = stream("F25:1 C420jpeg XCOLORRANGE=FULL", 36, 1);
    let frame = Y4m::new(&full[..]).unwrap().next_frame().unwrap().unwrap();
    assert_eq!(frame.grey.pixels()[0], 16);
    assert_eq!(greys[0].pixels()[0], 12);
}

#[test]
fn a_stream_cut_anywhere_says_which_frame_and_one_that_is_none_says_so() {
    let whole = stream("F25:1 C420", 36, 2);
    let head = whole.iter().position(|b| *b == b'\n').unwrap() + 1;
    for end in 0..whole.len() {
        let mut frames = 0;
        let outcome = Y4m::new(&whole[..end]).and_then(|mut y4m| {
            while y4m.next_frame()?.is_some() {
                frames += 1;
            }
            Ok(())
        });
        let boundary = end == head || end == head + 42;
        assert_eq!(outcome.is_ok(), boundary, "{end}");
        assert_eq!(frames, end.saturating_sub(head) / 42);
        if let (Err(fault), true) = (outcome, end > head) {
            assert!(fault.what().contains(&format!("frame {}", (end - head) / 42)), "{fault}");
        }
    }
    for (text, found) in [
        ("YUV4MPEG2 W6 H4\n", "frame rate"),
        ("YUV4MPEG2 H4 F25:1\n", "width"),
        ("YUV4MPEG2 W6 H4 F25:0\n", "25:0"),
        ("YUV4MPEG2 W6 H4 F0:1\n", "0:1"),
        ("YUV4MPEG2 W99999 H4 F25:1\n", "99999"),
        ("YUV4MPEG2 W8192 H8192 F25:1\n", "8192 × 8192"),
        ("YUV4MPEG2 W-6 H4 F25:1\n", "-6"),
        ("YUV4MPEG2 W6 H4 F25:1 C420p10\n", "420p10"),
        ("RIFF....AVI LIST", "no YUV4MPEG2"),
        ("", "empty"),
    ] {
        let fault = Y4m::new(text.as_bytes()).unwrap_err();
        assert!(fault.what().contains(found) && !fault.next_step().is_empty(), "{text}: {fault}");
    }
    let endless = [b"YUV4MPEG2 ".to_vec(), vec![b'W'; 10_000]].concat();
    assert!(Y4m::new(&endless[..]).is_err());
    let mut wrong = stream("F25:1 C420", 36, 2);
    wrong[head + 43] = b'X';
    let mut y4m = Y4m::new(&wrong[..]).unwrap();
    y4m.next_frame().unwrap().unwrap();
    assert!(y4m.next_frame().unwrap_err().what().contains("frame 1"));
}

#[test]
fn a_stream_in_a_file_is_a_video_without_ffmpeg() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("video.y4m");
    std::fs::write(&path, stream("F25:1 C420", 36, 5)).unwrap();
    let source = Source::of(&path, 99.0).unwrap();
    assert_eq!((source.fps(), source.count(), source.duration()), (25.0, Some(5), Some(0.2)));
    let all: Vec<_> = source.frames().unwrap().map(Result::unwrap).collect();
    assert_eq!(all.len(), 5);
    assert_eq!(source.frame(3).unwrap(), all[3].photo().unwrap());
    assert_eq!(source.frame_at(0.12).unwrap(), all[3].photo().unwrap());
    assert_eq!(source.frame_at(7.0).unwrap(), all[4].photo().unwrap());
    assert!(source.frame(5).unwrap_err().what().contains("no frame 5"));
    let print = source.fingerprint().unwrap();
    let mut changed = std::fs::read(&path).unwrap();
    let last = changed.len() - 1;
    changed[last] ^= 1;
    std::fs::write(&path, changed).unwrap();
    assert_ne!(print, source.fingerprint().unwrap());
    assert_eq!(print.len(), 64);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_folder_s_frames_have_one_size_and_a_damaged_one_is_named() {
    let Some(franck) = &*FRANCK else { return };
    let dir = staged(franck, 0, 6, |n, g| if n == 4 { Grey::new(20, 20, vec![9; 400]) } else { g.clone() });
    let mut frames = Source::of(dir.path(), 25.0).unwrap().frames().unwrap();
    assert_eq!(frames.by_ref().take(4).filter(Result::is_ok).count(), 4);
    let fault = frames.next().unwrap().unwrap_err();
    assert!(fault.to_string().contains("4.png") && fault.what().contains("20 × 20"), "{fault}");
    assert!(frames.next().is_none());
    std::fs::write(dir.path().join("2.png"), b"\x89PNG nothing").unwrap();
    let fault = Source::of(dir.path(), 25.0).unwrap().frames().unwrap().find_map(Result::err).unwrap();
    assert!(fault.to_string().contains("2.png"), "{fault}");
    assert!(Source::of(dir.path(), 0.0).is_err() && Source::of(dir.path(), f64::NAN).is_err());
    // One that is dropped in the middle ends its thread.
    assert_eq!(Source::of(&franck.folder.join("frames"), 25.0).unwrap().frames().unwrap().take(2).count(), 2);
}

#[cfg(unix)]
fn script(folder: &Path, text: &str) -> Ffmpeg {
    let path = folder.join("ffmpeg");
    // By a program of its own: a file that this process has open for writing may be in the hands of a child that another
    // test starts at that moment, and cannot be run then.
    let write = "printf '#!/bin/sh\\n%s\\n' \"$1\" > \"$0\" && chmod 755 \"$0\"";
    let mut shell = std::process::Command::new("/bin/sh");
    assert!(shell.args(["-c", write]).arg(&path).arg(text).status().unwrap().success());
    Ffmpeg::at(&path)
}

#[cfg(unix)]
#[test]
fn a_video_comes_through_the_program_and_what_it_says_is_heard() {
    let dir = tempfile::tempdir().unwrap();
    let video = dir.path().join("-odd name;.mp4");
    std::fs::write(&video, b"a video").unwrap();
    std::fs::write(dir.path().join("stream"), stream("F30:1 C420", 36, 7)).unwrap();
    let said = "echo '  Duration: 00:00:00.23, start: 0' >&2";
    let play = script(
        dir.path(),
        &format!("{said}; echo \"$@\" >> \"$(dirname \"$0\")/calls\"; cat \"$(dirname \"$0\")/stream\""),
    );
    let source = Source::of_video(&video, play).unwrap();
    assert_eq!((source.fps(), source.count()), (30.0, Some(7)));
    assert_eq!(source.frames().unwrap().map(Result::unwrap).count(), 7);
    let calls = std::fs::read_to_string(dir.path().join("calls")).unwrap();
    assert!(calls.lines().all(|l| l.contains("-protocol_whitelist file,pipe -i file:")), "{calls}");

    // It fails at once; it fails in the middle; it never ends and is left.
    let fails = script(dir.path(), "printf 'moov atom \\033[31mnot found\\n' >&2; exit 1");
    let fault = Source::of_video(&video, fails).unwrap_err();
    assert!(fault.what().contains("moov atom [31mnot found") && !fault.what().contains('\u{1b}'), "{fault}");
    script(dir.path(), "head -c 160 \"$(dirname \"$0\")/stream\"; echo 'broken file' >&2; exit 1");
    let outcome: Vec<_> = source.frames().unwrap().collect();
    let fault = outcome.into_iter().find_map(Result::err).unwrap();
    assert!(fault.what().contains("broken file"), "{fault}");
    script(dir.path(), "cat \"$(dirname \"$0\")/stream\"; exec sleep 600");
    let began = std::time::Instant::now();
    assert_eq!(source.frames().unwrap().take(3).filter(Result::is_ok).count(), 3);
    assert!(began.elapsed().as_secs() < 20);
}

#[test]
#[cfg_attr(not(all(has_data, has_ffmpeg)), ignore = "needs LIANPU_DATA")]
fn a_real_ffmpeg_reads_a_real_video() {
    let Some(clip) = test_data::find("faces/grid/bbaf2n.mpg") else { return };
    if Ffmpeg::find().is_err() {
        println!("no ffmpeg here: nothing checked");
        return;
    }
    let source = Source::of(&clip, 0.0).unwrap();
    let frames: Vec<_> = source.frames().unwrap().map(Result::unwrap).collect();
    println!(
        "{} fps, {:?} frames promised, {} there, {:?} s",
        source.fps(),
        source.count(),
        frames.len(),
        source.duration()
    );
    assert!((74..=76).contains(&frames.len()) && source.fps() == 25.0);
    let [w, h] = [frames[0].grey.width(), frames[0].grey.height()];
    for n in [0, 10, 40] {
        let photo = source.frame(n).unwrap();
        assert_eq!([photo.width(), photo.height()], [w, h]);
        let off = |k: usize| -> f64 {
            let (a, b) = (Grey::of(&photo), &frames[k].grey);
            a.pixels().iter().zip(b.pixels()).map(|(x, y)| f64::from(x.abs_diff(*y))).sum::<f64>() / (w * h) as f64
        };
        let best = (0..frames.len()).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap();
        println!("frame {n}: nearest {best}, off by {:.2}", off(n as usize));
        assert!(best.abs_diff(n as usize) <= 1);
    }
    let dir = tempfile::tempdir().unwrap();
    let wav = dir.path().join("speech.wav");
    lianpu::media::sound_of(&clip, &wav).unwrap();
    let sound = lianpu::media::Sound::read(&wav).unwrap();
    assert!((sound.duration() - 3.0).abs() < 0.2, "{}", sound.duration());
    let silent = clip.with_file_name("LICENSES.md");
    assert!(lianpu::media::sound_of(&silent, &wav).is_err());
}
