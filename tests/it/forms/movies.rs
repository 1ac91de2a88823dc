//! Moving pictures, read back by other readers: what they show and when, and that sound and mouth agree. Those that need
//! `ffmpeg` say so where it is missing.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::cell::Cell;
use std::fs::{self, File};
use std::io::BufReader;
use std::ops::Range;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};

use lianpu::disk::Result;
use lianpu::drawing::Colour;
use lianpu::drawing::Picture;
use lianpu::forms::movie::{self, Container, Film};
use lianpu::forms::{Frames, Outcome, Watch, apng, gif};
use lianpu::media::Sound;
use lianpu::timing::{Interval, Tier};

/// A disc with soft edges that wanders over a field, stands still now and then, and at `flashes` fills everything.
struct Disc {
    count: u32,
    clear: bool,
    flashes: Vec<u32>,
    picture: Picture,
}

impl Disc {
    fn new(size: [u32; 2], count: u32, clear: bool) -> Self {
        let picture = Picture::filled(size[0] as usize, size[1] as usize, [0; 4]);
        Self { count, clear, flashes: Vec::new(), picture }
    }

    fn shown(&mut self, n: u32) -> Vec<u8> {
        self.show(n).unwrap();
        self.picture.pixels().as_flattened().to_vec()
    }
}

impl Frames for Disc {
    fn size(&self) -> [u32; 2] {
        [self.picture.width(), self.picture.height()].map(|side| side as u32)
    }

    fn count(&self) -> u32 {
        self.count
    }

    fn show(&mut self, n: u32) -> Result<(Range<u32>, Range<u32>)> {
        // Every third frame is held.
        let step = f64::from(n - u32::from(n % 3 == 2));
        let [width, height] = self.size();
        let at = [0.5 + 0.3 * (step * 0.21).sin(), 0.5 + 0.3 * (step * 0.13).cos()];
        let middle = [at[0] * f64::from(width), at[1] * f64::from(height)];
        let flash = self.flashes.contains(&n);
        for (i, p) in self.picture.pixels_mut().iter_mut().enumerate() {
            let (x, y) = ((i as u32 % width) as f64 + 0.5, (i as u32 / width) as f64 + 0.5);
            let far = (x - middle[0]).hypot(y - middle[1]);
            let cover = if flash { 1.0 } else { (f64::from(height) / 5.0 - far + 0.5).clamp(0.0, 1.0) };
            let ink = [200.0, 90.0 + y / f64::from(height) * 40.0, 60.0];
            let field = [231.0, 234.0, 213.0];
            if self.clear {
                let alpha = (cover * 255.0).round() as u8;
                p.copy_from_slice(&[ink[0] as u8, ink[1] as u8, ink[2] as u8, alpha]);
                if alpha == 0 {
                    // Below, what can hardly be seen is white.
                    p.copy_from_slice(if y > f64::from(height) * 0.75 { &[255, 255, 255, 1] } else { &[0; 4] });
                }
            } else {
                (0..3).for_each(|k| p[k] = (field[k] + (ink[k] - field[k]) * cover).round() as u8);
                p[3] = 255;
            }
        }
        Ok((0..width, 0..height))
    }

    fn picture(&self) -> &Picture {
        &self.picture
    }
}

fn watched<T>(run: impl FnOnce(&Watch<'_>) -> T) -> T {
    let stop = AtomicBool::new(false);
    run(&Watch { progress: &|_| {}, stop: &stop })
}

/// What a GIF shows at each hundredth of a second.
fn played_gif(path: &Path) -> ([u32; 2], Vec<(u64, Vec<u8>)>) {
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut reader = options.read_info(BufReader::new(File::open(path).unwrap())).unwrap();
    let size = [u32::from(reader.width()), u32::from(reader.height())];
    let mut canvas = vec![0_u8; (size[0] * size[1] * 4) as usize];
    let (mut shown, mut time) = (Vec::new(), 0);
    while let Some(frame) = reader.read_next_frame().unwrap() {
        let place = |i: usize| {
            let (x, y) = (i % usize::from(frame.width), i / usize::from(frame.width));
            ((y + usize::from(frame.top)) * size[0] as usize + x + usize::from(frame.left)) * 4
        };
        for (i, p) in frame.buffer.chunks_exact(4).enumerate() {
            if p[3] > 0 {
                canvas[place(i)..][..4].copy_from_slice(p);
            }
        }
        assert!(frame.delay >= 2, "a delay that viewers do not keep");
        shown.push((time, canvas.clone()));
        time += u64::from(frame.delay);
        if frame.dispose == ::gif::DisposalMethod::Background {
            for i in 0..usize::from(frame.width) * usize::from(frame.height) {
                canvas[place(i)..][..4].fill(0);
            }
        }
    }
    shown.push((time, Vec::new()));
    (size, shown)
}

fn at_time(shown: &[(u64, Vec<u8>)], hundredth: u64) -> &[u8] {
    &shown.iter().rev().find(|s| s.0 <= hundredth).unwrap().1
}

/// The largest and the mean difference of two pictures laid on white.
fn difference(a: &[u8], b: &[u8]) -> (u8, f64) {
    let white = |p: &[u8], k: usize| (f64::from(p[k]) * f64::from(p[3]) + 255.0 * f64::from(255 - p[3])) / 255.0;
    let (mut most, mut sum) = (0.0_f64, 0.0);
    for (p, q) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
        for k in 0..3 {
            let d = (white(p, k) - white(q, k)).abs();
            most = most.max(d);
            sum += d;
        }
    }
    (most.round() as u8, sum / (a.len() / 4 * 3) as f64)
}

#[test]
fn a_gif_shows_every_frame_at_its_time_and_in_its_colours() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/disc.gif");
    for (fps, clear) in [(25.0, false), (24.0, false), (30.0, true)] {
        let mut disc = Disc::new([97, 61], 60, clear);
        disc.flashes = vec![20, 21, 22];
        let form = gif::GifForm { fps, plays: 0, matte: Colour::WHITE };
        let outcome = watched(|w| gif::write(&path, &mut disc, form, w)).unwrap();
        let bytes = fs::read(&path).unwrap();
        assert_eq!(outcome, Outcome::Written(bytes.len() as u64));
        let (size, shown) = played_gif(&path);
        assert_eq!(size, [97, 61]);
        let length = shown.last().unwrap().0;
        assert_eq!(length, (60.0_f64 / fps * 100.0).round() as u64, "{fps} frames a second");
        for n in 0..60 {
            let middle = ((f64::from(n) + 0.5) / fps * 100.0).floor() as u64;
            let (most, mean) = difference(at_time(&shown, middle), &disc.shown(n));
            // Half-transparent edges become all or nothing; on a field the nearest colour is near.
            let limit = if clear { (170, 3.0) } else { (8, 0.5) };
            assert!(most <= limit.0 && mean <= limit.1, "frame {n} of {fps}: most {most}, mean {mean:.2}");
        }
        assert_eq!(watched(|w| gif::write(&path, &mut disc, form, w)).unwrap(), outcome);
        assert!(fs::read(&path).unwrap() == bytes, "the same frames gave other bytes");
    }
    assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1, "something was left beside it");
}

#[test]
fn a_gif_faster_than_viewers_leaves_frames_out_and_keeps_its_length() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fast.gif");
    let mut disc = Disc::new([40, 30], 120, false);
    let form = gif::GifForm { fps: 120.0, plays: 1, matte: Colour::WHITE };
    watched(|w| gif::write(&path, &mut disc, form, w)).unwrap();
    let (_, shown) = played_gif(&path);
    assert!((100..=101).contains(&shown.last().unwrap().0), "{}", shown.last().unwrap().0);
}

/// What an animated PNG shows from which second on.
fn played_apng(path: &Path) -> Vec<(f64, Vec<u8>)> {
    let mut decoder = png::Decoder::new(BufReader::new(File::open(path).unwrap()));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().unwrap();
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let frames = reader.info().animation_control.unwrap().num_frames;
    let mut canvas = vec![0_u8; width * height * 4];
    let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
    let (mut shown, mut time) = (Vec::new(), 0.0);
    for _ in 0..frames {
        let info = reader.next_frame(&mut buffer).unwrap();
        let control = *reader.info().frame_control.as_ref().unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgba);
        for (y, row) in buffer.chunks(info.line_size).take(control.height as usize).enumerate() {
            let start = ((y + control.y_offset as usize) * width + control.x_offset as usize) * 4;
            for (x, p) in row.chunks_exact(4).take(control.width as usize).enumerate() {
                if control.blend_op == png::BlendOp::Source || p[3] == 255 {
                    canvas[start + x * 4..][..4].copy_from_slice(p);
                } else {
                    assert_eq!(p[3], 0, "only opaque pixels are laid over others");
                }
            }
        }
        shown.push((time, canvas.clone()));
        time += f64::from(control.delay_num) / f64::from(control.delay_den);
    }
    assert!(reader.next_frame(&mut buffer).is_err(), "more frames than it says");
    shown.push((time, Vec::new()));
    shown
}

#[test]
fn an_animated_png_shows_every_frame_at_its_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("disc.png");
    for (fps, clear, depth) in [
        (25.0, false, apng::Depth::Exact),
        (23.976, true, apng::Depth::Exact),
        (30.0, false, apng::Depth::Palette),
        (24.0, true, apng::Depth::Palette),
    ] {
        let mut disc = Disc::new([97, 61], 60, clear);
        disc.flashes = vec![20, 21, 22];
        let form = apng::ApngForm { fps, plays: 0, depth, opaque: !clear };
        watched(|w| apng::write(&path, &mut disc, form, w)).unwrap();
        let bytes = fs::read(&path).unwrap();
        let shown = played_apng(&path);
        assert!((shown.last().unwrap().0 - 60.0 / fps).abs() < 1e-4, "{fps} frames a second");
        for n in 0..60 {
            let middle = (f64::from(n) + 0.5) / fps;
            let now = &shown.iter().rev().find(|s| s.0 <= middle).unwrap().1;
            let frame = disc.shown(n);
            let (most, mean) = difference(now, &frame);
            let limit = if depth == apng::Depth::Exact { (0, 0.0) } else { (16, 0.5) };
            assert!(most <= limit.0 && mean <= limit.1, "frame {n} of {fps}: most {most}, mean {mean:.2}");
            assert!(depth == apng::Depth::Palette || *now == frame, "frame {n} of {fps}");
        }
        watched(|w| apng::write(&path, &mut disc, form, w)).unwrap();
        assert!(fs::read(&path).unwrap() == bytes, "the same frames gave other bytes");
    }
}

#[test]
fn what_is_stopped_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("disc.gif");
    fs::write(&path, "before").unwrap();
    let stop = AtomicBool::new(false);
    let done = Cell::new(0);
    let progress = |n| {
        done.set(n);
        if n == 5 {
            stop.store(true, Ordering::Relaxed);
        }
    };
    let watch = Watch { progress: &progress, stop: &stop };
    let mut disc = Disc::new([40, 30], 50, false);
    let form = gif::GifForm { fps: 25.0, plays: 0, matte: Colour::WHITE };
    assert_eq!(gif::write(&path, &mut disc, form, &watch).unwrap(), Outcome::Stopped);
    assert_eq!(done.get(), 5);
    assert_eq!(fs::read(&path).unwrap(), b"before");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

fn decoded(path: &Path, arguments: &[&str]) -> Vec<u8> {
    let out = Command::new("ffmpeg").args(["-v", "error", "-i"]).arg(path).args(arguments).arg("-").output().unwrap();
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    out.stdout
}

/// When the sound begins, by the first sample above a tenth, and when the picture turns, in seconds.
fn clap_of(samples: &[u8], from: f64) -> f64 {
    let first = (from * 48_000.0) as usize;
    let loud = |p: &[u8]| i16::from_le_bytes([p[0], p[1]]).unsigned_abs() > 3300;
    from + samples.chunks_exact(2).skip(first).position(loud).unwrap() as f64 / 48_000.0
}

#[test]
#[cfg_attr(not(has_ffmpeg), ignore = "needs ffmpeg")]
fn sound_and_picture_of_a_video_agree_at_its_start_and_its_end() {
    let folder = tempfile::tempdir().unwrap();
    // Flashes at 1 s and at 19 s, each with a clap.
    let mut samples = vec![0.0_f32; 22_050 * 20];
    for clap in [1, 19] {
        for (i, s) in samples[clap * 22_050..][..2000].iter_mut().enumerate() {
            *s = 0.8 * (i as f32 * 0.3).sin();
        }
    }
    let sound = Sound::new(22_050, samples);
    let mut captions = Tier::new("phrases");
    captions.intervals.push(Interval::new(1.0, 2.5, "您好 & <b>"));
    for (container, ending) in [(Container::Mp4, "mp4"), (Container::WebM, "webm")] {
        for clear in [false, true] {
            let path = folder.path().join(format!("it's {clear}.{ending}"));
            let shown: Vec<u32> = (0..500).collect();
            let mut disc = Disc::new([97, 61], 500, clear);
            disc.flashes = (25..28).chain(475..478).collect();
            let film = Film {
                fps: 25.0,
                shown: &shown,
                sound: Some(&sound),
                captions: Some(&captions),
                title: "您好",
                transparent: clear,
            };
            watched(|w| movie::write(&path, container, &mut disc, &film, w)).unwrap();
            if !clear {
                let first = fs::read(&path).unwrap();
                watched(|w| movie::write(&path, container, &mut disc, &film, w)).unwrap();
                assert!(fs::read(&path).unwrap() == first, "{ending}: the same frames gave other bytes");
            }

            // As a player does it: sound and picture as they are laid on one clock.
            let grey = decoded(&path, &["-map", "0:v", "-r", "500", "-f", "rawvideo", "-pix_fmt", "gray"]);
            let size = if container == Container::Mp4 { 98 * 62 } else { 97 * 61 };
            let pcm =
                decoded(&path, &["-map", "0:a", "-af", "aresample=async=1:first_pts=0", "-f", "s16le", "-ar", "48000"]);
            let corner = |n: usize| i32::from(grey[n * size]);
            for clap in [1.0, 19.0] {
                let heard = clap_of(&pcm, clap - 0.5);
                let from = ((clap - 0.5) * 500.0) as usize;
                let quiet = corner(from);
                let seen = (from..).find(|n| (corner(*n) - quiet).abs() > 40).unwrap() as f64 / 500.0;
                println!("{ending} {clear}: clap at {clap} s heard {heard:.4}, seen {seen:.3}");
                assert!((heard - seen).abs() <= 0.020 && (seen - clap).abs() < 0.020, "{heard} {seen}");
            }
            let text = String::from_utf8(decoded(&path, &["-map", "0:s", "-f", "webvtt"])).unwrap();
            assert!(text.contains("您好"), "{text}");
            let length = |bytes: usize| bytes as f64 / 96_000.0;
            assert!((length(pcm.len()) - 20.0).abs() < 0.05, "{}", length(pcm.len()));
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 4, "something was left beside them");
}

fn lay_on_black(p: &mut [u8]) {
    let alpha = u16::from(p[3]);
    p[..3].iter_mut().for_each(|v| *v = (u16::from(*v) * alpha / 255) as u8);
    p[3] = 255;
}

#[test]
#[cfg_attr(not(has_ffmpeg), ignore = "needs ffmpeg")]
fn a_video_has_our_colours_and_a_webm_our_alpha() {
    let folder = tempfile::tempdir().unwrap();
    let shown: Vec<u32> = (0..30).collect();
    for (container, ending, clear) in [
        (Container::Mp4, "mp4", false),
        (Container::Mp4, "mp4", true),
        (Container::WebM, "webm", false),
        (Container::WebM, "webm", true),
    ] {
        let path = folder.path().join(format!("disc.{ending}"));
        let mut disc = Disc::new([160, 90], 30, clear);
        let film = Film { fps: 24.0, shown: &shown, sound: None, captions: None, title: "", transparent: clear };
        watched(|w| movie::write(&path, container, &mut disc, &film, w)).unwrap();
        let mut arguments = vec!["-f", "rawvideo", "-pix_fmt", "rgba"];
        let decoder = ["-c:v", "libvpx-vp9"];
        let keeps_alpha = clear && container == Container::WebM;
        let out = if keeps_alpha {
            // The decoder that comes first in ffmpeg knows nothing of alpha.
            let mut command = Command::new("ffmpeg");
            command.args(["-v", "error"]).args(decoder).arg("-i").arg(&path).args(arguments).arg("-");
            command.output().unwrap().stdout
        } else {
            arguments.splice(0..0, ["-sws_flags", "accurate_rnd+full_chroma_int"]);
            decoded(&path, &arguments)
        };
        assert_eq!(out.len(), 160 * 90 * 4 * 30);
        for (n, frame) in out.chunks_exact(160 * 90 * 4).enumerate() {
            let mut expected = disc.shown(n as u32);
            if !keeps_alpha {
                expected.chunks_exact_mut(4).for_each(lay_on_black);
            }
            let (_, mean) = difference(frame, &expected);
            assert!(mean < 3.0, "{ending} {clear}, frame {n}: mean {mean:.2}");
            assert!(!keeps_alpha || frame[3] < 8, "{ending}: the corner is not transparent");
        }
    }
}

#[test]
#[cfg_attr(not(has_ffmpeg), ignore = "needs ffmpeg")]
fn a_video_that_cannot_be_written_says_what_ffmpeg_says() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.mp4");
    // Wider than H.264 can be.
    let mut disc = Disc::new([16_390, 2], 3, false);
    let film = Film { fps: 25.0, shown: &[0, 1, 2], sound: None, captions: None, title: "", transparent: false };
    let fault = watched(|w| movie::write(&path, Container::Mp4, &mut disc, &film, w)).unwrap_err();
    println!("{fault}");
    assert!(fault.what().starts_with("`ffmpeg` stopped: ") && !fault.what().contains(" @ "), "{fault}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_moving_picture_is_on_the_disk_before_it_takes_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let calls = folder.path().join("calls.txt");
    let watcher = || {
        let mut program = Command::new("strace");
        program.arg("-o").arg(&calls).args(["-f", "-y", "-e", "trace=fsync,rename,renameat,renameat2"]);
        program
    };
    if !watcher().arg("true").output().is_ok_and(|o| o.status.success()) {
        println!("not run: strace is not here, or may not watch");
        return;
    }
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao");
    let out = folder.path().join("out");
    let forms = if cfg!(has_ffmpeg) { "gif,apng,mp4,webm,png" } else { "gif,apng,png" };
    let mut program = watcher();
    program.arg(env!("CARGO_BIN_EXE_lianpu")).arg("export").arg(project).arg("--out").arg(&out);
    program.args(["--to", forms, "--frames", "0-2", "--size", "64x36"]);
    assert!(program.output().unwrap().status.success());
    let calls = fs::read_to_string(&calls).unwrap();
    let calls: Vec<&str> = calls.lines().filter(|l| l.contains("sync(") || l.contains("rename")).collect();
    for form in forms.split(',').filter(|f| *f != "png") {
        let place = format!("nihao.{form}\"");
        let at = calls.iter().position(|l| l.contains("rename") && l.contains(&place)).unwrap();
        let draft = calls[at].split('"').nth(1).unwrap();
        let draft = draft.rsplit('/').next().unwrap();
        let synced = |calls: &[&str], what: &str| calls.iter().any(|l| l.contains("fsync(") && l.contains(what));
        assert!(synced(&calls[..at], &format!("/{draft}>")), "{form}: {calls:#?}");
        assert!(synced(&calls[at..], "/out>"), "{form}: the folder: {calls:#?}");
    }
    let frames = calls.iter().filter(|l| l.contains("fsync(") && l.contains("/out/nihao/"));
    assert_eq!(frames.count(), 0, "frames can be made again and do not wait for the disk");
}
