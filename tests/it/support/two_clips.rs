//! A lesson of two clips: one that says 您好 as the sample does, and one of moods alone, without sound or script.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::path::Path;

use lianpu::project::Lesson;

/// Makes it, with names for the clips and so many frames of a smile that grows. `title` is as TOML has it between quotes.
pub fn lesson(title: &str, spoken: &str, moods: &str, frames: u32) -> (tempfile::TempDir, Lesson) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao");
    let copy = |from: &str, to: &str| {
        let to = root.join(to);
        std::fs::create_dir_all(to.parent().unwrap()).unwrap();
        std::fs::copy(sample.join(from), to).unwrap();
    };
    copy("faces/teacher/face.toml", "faces/teacher/face.toml");
    copy("faces/teacher/neutral.png", "faces/teacher/neutral.png");
    for file in ["script.txt", "speech.wav", "timing.TextGrid", "score.toml"] {
        copy(&format!("clips/nihao/{file}"), &format!("clips/{spoken}/{file}"));
    }
    std::fs::create_dir_all(root.join("clips").join(moods)).unwrap();
    let mut ratios = String::from("frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n");
    for frame in 0..frames {
        let happy = f64::from(frame) / f64::from(frames);
        ratios.push_str(&format!("{frame},{},{},{happy},0,0,0,0,0,1\n", f64::from(frame) * 0.04, 1.0 - happy));
    }
    std::fs::write(root.join("clips").join(moods).join("ratios.csv"), ratios).unwrap();
    let manifest = format!(
        "format = 1\ntitle = \"{title}\"\n\n[[face]]\nname = \"teacher\"\nfigure = \"cartoon\"\n\n\
         [[clip]]\nname = \"{spoken}\"\nscript_system = \"han\"\n\n[[clip]]\nname = \"{moods}\"\n\n\
         [output]\nfps = 25\nsize = [640, 360]\n"
    );
    std::fs::write(root.join("lianpu.toml"), manifest).unwrap();
    let lesson = Lesson::read(root).unwrap();
    (folder, lesson)
}
