//! Things that many drawings have in common, made once.

use std::sync::Arc;

use super::{Item, fingerprint};

/// Items shared between drawings. A clone shares them too, and two that share them are equal without a look at them.
#[derive(Debug, Clone)]
pub struct Shared {
    items: Arc<[Item]>,
    fingerprint: u64,
}

impl Shared {
    /// Shares `items`.
    #[must_use]
    pub(crate) fn new(items: Vec<Item>) -> Self {
        let fingerprint = fingerprint::of_items(&items);
        Self { items: items.into(), fingerprint }
    }

    /// Back to front.
    #[must_use]
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    /// 64 bits of all that is drawn.
    #[must_use]
    pub(crate) fn fingerprint(&self) -> u64 {
        self.fingerprint
    }
}

impl PartialEq for Shared {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.items, &other.items) || self.items == other.items
    }
}
