//! What was made lately, within so many bytes.

use super::print::{ByPrint, Print};

/// Things by their prints. When the newer half of the room is full the older half is given up; what is asked for
/// becomes new.
pub(super) struct Recent<T> {
    new: ByPrint<(T, usize)>,
    old: ByPrint<(T, usize)>,
    bytes: usize,
    room: usize,
}

impl<T: Clone> Recent<T> {
    pub(super) fn new(room: usize) -> Self {
        Self { new: ByPrint::default(), old: ByPrint::default(), bytes: 0, room }
    }

    pub(super) fn get(&mut self, print: &Print) -> Option<T> {
        if let Some((thing, _)) = self.new.get(print) {
            return Some(thing.clone());
        }
        let (thing, bytes) = self.old.remove(print)?;
        self.put(*print, thing.clone(), bytes);
        Some(thing)
    }

    pub(super) fn put(&mut self, print: Print, thing: T, bytes: usize) {
        // What the table itself takes of each.
        let bytes = bytes + 48;
        if bytes > self.room / 2 {
            return;
        }
        if self.bytes + bytes > self.room / 2 {
            self.old = std::mem::take(&mut self.new);
            self.bytes = 0;
        }
        self.bytes += bytes;
        self.new.insert(print, (thing, bytes - 48));
    }
}

impl Recent<()> {
    /// Whether it has been asked for lately.
    pub(super) fn again(&mut self, print: Print) -> bool {
        let again = self.get(&print).is_some();
        if !again {
            self.put(print, (), 0);
        }
        again
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_asked_for_stays_and_the_rest_goes_when_there_is_no_room() {
        let mut recent = Recent::new(10_000);
        let print = |n: u64| {
            let mut print = Print::START;
            print.word(n);
            print
        };
        for n in 0..1000 {
            recent.put(print(n), n, 1000);
            assert_eq!(recent.get(&print(0)), Some(0));
            assert!(recent.new.len() + recent.old.len() <= 10);
        }
        assert!(recent.get(&print(500)).is_none());
    }
}
