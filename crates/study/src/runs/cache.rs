//! What consecutive runs have in common, kept while it is in use.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Entries by the numbers that tell them apart; the oldest leave first, so that memory
/// does not grow with the number of runs.
#[derive(Debug)]
pub(super) struct Cache<T> {
    entries: Mutex<VecDeque<Entry<T>>>,
    most: usize,
}

type Entry<T> = (Vec<u64>, Arc<OnceLock<T>>);

impl<T: Clone> Cache<T> {
    pub(super) fn new(most: usize) -> Self {
        Self {
            entries: Mutex::default(),
            most: most.max(1),
        }
    }

    /// The entry of a key, made if it is not there; made once if several threads ask.
    pub(super) fn get(&self, key: &[u64], make: impl FnOnce() -> T) -> T {
        let place = {
            // A panic of another thread leaves the list as sound as it was.
            let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
            match entries.iter().rev().find(|(k, _)| k == key) {
                Some((_, place)) => Arc::clone(place),
                None => {
                    let place = Arc::default();
                    entries.push_back((key.to_vec(), Arc::clone(&place)));
                    if entries.len() > self.most {
                        entries.pop_front();
                    }
                    place
                }
            }
        };
        place.get_or_init(make).clone()
    }
}
