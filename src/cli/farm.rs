//! `lianpu farm`.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Parser;

use super::output_fault;
use crate::disk::{Fault, Result};
use crate::export::{Engine, Farm, MOST_TASKS, asked};
use crate::project::Lesson;

/// Print the job that exports lessons on many machines.
///
/// It is an array of parts, and a task after them that joins them.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// slurm, openjd or parallel.
    engine: Engine,
    /// The projects, or folders of them.
    #[arg(value_name = "PROJECT", required = true)]
    projects: Vec<PathBuf>,
    /// The forms, as `lianpu export` has them.
    #[arg(long = "to", value_name = "FORMAT", required = true)]
    formats: String,
    /// Where the files go, on all machines; PROJECT/export where left out and there is one project.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Into how many parts; one a lesson where left out.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_TASKS)))]
    tasks: Option<u32>,
    /// Threads of each part.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: u16,
    /// The program as the machines find it.
    #[arg(long, value_name = "FILE", default_value = "lianpu")]
    program: String,
    /// Further options of `lianpu export`, after `--`: -- --size 640x360
    #[arg(last = true, value_name = "OPTION")]
    more: Vec<String>,
}

/// Prints the job.
///
/// # Errors
/// When a lesson cannot be read, options are none of `lianpu export`, or a path cannot stand in a job.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let mut options = vec!["--to".to_owned(), args.formats.clone()];
    options.extend(args.more.iter().cloned());
    let request = super::export::request_of(&check_options(&options)?);
    let projects = super::lessons(&args.projects);
    let mut frames = 0;
    for project in &projects {
        let clips = asked(&Lesson::read(project)?, &request)?;
        frames += clips.iter().map(|clip| u64::from(clip.count())).sum::<u64>();
    }
    let place = match (&args.out, &projects[..]) {
        (Some(out), _) => out.clone(),
        (None, [only]) => only.join("export"),
        (None, _) => {
            return Err(Fault::new("several lessons need one place for their parts")
                .help("say where, with --out DIR, by a path that holds on all machines")
                .of_the_call());
        }
    };
    let place = std::path::absolute(&place).map_err(|e| Fault::io("cannot tell where it is", &place, e))?;
    let full = |p: &PathBuf| p.canonicalize().map_err(|e| Fault::io("cannot open the folder", p, e));
    let projects = projects.iter().map(full).collect::<Result<Vec<_>>>()?;
    let projects: Vec<&Path> = projects.iter().map(PathBuf::as_path).collect();
    let lessons = u32::try_from(projects.len()).unwrap_or(MOST_TASKS);
    let farm = Farm {
        program: &args.program,
        projects: &projects,
        options: &options,
        out: &place,
        tasks: args.tasks.unwrap_or(lessons).clamp(1, MOST_TASKS),
        threads: args.threads,
        frames,
    };
    out.write_all(farm.job(args.engine)?.as_bytes()).map_err(output_fault)
}

/// What `lianpu export` would refuse is refused now, not on every machine.
fn check_options(options: &[String]) -> Result<super::export::Args> {
    for own in ["--shard", "--out", "--jobs"] {
        if options.iter().any(|o| o == own || o.starts_with(&format!("{own}="))) {
            return Err(Fault::new(format!("the job itself says `{own}`"))
                .help("give --out, --tasks and --threads before the `--`")
                .of_the_call());
        }
    }
    let refused = |what: &str| {
        Fault::new(format!("`lianpu export` would refuse this: {what}"))
            .help("see `lianpu export --help`")
            .of_the_call()
    };
    // A word of its own stands where the lessons will.
    const LESSON: &str = "x";
    let words = ["lianpu", "export"].into_iter().chain(options.iter().map(String::as_str)).chain(["--", LESSON]);
    let parsed = super::Cli::try_parse_from(words).map_err(|e| {
        let text = e.to_string();
        refused(text.lines().next().unwrap_or_default().trim_start_matches("error: "))
    })?;
    match parsed.command {
        Some(super::Command::Export(args)) if args.projects == [Path::new(LESSON)] => Ok(args),
        _ => Err(Fault::new("only options may stand after the `--`").help("name the lessons before it").of_the_call()),
    }
}
