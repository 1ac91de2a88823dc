//! Frames a second, by stage and as a whole, beside a loop of the `resvg` program and one of `rsvg-convert` over our own
//! SVG frames: 144 s of continuous Mandarin by espeak-ng, aligned, spoken by the face of `projects/nihao`, 25 frames a
//! second of 1280 × 720.
//!
//! ```sh
//! cargo bench --bench export
//! ```
//!
//! Without `resvg` in the path (`cargo install resvg`) the same is done by a process that calls resvg's library.
//! `LIANPU_PAIRS` says how many pairs the medians are of, instead of 5.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use lianpu::disk::replace;
use lianpu::drawing::Drawing;
use lianpu::export::{Aside, Dedupe, Format, Job, Request, plan, run};
use lianpu::pose::Head;
use lianpu::project::Lesson;
use lianpu::render::{ClipCoder, to_svg};

/// 400 syllables.
const TEXT: &str = "今天早上天气很好，我和妹妹一起去公园散步。路边的花都开了，红的黄的白的，非常好看。妹妹问我，这是什么花？我说，我也不知道，我们回家问妈妈吧。公园里有很多人，有的人在跑步，有的人在唱歌，还有几位老人在下棋。我们坐在湖边的长椅上，一边吃面包，一边看水里的鱼。突然下起了小雨，我们没有带伞，只好跑到一棵大树下面躲雨。雨停了以后，天上出现了一道彩虹，大家都高兴地拍手。回家的路上，我们买了一斤苹果和两个西瓜。妈妈看见我们的衣服湿了，马上给我们煮了热热的姜汤。晚饭以后，爸爸给我们讲了一个故事。从前有一只小猫，它住在山上的一座旧房子里。每天晚上，小猫都坐在窗户上看月亮。它想，月亮上面有没有别的猫呢？有一天，一只小鸟飞来告诉它，月亮很远很远，谁也没有去过。小猫听了以后一点儿也不难过，它说，只要每天能看见月亮，我就很快乐。妹妹听完故事，慢慢地睡着了。我也关了灯，躺在床上，心里想着今天的花，今天的雨，还有那只喜欢看月亮的小猫。明天我要早一点儿起床，把这个故事写下来，送给我最好的朋友。他住在北京，我们已经半年没有见面了。";

/// Frames that the peers are given in a pair: they take as long for any.
const OF_PEERS: u32 = 40;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    if let [_, mode, from, to] = &args[..]
        && mode == "resvg"
    {
        return resvg_once(Path::new(from), Path::new(to));
    }
    // Anything but `cargo bench` only wants to know that it can be built.
    if !args.iter().any(|a| a == "--bench") {
        return;
    }
    let memory = Path::new("/dev/shm");
    let folder = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() }.unwrap();
    let Some(root) = make_lesson(folder.path()) else {
        println!("espeak-ng is not here, and so no lesson");
        return;
    };
    let lesson = Lesson::read(&root).unwrap();
    let job = job(&lesson, folder.path(), Format::Png, Dedupe::Link);
    println!("{} frames of {} × {}", job.count, job.size[0], job.size[1]);
    stages(&job, folder.path());
    memory_of(&root, folder.path());
    pairs(&lesson, &job, folder.path());
}

/// Sound by espeak-ng, times by our own alignment.
fn make_lesson(folder: &Path) -> Option<PathBuf> {
    let (root, sample) = (folder.join("lesson"), Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao"));
    let (clip, face) = (root.join("clips/lesson"), root.join("faces/teacher"));
    std::fs::create_dir_all(&clip).unwrap();
    std::fs::create_dir_all(&face).unwrap();
    for file in std::fs::read_dir(sample.join("faces/teacher")).unwrap().flatten() {
        std::fs::copy(file.path(), face.join(file.file_name())).unwrap();
    }
    std::fs::write(clip.join("script.txt"), TEXT).unwrap();
    std::fs::write(
        root.join("lianpu.toml"),
        "format = 1\ntitle = \"A walk\"\n[[face]]\nname = \"teacher\"\nfigure = \"cartoon\"\n[[clip]]\nname = \"lesson\"\n\
         script_system = \"han\"\n[output]\nfps = 25\nsize = [1280, 720]\n",
    )
    .unwrap();
    let wav = clip.join("speech.wav");
    let spoken = Command::new("espeak-ng").args(["-v", "cmn", "-s", "190", "-w"]).arg(wav).arg(TEXT).status();
    spoken.ok().filter(std::process::ExitStatus::success)?;
    let aligned = Command::new(env!("CARGO_BIN_EXE_lianpu")).arg("align").arg(&root).stderr(Stdio::null()).status();
    assert!(aligned.unwrap().success());
    Some(root)
}

fn job(lesson: &Lesson, folder: &Path, format: Format, dedupe: Dedupe) -> Job {
    let request = Request { out: Some(folder.join("out")), dedupe, ..Request::new(vec![format]) };
    plan(lesson, &request).unwrap().remove(0)
}

/// Seconds that this process and those it has waited for have had of the processors, in hundredths.
fn processor_time() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    after_name.split_whitespace().skip(11).take(4).filter_map(|n| n.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Wall and processor seconds of something.
fn timed(what: impl FnOnce()) -> (f64, f64) {
    let (started, processor) = (Instant::now(), processor_time());
    what();
    (started.elapsed().as_secs_f64(), processor_time() - processor)
}

fn per_frame((wall, processor): (f64, f64), frames: u32) -> String {
    let ms = |s: f64| 1000.0 * s / f64::from(frames);
    let processor =
        if processor.is_nan() { String::new() } else { format!(" ({:.3} of the processor)", ms(processor)) };
    format!("{:.4} ms a frame{processor}", ms(wall))
}

/// Samples as an export takes them.
fn samples(job: &Job) -> Vec<Drawing> {
    (0..12).map(|i| job.drawing((job.count - 1) * i / 11)).collect()
}

/// One thread: what an export does in turn. Frames that repeat another are built, and then linked to it.
fn stages(job: &Job, folder: &Path) {
    let mut seen = HashSet::new();
    let first: Vec<u32> = (0..job.count).filter(|f| seen.insert(job.drawing(*f).fingerprint())).collect();
    println!("{} frames differ; of all frames, each on average:", first.len());
    let say = |name: &str, took: (f64, f64)| println!("  {name:<8}{}", per_frame(took, job.count));
    let build = timed(|| first.iter().for_each(|f| drop(std::hint::black_box(job.drawing(*f)))));
    let mut clip = None;
    let learn = timed(|| clip = Some(ClipCoder::new(job.size[0], job.size[1], &samples(job)).unwrap()));
    let clip = clip.unwrap();
    let mut coder = clip.frames().unwrap();
    let (mut file, mut bytes) = (Vec::new(), 0);
    let (mut raster, mut encode) = (Duration::ZERO, Duration::ZERO);
    for frame in &first {
        let drawing = job.drawing(*frame);
        file.clear();
        let started = Instant::now();
        let painted = coder.paint(&drawing);
        raster += started.elapsed();
        coder.tell(painted, "key", &mut file).unwrap();
        encode += started.elapsed();
        bytes += file.len();
    }
    encode -= raster;
    let wall = |took: Duration| (took.as_secs_f64(), f64::NAN);
    let at = folder.join("stages");
    std::fs::create_dir(&at).unwrap();
    let write = timed(|| first.iter().for_each(|f| replace(&at.join(format!("{f:06}.png")), &file).unwrap()));
    let (source, others) = (at.join("000000.png"), job.count - first.len() as u32);
    let link = timed(|| (0..others).for_each(|f| std::fs::hard_link(&source, at.join(f.to_string())).unwrap()));
    std::fs::remove_dir_all(&at).unwrap();
    say("build", build);
    say("learn", learn);
    say("raster", wall(raster));
    say("encode", wall(encode));
    say("write", write);
    say("link", link);
    println!("  {} bytes a file", bytes / first.len());
}

/// Writes frames none of whose moving parts has been there before, by a coder that keeps nothing of what moves; or frames in which
/// the whole head moves. Of these, every fourth.
fn harder(job: &Job, folder: &Path, head: bool) -> (f64, f64) {
    let at = folder.join("harder");
    std::fs::create_dir(&at).unwrap();
    let frames: Vec<u32> = (0..job.count).step_by(if head { 4 } else { 1 }).collect();
    let took = timed(|| {
        let clip = ClipCoder::new(job.size[0], job.size[1], &samples(job)).unwrap();
        let clip = if head { clip } else { clip.forgetful() };
        let mut coder = clip.frames().unwrap();
        let mut file = Vec::new();
        for frame in &frames {
            let mut pose = job.timeline.pose(job.timeline.time_of(*frame));
            if head {
                let t = f64::from(*frame);
                pose.head =
                    Head { x: 0.05 * (0.13 * t).sin(), y: 0.03 * (0.17 * t).cos(), roll: 4.0 * (0.11 * t).sin() };
            } else {
                // The golden section's multiples never meet.
                let any = (f64::from(*frame) * 0.618_034).fract();
                (pose.lids.left, pose.lids.right) = (0.5 + 0.5 * any, 0.4 + 0.6 * any);
                pose.mouth.lower += 0.2 * any;
                pose.mouth.upper -= 0.1 * any;
                pose.mouth.speaking = 1.0;
            }
            file.clear();
            coder.encode_into(&job.figure.draw(&pose), "key", &mut file).unwrap();
            replace(&at.join(format!("{frame:06}.png")), &file).unwrap();
        }
    });
    std::fs::remove_dir_all(&at).unwrap();
    (took.0 / frames.len() as f64, took.1 / frames.len() as f64)
}

/// The most memory that the program takes for the lesson on two threads.
fn memory_of(root: &Path, folder: &Path) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lianpu"))
        .args(["export", "--to", "png", "--jobs", "2", "--out"])
        .arg(folder.join("memory"))
        .arg(root)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut most = 0;
    while child.try_wait().unwrap().is_none() {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let line =
            status.lines().find_map(|l| l.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB")?.parse::<u64>().ok());
        most = most.max(line.unwrap_or(0));
        std::thread::sleep(Duration::from_millis(5));
    }
    println!("peak memory of the program on two threads: {:.1} MB", most as f64 / 1024.0);
    std::fs::remove_dir_all(folder.join("memory")).unwrap();
}

/// The whole export and the peers, by turns.
fn pairs(lesson: &Lesson, png: &Job, folder: &Path) {
    let count = std::env::var("LIANPU_PAIRS").ok().and_then(|n| n.parse().ok()).unwrap_or(5);
    let svgs: Vec<PathBuf> = (0..OF_PEERS)
        .map(|i| (i, png.count * i / OF_PEERS))
        .map(|(i, frame)| {
            let path = folder.join(format!("{i}.svg"));
            std::fs::write(&path, to_svg(&png.drawing(frame), png.size[0], png.size[1])).unwrap();
            path
        })
        .collect();
    let there = |name: &str| {
        let said = Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        said.is_ok_and(|status| status.success())
    };
    let program = there("resvg");
    println!("resvg is {}", if program { "the program" } else { "its library, called by a process for each frame" });
    let target = folder.join("one.png");
    let own = std::env::current_exe().unwrap();
    let one = |tool: &str, svg: &Path| {
        let mut command = match tool {
            "resvg" if program => Command::new("resvg"),
            "resvg" => {
                let mut command = Command::new(&own);
                command.arg("resvg");
                command
            }
            _ => {
                let mut command = Command::new(tool);
                command.arg("-o").arg(&target).arg(svg);
                return command;
            }
        };
        command.arg(svg).arg(&target);
        command
    };
    let tools: Vec<&str> = ["resvg", "rsvg-convert"].into_iter().filter(|t| *t == "resvg" || there(t)).collect();
    let ours = [
        ("ours, one thread", 1, Dedupe::Link),
        ("ours, two threads", 2, Dedupe::Link),
        ("ours, one thread, no links", 1, Dedupe::None),
    ];
    let harder_ones = [("ours, all frames distinct, caches off", false), ("ours, the whole head moving", true)];
    let names = ours.iter().map(|o| o.0).chain(harder_ones.iter().map(|h| h.0));
    let mut times: Vec<(&str, Vec<(f64, f64)>)> = names.map(|name| (name, Vec::new())).collect();
    let all_ours = times.len();
    times.extend(tools.iter().map(|t| (*t, Vec::new())));
    for _ in 0..count {
        for (i, (_, threads, dedupe)) in ours.iter().enumerate() {
            let jobs = [job(lesson, folder, Format::Png, *dedupe)];
            let stop = AtomicBool::new(false);
            let took = timed(|| {
                assert_eq!(run(&jobs, *threads, &Aside::default(), &|_| {}, &stop).unwrap().0.written, png.count);
            });
            times[i].1.push((took.0 / f64::from(png.count), took.1 / f64::from(png.count)));
            std::fs::remove_dir_all(folder.join("out")).unwrap();
        }
        for (i, (_, head)) in harder_ones.iter().enumerate() {
            times[ours.len() + i].1.push(harder(png, folder, *head));
        }
        for (i, tool) in tools.iter().enumerate() {
            let took = timed(|| svgs.iter().for_each(|svg| assert!(one(tool, svg).status().unwrap().success())));
            times[all_ours + i].1.push((took.0 / f64::from(OF_PEERS), took.1 / f64::from(OF_PEERS)));
        }
    }
    let median = |times: &[(f64, f64)], pick: fn(&(f64, f64)) -> f64| {
        let mut all: Vec<f64> = times.iter().map(pick).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    println!("medians of {count} pairs, a frame:");
    for (name, took) in &times {
        let (wall, processor) = (median(took, |t| t.0), median(took, |t| t.1));
        print!("  {name}: {:.3} ms ({:.3} of the processor)", 1000.0 * wall, 1000.0 * processor);
        for (peer, theirs) in times.iter().skip(all_ours).filter(|_| name.starts_with("ours")) {
            let (w, p) = (median(theirs, |t| t.0), median(theirs, |t| t.1));
            print!("; {:.0} × {peer} ({:.0} × of the processor)", w / wall, p / processor);
        }
        println!();
    }
}

/// What the program `resvg` does where an SVG has no text; with text it would look for the system's fonts as well.
fn resvg_once(from: &Path, to: &Path) {
    let tree = usvg::Tree::from_str(&std::fs::read_to_string(from).unwrap(), &usvg::Options::default()).unwrap();
    let size = tree.size().to_int_size();
    let mut canvas = tiny_skia::Pixmap::new(size.width(), size.height()).unwrap();
    resvg::render(&tree, tiny_skia::Transform::identity(), &mut canvas.as_mut());
    canvas.save_png(to).unwrap();
}
