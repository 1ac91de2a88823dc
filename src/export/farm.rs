//! An export as a job for an engine that divides work among machines: its text, nothing is run.
//!
//! Every engine gets the same: tasks that each do one part of the whole (lessons first, frames second), and when all are
//! done one that joins them and looks whether anything is missing. A task that is run again only does what is left.

use std::fmt::Write;
use std::path::Path;
use std::str::FromStr;

use super::ExportFault;
use crate::disk::{Fault, Result};

/// The most tasks of a job: what Slurm takes in an array unless its keeper allows more.
pub const MOST_TASKS: u32 = 1000;

/// Who divides the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// Slurm: a shell script that submits an array and a task after it.
    Slurm,
    /// Open Job Description, as render managers and its own `openjd` run it: a template.
    OpenJd,
    /// GNU parallel, on one machine or several by ssh: a shell script.
    Parallel,
}

impl Engine {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Slurm, Self::OpenJd, Self::Parallel];

    /// Its name on the command line.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Slurm => "slurm",
            Self::OpenJd => "openjd",
            Self::Parallel => "parallel",
        }
    }
}

impl FromStr for Engine {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|e| e.name() == text).ok_or_else(|| {
            let known: Vec<&str> = Self::ALL.iter().map(|e| e.name()).collect();
            format!("`{text}` is no engine that is known here; engines: {}", known.join(", "))
        })
    }
}

/// What is to be divided.
#[derive(Debug, Clone)]
pub struct Farm<'a> {
    /// The program as the machines find it.
    pub program: &'a str,
    /// The lessons, by paths that hold on all machines.
    pub projects: &'a [&'a Path],
    /// What `lianpu export` is told beside lessons, place, threads and part.
    pub options: &'a [String],
    /// Where the files go, likewise.
    pub out: &'a Path,
    /// Into how many parts, 1 to [`MOST_TASKS`].
    pub tasks: u32,
    /// Threads of each.
    pub threads: u16,
    /// How many frames there are in all: to be read by people.
    pub frames: u64,
}

impl Farm<'_> {
    /// The text of the job.
    ///
    /// # Errors
    /// When a path cannot be written down in it.
    pub fn job(&self, engine: Engine) -> Result<String> {
        let export = self.export(engine)?;
        let program = quoted(text_of(Path::new(self.program), engine)?);
        let merge = format!("{program} merge {}", quoted(text_of(self.out, engine)?));
        Ok(match engine {
            Engine::Slurm => self.slurm(&export, &merge),
            Engine::OpenJd => self.openjd(&export, &merge),
            Engine::Parallel => self.parallel(&export, &merge),
        })
    }

    /// The call of one task, with its part where the engine puts it.
    fn export(&self, engine: Engine) -> Result<String> {
        let part = match engine {
            Engine::Slurm => "\"$SLURM_ARRAY_TASK_ID\"",
            Engine::OpenJd => "{{Task.Param.Part}}",
            Engine::Parallel => "\"$1\"",
        };
        let mut call = format!("{} export", quoted(text_of(Path::new(self.program), engine)?));
        for option in self.options {
            let _ = write!(call, " {}", quoted(text_of(Path::new(option), engine)?));
        }
        let out = quoted(text_of(self.out, engine)?);
        let _ = write!(call, " --jobs {} --out {out} --shard {part}/{} --", self.threads, self.tasks);
        for project in self.projects {
            let _ = write!(call, " {}", quoted(text_of(project, engine)?));
        }
        Ok(call)
    }

    fn heading(&self) -> String {
        let lessons = match self.projects.len() {
            1 => "1 lesson".to_owned(),
            n => format!("{n} lessons"),
        };
        let tasks = if self.tasks == 1 { "1 task" } else { &format!("{} tasks", self.tasks) };
        format!("{lessons}, {} frames, in {tasks}", self.frames)
    }

    fn slurm(&self, export: &str, merge: &str) -> String {
        format!(
            "#!/bin/sh
# {heading}, on a Slurm cluster. Run this where `sbatch` is; the nodes need the program, the lessons and the
# output folder under the paths below. Run it again after a failure: what is done and right is not done again.
set -eu
array=$(sbatch --parsable --job-name=lianpu-export --array=1-{tasks} --requeue --ntasks=1 --cpus-per-task={threads} \\
  <<'LIANPU_JOB'
#!/bin/sh
exec {export}
LIANPU_JOB
)
array=${{array%%;*}}
merge=$(sbatch --parsable --job-name=lianpu-merge --dependency=\"afterok:$array\" --kill-on-invalid-dep=yes --ntasks=1 \\
  <<'LIANPU_JOB'
#!/bin/sh
exec {merge}
LIANPU_JOB
)
echo \"export $array, merge ${{merge%%;*}}\"
",
            heading = self.heading(),
            tasks = self.tasks,
            threads = self.threads,
        )
    }

    fn openjd(&self, export: &str, merge: &str) -> String {
        format!(
            "# {heading}. On this machine: openjd run THIS-FILE
specificationVersion: jobtemplate-2023-09
name: lianpu-export
steps:
  - name: Export
    parameterSpace:
      taskParameterDefinitions:
        - name: Part
          type: INT
          range: \"1-{tasks}\"
    script:
      actions:
        onRun:
          command: \"{{{{Task.File.Run}}}}\"
      embeddedFiles:
        - name: Run
          type: TEXT
          runnable: true
          data: |
            #!/bin/sh
            exec {export}
  - name: Merge
    dependencies:
      - dependsOn: Export
    script:
      actions:
        onRun:
          command: \"{{{{Task.File.Run}}}}\"
      embeddedFiles:
        - name: Run
          type: TEXT
          runnable: true
          data: |
            #!/bin/sh
            exec {merge}
",
            heading = self.heading(),
            tasks = self.tasks,
        )
    }

    fn parallel(&self, export: &str, merge: &str) -> String {
        let task = quoted(&format!("exec {export}")).into_owned();
        format!(
            "#!/bin/sh
# {heading}, by GNU parallel: one at a time on each core, or as the variable PARALLEL says, such as
# PARALLEL='--jobs 4' or PARALLEL='--sshlogin one,two'. Run it again after a failure: what is done is not done again.
set -eu
LIANPU_TASK={task}
export LIANPU_TASK
seq {tasks} | sed 's/.*/sh -c \"$LIANPU_TASK\" task &/' | parallel --env LIANPU_TASK --retries 2
{merge}
",
            heading = self.heading(),
            tasks = self.tasks,
        )
    }
}

/// A path as text that can stand in a job of this engine.
fn text_of(path: &Path, engine: Engine) -> Result<&str> {
    let fault = |what: &str| {
        Fault::of(ExportFault::Division, format!("a job cannot name `{}`: it {what}", path.display()))
            .help("give it another name")
            .of_the_call()
    };
    let text = path.to_str().ok_or_else(|| fault("is not UTF-8"))?;
    if text.chars().any(|c| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{FEFF}')) {
        return Err(fault("holds a line break or another control character"));
    }
    if engine == Engine::OpenJd && text.contains("{{") {
        return Err(fault("holds `{{`, which the template would replace"));
    }
    Ok(text)
}

/// A word as a POSIX shell takes it.
fn quoted(word: &str) -> std::borrow::Cow<'_, str> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_/.:=@%+,-".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.into()
    } else {
        format!("'{}'", word.replace('\'', "'\\''")).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn farm<'a>(projects: &'a [&'a Path], options: &'a [String]) -> Farm<'a> {
        Farm { program: "lianpu", projects, options, out: Path::new("/out/a b"), tasks: 9, threads: 1, frames: 7500 }
    }

    #[cfg(unix)]
    #[test]
    fn odd_paths_reach_the_program_as_they_are() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("it's `lianpu`");
        std::fs::write(&program, "#!/bin/sh\nprintf '%s|' \"$@\"\n").unwrap();
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
        let odd = "/l/it's \"$HOME\" `x` \\ {} * 您好;#! %a";
        let (options, projects) = (["--to".to_owned(), "png,svg".to_owned()], [Path::new(odd)]);
        let farm = Farm { program: program.to_str().unwrap(), ..farm(&projects, &options) };
        // The shell itself says what it understands.
        let run = |script: String| {
            let mut shell = std::process::Command::new("sh");
            let out = shell.args(["-c", &script, "task", "3"]).env("SLURM_ARRAY_TASK_ID", "3").output().unwrap();
            assert!(out.status.success(), "{script}\n{out:?}");
            String::from_utf8(out.stdout).unwrap()
        };
        let expected = format!("export|--to|png,svg|--jobs|1|--out|/out/a b|--shard|3/9|--|{odd}|");
        assert_eq!(run(farm.export(Engine::Slurm).unwrap()), expected);
        assert_eq!(run(farm.export(Engine::OpenJd).unwrap().replace("{{Task.Param.Part}}", "3")), expected);
        let job = farm.job(Engine::Parallel).unwrap();
        let (start, _) = job.split_once("seq ").unwrap();
        assert_eq!(run(format!("{start}sh -c \"$LIANPU_TASK\" task 3")), expected);
        assert_eq!(run(job.lines().last().unwrap().to_owned()), "merge|/out/a b|");
    }

    #[test]
    fn what_a_job_cannot_hold_is_refused() {
        for (path, engine, refused) in [
            ("/a\nLIANPU_JOB", Engine::Slurm, true),
            ("/a\u{1b}[0m", Engine::Parallel, true),
            ("/a{{b}}", Engine::OpenJd, true),
            ("/a{{b}}", Engine::Slurm, false),
        ] {
            let projects = [Path::new(path)];
            assert_eq!(farm(&projects, &[]).job(engine).is_err(), refused, "{path:?}");
        }
    }
}
