//! An export divided among machines: the frames of all its lessons are one long list, cut into neighbouring parts, so that
//! lessons stay whole where they can and only some are cut between two frames.

use std::env;
use std::ops::Range;

use super::{ExportFault, Shard};
use crate::disk::{Fault, Result, Setting, message};

/// One clip's share in a part of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Share {
    /// Which of the clip's frames, as places in the list of those that were asked for.
    pub frames: Range<u32>,
    /// Whether its files that are not frames belong to this part: where its first frame does.
    pub whole_files: bool,
}

impl Share {
    /// Whether nothing of the clip is to be done.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.frames.is_empty() && !self.whole_files
    }
}

/// What a part has of each clip, by how many frames are asked of each. A clip without frames counts as one.
#[must_use]
pub fn divide(counts: &[u32], shard: Shard) -> Vec<Share> {
    let weight = |count: &u32| u64::from(*count).max(1);
    let all: u64 = counts.iter().map(weight).sum();
    let border = |i: u32| all * u64::from(i) / u64::from(shard.count());
    let (from, until) = (border(shard.index() - 1), border(shard.index()));
    let mut start = 0;
    let share = |count: &u32| {
        let inside = |at: u64| at.saturating_sub(start).min(weight(count)) as u32;
        let frames = inside(from).min(*count)..inside(until).min(*count);
        let whole_files = (from..until).contains(&start);
        start += weight(count);
        Share { frames, whole_files }
    };
    counts.iter().map(share).collect()
}

/// The part that a task of a Slurm job array is to do: its number − the lowest, in steps, + 1 of their count; none
/// outside one. A job that is not an array's, and one of a single task, does everything.
///
/// # Errors
/// When the variables are there but say nothing that can be.
pub fn shard_of_array() -> Result<Option<Shard>> {
    shard_from(|name| env::var(name).ok())
}

fn shard_from(variable: impl Fn(&str) -> Option<String>) -> Result<Option<Shard>> {
    let Some(own) = variable("SLURM_ARRAY_TASK_ID") else { return Ok(None) };
    let number = |name: &str, otherwise: Option<u32>| match (variable(name), otherwise) {
        (Some(text), _) => text.trim().parse::<u32>().ok(),
        (None, otherwise) => otherwise,
    };
    let shard = (|| {
        let own = own.trim().parse::<u32>().ok()?;
        let lowest = number("SLURM_ARRAY_TASK_MIN", None)?;
        let count = number("SLURM_ARRAY_TASK_COUNT", None)?;
        let step = number("SLURM_ARRAY_TASK_STEP", Some(1))?.max(1);
        let above = own.checked_sub(lowest)?;
        // A list such as 1,5,7 has no even steps: which place a number has in it cannot be known.
        above.is_multiple_of(step).then_some(())?;
        Shard::new(above / step + 1, count)
    })();
    shard.map(Some).ok_or_else(|| {
        Fault::of(ExportFault::Division, format!("it cannot be told which part task {own} of this job array is to do"))
            .help(message![
                "say it with ",
                Setting::Shard.of("I/N"),
                "; arrays in even steps, such as 1-9 or 0-8, need not"
            ])
            .of_the_call()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_frame_and_every_whole_file_belongs_to_one_part(
            counts in prop::collection::vec(0_u32..40, 1..12), parts in 1_u32..20,
        ) {
            let mut next = vec![0; counts.len()];
            let mut owners = vec![0; counts.len()];
            for index in 1..=parts {
                for (clip, share) in divide(&counts, Shard::new(index, parts).unwrap()).into_iter().enumerate() {
                    if !share.frames.is_empty() {
                        prop_assert_eq!(share.frames.start, next[clip]);
                        next[clip] = share.frames.end;
                    }
                    owners[clip] += u32::from(share.whole_files);
                }
            }
            prop_assert_eq!(next, counts.clone());
            prop_assert_eq!(owners, vec![1; counts.len()]);
        }
    }

    #[test]
    fn lessons_are_kept_whole_where_they_can_be() {
        let shares = |index| divide(&[100, 100, 100, 100], Shard::new(index, 2).unwrap());
        let frames = |index: u32| shares(index).into_iter().map(|s| s.frames.len()).collect::<Vec<_>>();
        assert_eq!(frames(1), [100, 100, 0, 0]);
        assert_eq!(frames(2), [0, 0, 100, 100]);
    }

    #[test]
    fn a_task_of_an_array_knows_its_part() {
        let of = |variables: &[(&str, &str)]| {
            let variables: Vec<(String, String)> =
                variables.iter().map(|(k, v)| (format!("SLURM_ARRAY_TASK_{k}"), (*v).to_owned())).collect();
            shard_from(move |name| variables.iter().find(|v| v.0 == name).map(|v| v.1.clone()))
                .map(|s| s.map(|s| s.to_string()))
        };
        assert_eq!(of(&[]).unwrap(), None);
        assert_eq!(of(&[("ID", "4"), ("MIN", "2"), ("COUNT", "5")]).unwrap().as_deref(), Some("3/5"));
        assert_eq!(of(&[("ID", "8"), ("MIN", "0"), ("STEP", "4"), ("COUNT", "3")]).unwrap().as_deref(), Some("3/3"));
        assert_eq!(of(&[("ID", "0"), ("MIN", "0"), ("COUNT", "1")]).unwrap().as_deref(), Some("1/1"));
        for wrong in [
            &[("ID", "x"), ("MIN", "0"), ("COUNT", "3")][..],
            &[("ID", "1")],
            &[("ID", "0"), ("MIN", "1"), ("COUNT", "3")],
            &[("ID", "7"), ("MIN", "1"), ("COUNT", "3")],
            &[("ID", "3"), ("MIN", "0"), ("STEP", "2"), ("COUNT", "3")],
        ] {
            assert!(of(wrong).is_err(), "{wrong:?}");
        }
    }
}
