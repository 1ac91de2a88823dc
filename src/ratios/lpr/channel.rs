//! One value of a frame as it goes on from frame to frame.

use super::coder::Coder;
use super::model::Bit;

/// How many ways a channel and its group can have been busy.
const OWN: usize = 9;
const ALL: usize = 6;

/// A channel: its last value and changes, and what was learned of it.
#[derive(Debug, Clone)]
pub(super) struct Channel {
    pub last: i64,
    changes: [i64; 2],
    still: Box<[[Bit; ALL]; OWN]>,
    down: [Bit; 3],
}

impl Channel {
    pub(crate) fn new(last: i64) -> Self {
        Self { last, changes: [0; 2], still: Box::new([[Bit::NEW; ALL]; OWN]), down: [Bit::NEW; 3] }
    }
}

/// Channels that move together.
#[derive(Debug, Clone)]
pub(super) struct Group {
    pub channels: Vec<Channel>,
    sizes: Box<[[Bit; 15]; OWN]>,
}

impl Group {
    pub(crate) fn new(first: &[i64]) -> Self {
        Self { channels: first.iter().map(|v| Channel::new(*v)).collect(), sizes: Box::new([[Bit::NEW; 15]; OWN]) }
    }

    /// How busy each channel and the others of its group were.
    fn busy(&self) -> Vec<(usize, usize)> {
        let sum = self.channels.iter().fold(0_u64, |sum, c| sum.saturating_add(c.changes[0].unsigned_abs()));
        let of = |c: &Channel| {
            let [r1, r2] = c.changes.map(i64::unsigned_abs);
            let own = r1.saturating_mul(2).saturating_add(r2);
            let all = sum.saturating_sub(r1);
            let own = if own < 4 { own } else { 4 + (own - 4) / 3 };
            let all = if all < 3 { all } else { 3 + (all - 3) / 4 };
            (own.min(OWN as u64 - 1) as usize, all.min(ALL as u64 - 1) as usize)
        };
        self.channels.iter().map(of).collect()
    }

    /// What it would cost to write values to each channel, in 256ths of a bit.
    pub(crate) fn costs(&self, values: &[Vec<i64>]) -> Vec<Vec<u32>> {
        let busy = self.busy();
        let of = |at: usize, value: i64| {
            let (channel, (own, all)) = (&self.channels[at], busy[at]);
            let change = value.saturating_sub(channel.last);
            let still = channel.still[own][all];
            if change == 0 {
                return still.cost(false);
            }
            let sign = channel.down[sign_of(channel.changes[0])].cost(change < 0);
            let size = change.unsigned_abs() - 1;
            let unary = self.sizes[own].iter().enumerate().take(size.saturating_add(1).min(15) as usize);
            let unary: u32 = unary.map(|(at, bit)| bit.cost(size > at as u64)).sum();
            let beyond = if size >= 15 { 256 * (2 * (size - 14).ilog2() + 1) } else { 0 };
            still.cost(true) + sign + unary + beyond
        };
        values.iter().enumerate().map(|(at, values)| values.iter().map(|v| of(at, *v)).collect()).collect()
    }

    /// Writes or reads a value of every channel.
    pub(crate) fn code(&mut self, coder: &mut impl Coder, values: &[i64]) {
        for (at, (own, all)) in self.busy().into_iter().enumerate() {
            let channel = &mut self.channels[at];
            let wanted = values.get(at).map_or(0, |v| v.saturating_sub(channel.last));
            let mut change = 0;
            if coder.bit(&mut channel.still[own][all], wanted != 0) {
                let down = coder.bit(&mut channel.down[sign_of(channel.changes[0])], wanted < 0);
                let size = coder.whole(&mut self.sizes[own], wanted.unsigned_abs().saturating_sub(1));
                let size = i64::try_from(size).unwrap_or(i64::MAX).saturating_add(1);
                change = if down { -size } else { size };
            }
            channel.last = channel.last.saturating_add(change);
            channel.changes = [change, channel.changes[0]];
        }
    }
}

fn sign_of(change: i64) -> usize {
    match change {
        0 => 0,
        1.. => 1,
        _ => 2,
    }
}
