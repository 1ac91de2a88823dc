//! The forms that hold a clip or a lesson whole: what is in them, that they come out the same, and that they are small.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use crate::support::two_clips;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use lianpu::export::{Aside, Format, Ledger, Request, Shard, Share, Written, plan, run, wholes, write_wholes};
use lianpu::project::Lesson;
use lianpu::render::Painter;
use resvg::{tiny_skia, usvg};

/// A title that breaks whatever is not escaped.
const TITLE: &str = "您好 & <b>\\\"再見\\\"</b> {{DATA}}\\uFFFE\\uFFFF";
const TITLE_READ: &str = "您好 & <b>\"再見\"</b> {{DATA}}";

/// A lesson of two clips: one that speaks, and one of moods alone, whose head turns.
fn lesson() -> (tempfile::TempDir, Lesson) {
    let (folder, _) = two_clips::lesson(TITLE, "a.b_你好", "moods", 20);
    let score = "[[key]]\ntrack = \"head\"\ntime = 0.0\nvalue = [0.0, 0.0, 0.0]\n\n\
                 [[key]]\ntrack = \"head\"\ntime = 0.8\nvalue = [0.1, 0.05, 8.0]\n";
    std::fs::write(folder.path().join("clips/moods/score.toml"), score).unwrap();
    let lesson = Lesson::read(folder.path()).unwrap();
    (folder, lesson)
}

/// Exports into `out`.
fn export(lesson: &Lesson, out: &Path, change: impl FnOnce(&mut Request), formats: &[Format]) -> Vec<Written> {
    let mut request = Request { out: Some(out.into()), ..Request::new(formats.to_vec()) };
    change(&mut request);
    let go_on = AtomicBool::new(false);
    run(&plan(lesson, &request).unwrap(), 1, &Aside::default(), &|_| {}, &go_on).unwrap();
    let all = wholes(lesson, &request).unwrap();
    let mut ledger = Ledger::open(out, Shard::WHOLE);
    write_wholes(lesson, &request, &all, &mut ledger, &|_, _| {}, &go_on).unwrap()
}

fn text(path: impl AsRef<Path>) -> String {
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.as_ref().display()))
}

/// An animated SVG as it stands at a frame, without animation.
fn at_frame(svg: &str, frame: u32, frames: u32) -> String {
    let tree = roxmltree::Document::parse(svg).unwrap();
    let mut out = svg.to_owned();
    for node in
        tree.descendants().filter(|n| n.has_tag_name((SVG, "animate")) || n.has_tag_name((SVG, "animateTransform")))
    {
        let times: Vec<f64> = node.attribute("keyTimes").unwrap().split(';').map(|t| t.parse().unwrap()).collect();
        let values: Vec<&str> = node.attribute("values").unwrap().split(';').collect();
        assert_eq!(times.len(), values.len());
        assert!(times[0] == 0.0 && times.windows(2).all(|w| w[0] < w[1]) && *times.last().unwrap() < 1.0);
        let now = f64::from(frame) / f64::from(frames);
        let value = values[times.iter().rposition(|t| *t <= now).unwrap()];
        let animation = &svg[node.range()];
        let holder = &svg[node.parent().unwrap().range()];
        let start = &holder[..holder.find('>').unwrap() + 1];
        let fixed = match node.attribute("type") {
            None => start.replace(node.parent().unwrap().attribute("href").unwrap(), value),
            Some(kind) => start.replace("<g", &format!("<g transform=\"{kind}({value})\"")),
        };
        out = out.replacen(&format!("{start}{animation}"), &fixed, 1);
    }
    assert!(!out.contains("<animate"), "every animation is found");
    out
}

const SVG: &str = "http://www.w3.org/2000/svg";

#[test]
fn an_animated_svg_shows_at_every_frame_what_the_frames_show_and_has_each_pose_once() {
    let (folder, lesson) = lesson();
    let out = folder.path().join("out");
    export(&lesson, &out, |_| {}, &[Format::Smil]);
    for (number, name) in ["a.b_你好", "moods"].into_iter().enumerate() {
        let svg = text(out.join(format!("{name}.svg")));
        let svg = svg.split("<foreignObject").next().unwrap().trim_end().to_owned();
        let svg = if svg.ends_with("</svg>") { svg } else { svg + "</svg>" };
        assert!(svg.contains("&lt;b&gt;&quot;再見&quot;&lt;/b&gt;"), "the title is escaped");
        let tree = roxmltree::Document::parse(&svg).unwrap();
        let poses: Vec<(&str, &str)> = tree
            .descendants()
            .filter(|n| n.has_tag_name((SVG, "g")) && n.parent().is_some_and(|p| p.has_tag_name((SVG, "defs"))))
            .map(|n| {
                let part = n.attribute("id").unwrap().trim_end_matches(|c: char| c.is_ascii_digit());
                (part, svg[n.range()].split_once('>').unwrap().1)
            })
            .collect();
        let mut different = poses.clone();
        different.sort_unstable();
        different.dedup();
        assert_eq!(different.len(), poses.len(), "each pose stands once");
        let timeline = lesson.timeline(number, None);
        let figure = lesson.figure_of(&lesson.clips[number].entry).unwrap();
        let mut painter = Painter::new(640, 360).unwrap();
        let last = timeline.frames() - 1;
        for frame in [0, 7, last / 2, last] {
            let still = at_frame(&svg, frame, timeline.frames());
            let tree = usvg::Tree::from_str(&still, &usvg::Options::default()).unwrap();
            let mut pixels = tiny_skia::Pixmap::new(640, 360).unwrap();
            resvg::render(&tree, tiny_skia::Transform::identity(), &mut pixels.as_mut());
            let ours = painter.paint(&figure.draw(&timeline.pose(timeline.time_of(frame))));
            let differences = || pixels.data().iter().zip(ours.pixels().as_flattened()).map(|(a, b)| a.abs_diff(*b));
            let mean = differences().map(u32::from).sum::<u32>() as f64 / pixels.data().len() as f64;
            let far = differences().filter(|d| *d > 96).count();
            assert!(mean < 0.4 && far < 12, "{name}, frame {frame}: mean {mean:.3}, {far} far off");
        }
    }
    let size = std::fs::metadata(out.join("moods.svg")).unwrap().len();
    assert!(size < 200_000, "{size} bytes for 20 frames");
}

#[test]
fn the_thesis_s_form_has_a_group_for_every_frame() {
    let (folder, lesson) = lesson();
    export(&lesson, folder.path(), |r| r.thesis = true, &[Format::Smil]);
    let svg = text(folder.path().join("moods.svg"));
    let tree = roxmltree::Document::parse(&svg).unwrap();
    let sets: Vec<_> = tree.descendants().filter(|n| n.has_tag_name((SVG, "set"))).collect();
    assert_eq!(sets.len() as u32, lesson.timeline(1, None).frames());
    for (frame, set) in sets.iter().enumerate() {
        assert_eq!(set.attribute("begin").unwrap(), format!("{:.6}s", frame as f64 * 0.04));
        assert_eq!((set.attribute("dur"), set.attribute("to")), (Some("0.040000s"), Some("visible")));
        assert_eq!(set.parent().unwrap().attribute("visibility"), Some("hidden"));
    }
}

#[test]
fn the_page_needs_nothing_beside_it_and_holds_every_clip() {
    let (folder, lesson) = lesson();
    export(&lesson, folder.path(), |_| {}, &[Format::Html]);
    let page = text(folder.path().join("lesson.html"));
    assert!(page.contains("<title>您好 &amp; &lt;b&gt;&quot;再見&quot;&lt;/b&gt; {{DATA}}</title>"));
    for outside in ["http://", "https://", "<link", "url(", "@import"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("<ruby>您<rt class=\"pinyin\" lang=\"zh-Latn-pinyin\">nín</rt>"));
    assert!(page.contains(">ㄏㄠˇ</rt>") && page.contains("Nothing is said in this clip."));
    assert_eq!(page.matches("<audio ").count(), 1, "one clip has sound");
    let data = page.split_once("id=\"data\">").unwrap().1.split_once("</script>").unwrap().0;
    let clips: serde_json::Value = serde_json::from_str(data).unwrap();
    assert_eq!(clips.as_array().unwrap().len(), 2);
    assert_eq!(clips[0]["name"], "a.b_你好");
    assert_eq!(clips[1]["frames"], lesson.timeline(1, None).frames());
    assert!(clips[0]["mouth"].is_array());
    assert!(clips[1]["bytes"].as_str().unwrap().len() < 40_000);

    let own = folder.path().join("own");
    export(&lesson, &own, |r| r.clip = Some("moods".into()), &[Format::Html, Format::Epub]);
    let mut names: Vec<_> = std::fs::read_dir(&own).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["moods.epub", "moods.html"], "a clip that is asked for has a page and a book of its own");
}

/// The files of a ZIP archive, and whether the first is stored as it is.
fn unzipped(bytes: &[u8]) -> (BTreeMap<String, Vec<u8>>, Vec<String>) {
    let word = |at: usize| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
    let long = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let (mut files, mut order, mut at) = (BTreeMap::new(), Vec::new(), 0);
    while long(at) == 0x0403_4B50 {
        let (method, sum, packed, name) = (word(at + 8), long(at + 14), long(at + 18) as usize, word(at + 26));
        assert_eq!((word(at + 10), word(at + 28)), (0, 0), "no time, nothing extra");
        let title = String::from_utf8(bytes[at + 30..at + 30 + name].to_vec()).unwrap();
        let data = &bytes[at + 30 + name..at + 30 + name + packed];
        let file = if method == 0 { data.to_vec() } else { miniz_oxide::inflate::decompress_to_vec(data).unwrap() };
        assert_eq!(crc32fast::hash(&file), sum, "{title}");
        order.push(title.clone());
        files.insert(title, file);
        at += 30 + name + packed;
    }
    assert_eq!(long(at), 0x0201_4B50, "the directory follows");
    (files, order)
}

#[test]
fn a_book_is_whole_and_reads_every_syllable_with_its_sound() {
    let (folder, lesson) = lesson();
    export(&lesson, folder.path(), |_| {}, &[Format::Epub]);
    let bytes = std::fs::read(folder.path().join("lesson.epub")).unwrap();
    assert_eq!(&bytes[30..58], b"mimetypeapplication/epub+zip");
    let (files, order) = unzipped(&bytes);
    assert_eq!(order[..2], ["mimetype", "META-INF/container.xml"]);
    let file = |name: &str| std::str::from_utf8(&files[name]).unwrap();
    for name in files.keys().filter(|n| n.ends_with("xhtml") || n.ends_with("svg") || n.ends_with("smil")) {
        let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
        roxmltree::Document::parse_with_options(file(name), options).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
    let package = roxmltree::Document::parse(file("book/package.opf")).unwrap();
    let items: Vec<_> = package.descendants().filter(|n| n.tag_name().name() == "item").collect();
    for item in &items {
        assert!(files.contains_key(&format!("book/{}", item.attribute("href").unwrap())));
    }
    assert_eq!(items.len() + 3, files.len(), "everything in the book is in its list");
    let title = package.descendants().find(|n| n.tag_name().name() == "title").unwrap();
    assert_eq!(title.text(), Some(TITLE_READ));
    assert!(file("book/clip-1.xhtml").contains("<ruby>好<rt>hǎo</rt></ruby>"));
    assert!(!files.contains_key("book/clip-2.smil"), "who says nothing is not read");
    if let Some(overlay) = files.get("book/clip-1.smil") {
        let tree = roxmltree::Document::parse(std::str::from_utf8(overlay).unwrap()).unwrap();
        let mut until = "0.000s".to_owned();
        for par in tree.descendants().filter(|n| n.tag_name().name() == "par") {
            let part = |name: &str| par.children().find(|n| n.tag_name().name() == name).unwrap();
            let place = part("text").attribute("src").unwrap().split_once('#').unwrap().1.to_owned();
            assert!(file("book/clip-1.xhtml").contains(&format!("id=\"{place}\"")), "{place}");
            assert_eq!(part("audio").attribute("clipBegin"), Some(until.as_str()), "nothing is left out");
            until = part("audio").attribute("clipEnd").unwrap().to_owned();
        }
        assert_eq!(until, format!("{:.3}s", lesson.clips[0].duration()));
    }
}

#[test]
fn page_and_book_of_a_lesson_are_of_one_language_also_where_nothing_is_said() {
    let (folder, mut lesson) = lesson();
    for (title, of_the_book, of_the_clips) in [
        ("Seven emotions", "zh", vec!["zh", "und"]),
        ("Seven emotions", "und", vec!["und"]),
        ("七情", "zh", vec!["zh"]),
    ] {
        title.clone_into(&mut lesson.manifest.title);
        if of_the_clips.len() == 1 && lesson.clips.len() == 2 {
            lesson.clips.remove(0);
        }
        export(&lesson, folder.path(), |_| {}, &[Format::Epub, Format::Html]);
        let (files, _) = unzipped(&std::fs::read(folder.path().join("lesson.epub")).unwrap());
        let package = std::str::from_utf8(&files["book/package.opf"]).unwrap();
        assert!(package.contains(&format!("<dc:language>{of_the_book}</dc:language>")), "{package}");
        let page = text(folder.path().join("lesson.html"));
        for (n, language) in of_the_clips.iter().enumerate() {
            assert!(page.contains(&format!("<section id=\"said-{n}\" lang=\"{language}\"")), "{n} {language}");
        }
    }
}

#[test]
fn a_lottie_animation_keeps_the_number_of_points_of_every_outline() {
    let (folder, lesson) = lesson();
    export(&lesson, folder.path(), |_| {}, &[Format::Lottie]);
    let film: serde_json::Value = serde_json::from_str(&text(folder.path().join("moods.json"))).unwrap();
    assert_eq!((film["fr"].as_f64(), film["w"].as_u64()), (Some(25.0), Some(640)));
    assert_eq!(film["op"], lesson.timeline(1, None).frames());
    fn outlines(value: &serde_json::Value, found: &mut Vec<serde_json::Value>) {
        match value {
            serde_json::Value::Object(map) => {
                if map.get("ty").is_some_and(|t| t == "sh") {
                    found.push(map["ks"].clone());
                }
                found.extend(map.get("pt").cloned());
                map.values().for_each(|v| outlines(v, found));
            }
            serde_json::Value::Array(list) => list.iter().for_each(|v| outlines(v, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    outlines(&film, &mut found);
    let animated: Vec<_> = found.iter().filter(|ks| ks["a"] == 1).collect();
    assert!(animated.len() > 10, "{} outlines move", animated.len());
    for ks in animated {
        let counts: Vec<usize> =
            ks["k"].as_array().unwrap().iter().map(|key| key["s"][0]["v"].as_array().unwrap().len()).collect();
        assert!(counts.windows(2).all(|w| w[0] == w[1]), "{counts:?}");
    }
    let turns = film["layers"].as_array().unwrap().iter().filter(|l| l["ks"]["r"]["a"] == 1).count();
    assert!(turns > 10, "the head turns: {turns} layers");
}

#[test]
fn times_and_shapes_are_read_back_as_they_were_written() {
    let (folder, lesson) = lesson();
    let forms = [Format::Vtt, Format::Rhubarb, Format::Moho, Format::Wav, Format::Ratios, Format::Lpr];
    let written = export(&lesson, folder.path(), |_| {}, &forms);
    let at = |ending: &str| folder.path().join(format!("a.b_你好.{ending}"));
    let vtt = text(at("vtt"));
    assert!(vtt.contains("您<00:00:") && vtt.contains(">好。"), "{vtt}");
    assert_eq!(lianpu::timing::read(&at("vtt")).unwrap().tiers[0].intervals[0].label, "您好。");
    let labels = |ending: &str| -> Vec<String> {
        let timing = lianpu::timing::read(&at(ending)).unwrap();
        timing.shapes().unwrap().intervals.iter().map(|i| i.label.clone()).collect()
    };
    let said = labels("rhubarb.tsv");
    assert!(said.len() >= 4, "{said:?}");
    assert_eq!(labels("rhubarb.xml"), said);
    assert_eq!(labels("rhubarb.json"), said);
    assert!(!labels("dat").is_empty());
    let (old, new) = (lesson.clips[0].sound.as_ref().unwrap(), lianpu::media::Sound::read(&at("wav")).unwrap());
    assert_eq!((old.rate, &old.samples), (new.rate, &new.samples), "the sound is the recording's");
    let table = text(folder.path().join("moods.ratios.csv"));
    assert_eq!(lianpu::ratios::Record::parse(&table).unwrap().rows.len(), 20);
    let notes: Vec<&lianpu::disk::Message> = written.iter().flat_map(|w| &w.notes).collect();
    assert!(notes.iter().any(|n| n.to_string().contains("moods has no sound")), "{notes:?}");
}

#[test]
fn every_shape_of_the_mouth_is_a_picture_and_every_look_a_layer() {
    let (folder, lesson) = lesson();
    export(&lesson, folder.path(), |r| r.clip = Some("moods".into()), &[Format::Mouths, Format::Layers]);
    for shape in ["rest", "m", "f", "h", "a", "i", "u", "e", "o", "n", "chart"] {
        for ending in ["svg", "png"] {
            let path = folder.path().join(format!("moods.mouths/{shape}.{ending}"));
            assert!(std::fs::metadata(&path).unwrap().len() > 1000, "{}", path.display());
        }
    }
    let svg = text(folder.path().join("moods.layers.svg"));
    let tree = roxmltree::Document::parse(&svg).unwrap();
    let label = ("http://www.inkscape.org/namespaces/inkscape", "label");
    let labels: Vec<&str> = tree.descendants().filter_map(|n| n.attribute(label)).collect();
    for name in ["mouth", "eyes", "closed", "a"] {
        assert!(labels.iter().any(|l| l.split(' ').any(|word| word == name)), "{name} in {labels:?}");
    }
    let hidden = svg.matches("display:none").count();
    assert!(hidden > 15, "{hidden} looks are hidden");
}

#[test]
fn a_second_run_keeps_everything_and_another_place_gets_the_same_bytes() {
    let (folder, lesson) = lesson();
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    let forms = [Format::Smil, Format::Html, Format::Epub, Format::Lottie, Format::Rhubarb, Format::Wav];
    let first = export(&lesson, &one, |_| {}, &forms);
    let files: Vec<&PathBuf> = first.iter().flat_map(|w| &w.paths).collect();
    assert_eq!(files.len(), 2 + 1 + 1 + 2 + 6 + 1);
    assert!(first.iter().all(|w| w.report.kept == 0));
    std::fs::remove_file(files[0]).unwrap();
    let again = export(&lesson, &one, |_| {}, &forms);
    let count = |f: fn(&Written) -> u32| again.iter().map(f).sum::<u32>() as usize;
    assert_eq!((count(|w| w.report.written), count(|w| w.report.kept)), (1, files.len() - 1));
    export(&lesson, &two, |_| {}, &forms);
    for file in files {
        let other = two.join(file.file_name().unwrap());
        assert_eq!(std::fs::read(file).unwrap(), std::fs::read(&other).unwrap(), "{}", other.display());
    }
    let other_half = |r: &mut Request| r.shares = Some(vec![Share { frames: 5..9, whole_files: false }; 2]);
    assert!(export(&lesson, &folder.path().join("three"), other_half, &forms).is_empty(), "another part writes them");
}

#[test]
fn without_an_encoder_the_sound_is_larger_and_the_program_says_so() {
    let (folder, _) = lesson();
    let out = folder.path().join("out");
    let run = assert_cmd::Command::cargo_bin("lianpu")
        .unwrap()
        .env("PATH", "")
        .arg("export")
        .arg(folder.path())
        .args(["--to", "smil,epub", "--clip", "a.b_你好", "--out"])
        .arg(&out)
        .assert()
        .success();
    let said = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    assert!(said.contains("no `ffmpeg`") && said.contains("the book has no sound"), "{said}");
    assert!(text(out.join("a.b_你好.svg")).contains("data:audio/flac;base64,ZkxhQ"));
    let (files, _) = unzipped(&std::fs::read(out.join("a.b_你好.epub")).unwrap());
    assert!(files.keys().all(|name| !name.ends_with("flac") && !name.ends_with("smil")));
}
