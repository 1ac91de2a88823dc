//! The sums of files that begin alike, as the frames of a clip do: what they have in common is added up once.

use sha2::{Digest, Sha256};

use super::manifest::hex;

/// The sum is known after every so many bytes of the last file.
const STEP: usize = 4096;

/// Adds up files one after another.
#[derive(Default)]
pub(super) struct Digests {
    last: Vec<u8>,
    /// After one step, two steps, and so on.
    known: Vec<Sha256>,
}

impl Digests {
    /// The SHA-256 of a file, in hexadecimal digits.
    pub(super) fn of(&mut self, content: &[u8]) -> String {
        let alike = self.last.chunks_exact(STEP).zip(content.chunks_exact(STEP)).take_while(|(a, b)| a == b).count();
        self.known.truncate(alike);
        let mut sum = self.known.last().cloned().unwrap_or_default();
        let from = STEP * self.known.len();
        for step in content[from..].chunks(STEP) {
            sum.update(step);
            if step.len() == STEP {
                self.known.push(sum.clone());
            }
        }
        self.last.truncate(from);
        self.last.extend_from_slice(&content[from..]);
        hex(&sum.finalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sums_are_those_of_each_file_alone(
            files in prop::collection::vec((0_usize..20_000, 0_usize..20_000, 0_u8..3), 1..8),
        ) {
            let mut digests = Digests::default();
            for (length, from, other) in files {
                let file: Vec<u8> = (0..length).map(|i| if i < from { i as u8 } else { i as u8 ^ other }).collect();
                prop_assert_eq!(digests.of(&file), hex(&Sha256::digest(&file)));
            }
        }
    }
}
