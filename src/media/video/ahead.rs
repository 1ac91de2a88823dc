//! Frames decoded ahead on a thread of their own, in order, a few at a time.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use crossbeam_channel::{Receiver, bounded};

use super::ffmpeg::Reading;
use super::{Frame, folder};
use crate::disk::{Fault, FileFault, Result};

/// The frames of a video, one after the other.
#[derive(Debug)]
pub struct Frames {
    coming: Option<Receiver<Result<Frame>>>,
    decoder: Option<JoinHandle<()>>,
    running: Option<Arc<Mutex<Reading>>>,
    ended: bool,
}

/// So many bytes wait at most, and so many frames.
const WAITING: usize = 24 << 20;
const MOST: usize = 16;

impl Frames {
    /// What `next` gives until it gives none or a fault, decoded on another thread. A frame takes about `bytes`.
    pub(super) fn of(
        bytes: usize,
        running: Option<Reading>,
        mut next: impl FnMut() -> Result<Option<Frame>> + Send + 'static,
    ) -> Self {
        let (give, coming) = bounded((WAITING / bytes.max(1)).clamp(1, MOST));
        let decoder = std::thread::spawn(move || {
            while let Some(item) = next().transpose() {
                let last = item.is_err();
                // Nobody waits for it any more, or nothing comes after it.
                if give.send(item).is_err() || last {
                    break;
                }
            }
        });
        let running = running.map(|r| Arc::new(Mutex::new(r)));
        Self { coming: Some(coming), decoder: Some(decoder), running, ended: false }
    }

    /// The pictures of a folder.
    pub(super) fn of_pictures(paths: Arc<[PathBuf]>, fps: f64, bytes: usize) -> Self {
        let mut number = 0;
        let mut size = None;
        Self::of(bytes, None, move || {
            let Some(path) = paths.get(number as usize) else { return Ok(None) };
            let frame = folder::frame(path, number, fps)?;
            let own = [frame.grey.width(), frame.grey.height()];
            let first = *size.get_or_insert(own);
            if own != first {
                let [w, h] = first;
                return Err(Fault::of(
                    FileFault::Mismatch,
                    format!("frame {number} has {} × {} pixels, the first {w} × {h}", own[0], own[1]),
                )
                .at(path)
                .help("frames of one video have one size; take other pictures out of the folder"));
            }
            number += 1;
            Ok(Some(frame))
        })
    }
}

impl Iterator for Frames {
    type Item = Result<Frame>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let item = self.coming.as_ref().and_then(|c| c.recv().ok());
        self.ended = !matches!(item, Some(Ok(_)));
        if !self.ended {
            return item;
        }
        // A decoder that broke off is no end of the video.
        if item.is_none() && self.decoder.take().is_some_and(|d| d.join().is_err()) {
            return Some(Err(Fault::new("a frame could not be decoded").help("save the frames again as PNG or JPEG")));
        }
        // What the program that wrote the stream says is nearer to the cause than where it stopped.
        let said = self.running.as_ref().and_then(|r| {
            let mut running = r.lock().unwrap_or_else(PoisonError::into_inner);
            running.ended().err()
        });
        said.map(Err).or(item)
    }
}

impl Drop for Frames {
    fn drop(&mut self) {
        // First the end of what is waited for, then of who waits.
        self.coming = None;
        if let Some(running) = &self.running {
            running.lock().unwrap_or_else(PoisonError::into_inner).stop();
        }
        if let Some(decoder) = self.decoder.take() {
            let _ = decoder.join();
        }
    }
}
