//! The frames of a clip as files: whole, equal to a picture that is painted anew, and the same bytes however they come
//! to be written.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use lianpu::drawing::{Anchor, Colour, Drawing, Item, Layer, Picture, Raster};
use lianpu::export::{Aside, Dedupe, Format, Job, Report, Request, divide, plan, run};
use lianpu::geometry::{Affine, BezPath, Circle, Point, Rect, Shape, Vec2};
use lianpu::project::Lesson;
use lianpu::render::{ClipCoder, Painter, decode_key};

fn lesson() -> Lesson {
    Lesson::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao")).unwrap()
}

fn request(out: &Path) -> Request {
    // No multiple of a tile in either direction.
    let size = Some([474, 267]);
    Request { out: Some(out.into()), size, ..Request::new(vec![Format::Png]) }
}

fn export(request: &Request, threads: usize) -> (Vec<Job>, Report) {
    let jobs = plan(&lesson(), request).unwrap();
    let (report, _) = run(&jobs, threads, &Aside::default(), &|_| {}, &AtomicBool::new(false)).unwrap();
    (jobs, report)
}

fn files(jobs: &[Job]) -> BTreeMap<PathBuf, Vec<u8>> {
    let of = |job: &Job, frame: u32| {
        let path = job.path_of(frame, Format::Png);
        (path.file_name().unwrap().into(), std::fs::read(path).unwrap())
    };
    jobs.iter().flat_map(|job| job.frames.iter().map(move |frame| of(job, *frame))).collect()
}

/// The pixels of a PNG file all of whose checksums hold.
fn decoded(file: &[u8]) -> Picture {
    let mut options = png::DecodeOptions::default();
    options.set_ignore_adler32(false);
    options.set_ignore_crc(false);
    let mut reader = png::Decoder::new_with_options(std::io::Cursor::new(file), options).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    reader.finish().unwrap();
    let pixels = match info.color_type {
        png::ColorType::Rgba => bytes.as_chunks::<4>().0.to_vec(),
        png::ColorType::Rgb => bytes.as_chunks::<3>().0.iter().map(|[r, g, b]| [*r, *g, *b, 255]).collect(),
        other => panic!("{other:?}"),
    };
    Picture::new(info.width as usize, info.height as usize, pixels)
}

fn painted(drawing: &Drawing, [width, height]: [u32; 2]) -> Picture {
    Painter::new(width, height).unwrap().paint(drawing)
}

#[test]
fn every_frame_is_a_whole_file_and_equal_to_a_picture_painted_anew() {
    let out = tempfile::tempdir().unwrap();
    let (jobs, report) = export(&request(out.path()), 1);
    assert_eq!(report.written, jobs[0].count);
    for (frame, file) in files(&jobs).values().enumerate() {
        assert!(decode_key(file).is_some());
        assert_eq!(decoded(file), painted(&jobs[0].drawing(frame as u32), jobs[0].size), "frame {frame}");
    }
}

#[test]
fn frames_have_the_same_bytes_however_they_come_to_be_written() {
    let folder = || tempfile::tempdir().unwrap();
    let whole = folder();
    let all = files(&export(&request(whole.path()), 1).0);
    for (threads, dedupe) in [(2, Dedupe::Link), (3, Dedupe::Copy), (1, Dedupe::None), (2, Dedupe::None)] {
        let out = folder();
        let request = Request { dedupe, ..request(out.path()) };
        assert_eq!(files(&export(&request, threads).0), all, "{threads} threads, {dedupe:?}");
    }
    let out = folder();
    let mut parts = BTreeMap::new();
    for part in ["3/3", "1/3", "2/3"] {
        let shares = divide(&[all.len() as u32], part.parse().unwrap());
        let request = Request { shares: Some(shares), ..request(out.path()) };
        parts.extend(files(&export(&request, 1).0));
    }
    assert_eq!(parts, all);
    let some = Request { frames: "17-21,3".parse().unwrap(), ..request(folder().path()) };
    for (name, file) in files(&export(&some, 1).0) {
        assert_eq!(Some(&file), all.get(&name), "{}", name.display());
    }
}

#[test]
fn an_export_goes_on_where_it_stopped() {
    let out = tempfile::tempdir().unwrap();
    let (jobs, _) = export(&request(out.path()), 2);
    let all = files(&jobs);
    let (_, again) = export(&request(out.path()), 2);
    assert_eq!((again.written, again.kept), (0, jobs[0].count));
    // One is gone, and one is damaged by a program that does not write in place.
    std::fs::remove_file(jobs[0].path_of(5, Format::Png)).unwrap();
    let damaged = jobs[0].path_of(9, Format::Png);
    std::fs::remove_file(&damaged).unwrap();
    std::fs::write(&damaged, &all.values().nth(9).unwrap()[..500]).unwrap();
    let (_, mended) = export(&request(out.path()), 1);
    assert_eq!(mended.written, 2);
    assert_eq!(files(&jobs), all);
}

#[cfg(unix)]
#[test]
fn equal_frames_are_one_file_until_one_of_them_changes() {
    use std::os::unix::fs::MetadataExt;
    let links = |dedupe| {
        let out = tempfile::tempdir().unwrap();
        let (jobs, report) = export(&Request { dedupe, ..request(out.path()) }, 2);
        let nodes = jobs[0].frames.iter().map(|f| std::fs::metadata(jobs[0].path_of(*f, Format::Png)).unwrap().ino());
        let different = nodes.collect::<std::collections::BTreeSet<_>>().len();
        (out, jobs, different, report.bytes)
    };
    let (out, jobs, different, bytes) = links(Dedupe::Link);
    let count = jobs[0].count as usize;
    assert!(different < count, "{different} of {count}");
    let (_, _, copies, more) = links(Dedupe::Copy);
    assert!(copies == count && more > bytes);

    // Frame 0 becomes another one: the frames that were one file with it stay what they were.
    let before = files(&jobs);
    let blue = Some(Some(Colour::rgb(0, 0, 200)));
    let (_, report) = export(&Request { frames: "0".parse().unwrap(), background: blue, ..request(out.path()) }, 1);
    assert_eq!(report.written, 1);
    let after = files(&jobs);
    let changed: Vec<_> = before.keys().filter(|name| before[*name] != after[*name]).collect();
    assert_eq!(changed, [Path::new("000000.png")]);
}

/// Everything that can lie in a drawing, in motion; every third one as the first.
fn any_drawing(step: u32, background: Option<Colour>) -> Drawing {
    let t = f64::from(if step.is_multiple_of(3) { 0 } else { step });
    let disc = |x: f64, y: f64, r: f64| Circle::new((x, y), r).to_path(0.01);
    let red = Colour::rgb(200, 30, 40);
    let photo = (0..40 * 30_u32).map(|i| [0, 1, 2, 3].map(|k| ((4 * i + k) * 37 % 251) as u8)).collect();
    let still = vec![
        Item::area("", disc(100.0, 100.0, 90.0), Colour::rgb(240, 220, 190)),
        Item::shared(vec![
            Item::glow("", Point::new(70.0, 110.0), Vec2::new(40.0, 25.0), red.faded(0.4)),
            Item::Picture(Raster::new("", Picture::new(40, 30, photo)).placed_in(Rect::new(150.0, 20.0, 230.0, 80.0))),
        ]),
    ];
    let star: BezPath = {
        let point = |i: u32| Point::new(100.0, 100.0 + t) + Vec2::from_angle(f64::from(i) * 2.513_274) * 60.0;
        let mut path = BezPath::new();
        path.move_to(point(0));
        (1..5).for_each(|i| path.line_to(point(i)));
        path
    };
    let moving = vec![
        Item::moved("", Affine::rotate_about(0.01 * t, (100.0, 100.0)), still.clone()),
        Item::area("", star.clone(), red.faded(0.5)),
        Item::clipped("", star, vec![Item::area("", disc(110.0, 90.0, 40.0), Colour::rgb(10, 90, 10))]),
        Item::text(Point::new(10.0 + t, 180.0), 24.0, Anchor::Start, Colour::BLACK, "nǐ hǎo"),
    ];
    Drawing {
        view: Rect::new(0.0, 0.0, 240.0, 200.0),
        title: String::new(),
        description: String::new(),
        background,
        layers: vec![Layer { name: "static".into(), items: still }, Layer { name: "dynamic".into(), items: moving }],
    }
}

#[test]
fn any_figure_in_any_order_is_painted_as_if_anew() {
    let size = [331, 259];
    for background in [Some(Colour::WHITE), Some(Colour::rgb(9, 8, 7).faded(0.5)), None] {
        let samples: Vec<Drawing> = (0..4).map(|i| any_drawing(2 * i, background)).collect();
        let clip = ClipCoder::new(size[0], size[1], &samples).unwrap();
        let mut warm = clip.frames().unwrap();
        for step in [0, 1, 2, 1, 5, 0, 7, 8, 2] {
            let drawing = any_drawing(step, background);
            let file = warm.encode(&drawing, "a key").unwrap();
            assert_eq!(file, clip.frames().unwrap().encode(&drawing, "a key").unwrap(), "{step}");
            assert_eq!(decoded(&file), painted(&drawing, size), "{step} on {background:?}");
            assert_eq!(decode_key(&file).as_deref(), Some("a key"));
        }
    }
}

#[test]
fn a_drawing_unlike_the_samples_is_written_right_as_well() {
    let samples = [any_drawing(0, Some(Colour::WHITE))];
    let clip = ClipCoder::new(331, 259, &samples).unwrap();
    let clear = any_drawing(4, None);
    assert_eq!(decoded(&clip.frames().unwrap().encode(&clear, "").unwrap()), painted(&clear, [331, 259]));
    let none = ClipCoder::new(20, 10, &[]).unwrap();
    let drawing = any_drawing(1, Some(Colour::WHITE));
    assert_eq!(decoded(&none.frames().unwrap().encode(&drawing, "").unwrap()), painted(&drawing, [20, 10]));
}
