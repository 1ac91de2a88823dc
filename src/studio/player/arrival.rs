//! Reads a ratio record on a thread of its own, as far ahead as there is room for.

use std::io::Read;
use std::thread;

use crossbeam_channel::{Receiver, Sender, bounded, unbounded};

use crate::disk::Fault;
use crate::ratios::{Moment, RecordReader};

/// The most frames that wait to be shown: 40 seconds at 25 a second. A file that is piped in waits there.
const AHEAD: usize = 1000;

/// A report of the reader.
#[derive(Debug)]
pub(crate) enum Arrived {
    /// A frame.
    Moment(Box<Moment>),
    /// The end, with the fault where the record is cut or damaged.
    End(Option<Fault>),
}

/// The room for frames that wait.
pub(super) struct Room {
    free: Sender<()>,
    /// Open as long as the player: a channel that closes when the reader is done would wake the loop for ever.
    _reports: Sender<Arrived>,
}

impl Room {
    /// Makes room for one more frame, after one was taken.
    pub(crate) fn give_back(&self) {
        // It holds as many as were taken from it.
        let _ = self.free.try_send(());
    }
}

/// Starts the reader. It ends at the record's end, or when the receiver or the room is dropped.
pub(super) fn read_ahead(input: impl Read + Send + 'static) -> (Room, Receiver<Arrived>) {
    let (sender, arrived) = unbounded();
    let (free, room) = bounded(AHEAD);
    for _ in 0..AHEAD {
        let _ = free.send(());
    }
    let reports = sender.clone();
    thread::spawn(move || read(input, &sender, &room));
    (Room { free, _reports: reports }, arrived)
}

fn read(input: impl Read, to: &Sender<Arrived>, room: &Receiver<()>) {
    let mut reader = match RecordReader::new(input) {
        Ok(reader) => reader,
        Err(fault) => {
            let _ = to.send(Arrived::End(Some(fault)));
            return;
        }
    };
    loop {
        let next = match reader.next_moment() {
            Ok(Some(moment)) => Arrived::Moment(Box::new(moment)),
            Ok(None) => Arrived::End(None),
            Err(fault) => Arrived::End(Some(fault)),
        };
        let ends = matches!(next, Arrived::End(_));
        let is_room = ends || room.recv().is_ok();
        if !is_room || to.send(next).is_err() || ends {
            return;
        }
    }
}
