//! The likeliest way through the candidates of all steps.

/// What it costs, in natural logarithms, that a voice begins or ends from one step to the next.
const TURN: f32 = 3.0;

/// What a change of pitch costs for each octave: a voice moves a few semitones in 50 ms, ten steps.
const OCTAVE: f32 = 24.0;

/// What one jump costs at most: where a voice creaks, or one speaker follows another.
const JUMP: f32 = 7.0;

/// The pitch of each step, of its candidates (Hz and probability) or none.
///
/// Viterbi: every candidate costs −ln of its probability, no voice −ln of what is left, a way the sum of its candidates
/// and of the changes between.
pub(super) fn likeliest(frames: &[Vec<(f32, f32)>]) -> Vec<Option<f32>> {
    // Of each state of each step, where the best way to it comes from; state 0 is no voice.
    let mut from: Vec<Vec<u8>> = Vec::with_capacity(frames.len());
    let mut costs = vec![0.0_f32];
    let mut before: Vec<f32> = Vec::new();
    for frame in frames {
        let octaves: Vec<f32> = frame.iter().map(|c| c.0.log2()).collect();
        let left = 1.0 - frame.iter().map(|c| c.1).sum::<f32>();
        let own = std::iter::once(left).chain(frame.iter().map(|c| c.1)).map(|p| -p.max(0.001).ln());
        let mut back = Vec::with_capacity(frame.len() + 1);
        let next: Vec<f32> = own
            .enumerate()
            .map(|(state, own)| {
                let change = |past: usize| match (past, state) {
                    (0, 0) => 0.0,
                    (0, _) | (_, 0) => TURN,
                    (a, b) => ((before[a - 1] - octaves[b - 1]).abs() * OCTAVE).min(JUMP),
                };
                let ways = costs.iter().enumerate().map(|(past, cost)| (past, cost + change(past)));
                let best = ways.fold((0, f32::INFINITY), |a, b| if b.1 < a.1 { b } else { a });
                back.push(best.0.min(255) as u8);
                own + best.1
            })
            .collect();
        // Kept small, so that an hour's sum loses nothing.
        let least = next.iter().copied().fold(f32::INFINITY, f32::min);
        costs = next.into_iter().map(|c| c - least).collect();
        from.push(back);
        before = octaves;
    }
    let last = costs.iter().enumerate().fold((0, f32::INFINITY), |a, (i, c)| if *c < a.1 { (i, *c) } else { a });
    let mut state = last.0;
    let mut way: Vec<Option<f32>> = Vec::with_capacity(frames.len());
    for (frame, back) in frames.iter().zip(&from).rev() {
        way.push(state.checked_sub(1).and_then(|c| frame.get(c)).map(|c| c.0));
        state = usize::from(back.get(state).copied().unwrap_or(0));
    }
    way.reverse();
    way
}

/// Takes out what is too short to be a voice: fewer than three of its own periods. In noise a long period may fit once.
pub(super) fn without_chance(mut hertz: Vec<Option<f32>>, step: f64) -> Vec<Option<f32>> {
    for run in hertz.chunk_by_mut(|a, b| a.is_some() == b.is_some()) {
        let periods: f64 = run.iter().flatten().map(|h| f64::from(*h) * step).sum();
        if periods < 3.0 {
            run.fill(None);
        }
    }
    hertz
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_likelier_octave_for_a_moment_does_not_break_the_way() {
        let mut frames = vec![vec![(200.0, 0.7), (100.0, 0.2)]; 20];
        frames[10] = vec![(200.0, 0.3), (100.0, 0.6)];
        frames[15] = vec![(200.0, 0.3)];
        assert_eq!(likeliest(&frames), vec![Some(200.0); 20]);
    }

    #[test]
    fn no_voice_is_no_pitch() {
        assert_eq!(likeliest(&[]), Vec::<Option<f32>>::new());
        assert_eq!(likeliest(&vec![vec![]; 3]), vec![None; 3]);
        let frames = [vec![vec![]; 5], vec![vec![(150.0, 0.9)]; 10], vec![vec![]; 5]].concat();
        let voiced: Vec<bool> = likeliest(&frames).iter().map(Option::is_some).collect();
        assert_eq!(voiced, [vec![false; 5], vec![true; 10], vec![false; 5]].concat());
    }
}
