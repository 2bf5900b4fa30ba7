//! Which shards of a study a result holds: one, all, or some that were merged already.

/// More shards than a study is dealt in.
pub const MOST_SHARDS: usize = 1_000_000;

/// Shards of a study. Runs are dealt out in chunks, one after another: the first chunk belongs
/// to the first shard, the second to the second, and after the last it begins anew.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Shards from 1, ascending.
    shards: Vec<usize>,
    /// Number of all shards of the study.
    of: usize,
}

impl Part {
    /// The whole study.
    #[must_use]
    pub fn whole() -> Self {
        Self {
            shards: vec![1],
            of: 1,
        }
    }

    /// Some shards of `of`; `None` if their numbers cannot be. All of them are the whole.
    #[must_use]
    pub fn of(mut shards: Vec<usize>, of: usize) -> Option<Self> {
        shards.sort_unstable();
        let twice = shards.windows(2).any(|pair| pair[0] == pair[1]);
        let (first, last) = (*shards.first()?, *shards.last()?);
        if twice || first == 0 || last > of {
            return None;
        }
        Some(match shards.len() == of {
            true => Self::whole(),
            false => Self { shards, of },
        })
    }

    /// Whether it is the whole study.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.of == 1
    }

    /// Shards from 1, ascending.
    #[must_use]
    pub fn shards(&self) -> &[usize] {
        &self.shards
    }

    /// Number of all shards of the study.
    #[must_use]
    pub fn count(&self) -> usize {
        self.of
    }

    /// Rows of a result that holds it, of a study of so many runs, in the order of their
    /// numbers; `None` if there cannot be so many.
    #[must_use]
    pub fn rows(&self, runs: usize, chunk: usize) -> Option<usize> {
        let all = runs.div_ceil(if chunk == 0 { return None } else { chunk });
        let of_shard = |shard: &usize| all.saturating_sub(shard - 1).div_ceil(self.of);
        let chunks: usize = self.shards.iter().map(of_shard).sum();
        // The last chunk of the study may be shorter.
        let short = match all > 0
            && self
                .shards
                .binary_search(&((all - 1) % self.of + 1))
                .is_ok()
        {
            true => all.checked_mul(chunk)? - runs,
            false => 0,
        };
        Some(chunks.checked_mul(chunk)? - short)
    }

    /// Place of a chunk of the study among the chunks of a result that holds this, both from
    /// zero; `None` if another result holds it.
    #[must_use]
    pub fn place(&self, chunk: usize) -> Option<usize> {
        let before = self.shards.binary_search(&(chunk % self.of + 1)).ok()?;
        Some(chunk / self.of * self.shards.len() + before)
    }
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.shards[..] {
            _ if self.is_whole() => write!(f, "the whole study"),
            [shard] => write!(f, "shard {shard}/{}", self.of),
            shards => write!(f, "shards {} of {}", ranges(shards), self.of),
        }
    }
}

/// Ascending numbers as people write them, such as `1-3,7`.
#[must_use]
pub fn ranges(numbers: &[usize]) -> String {
    let joined = |run: &[usize]| match run {
        [] => String::new(),
        [one] => one.to_string(),
        [first, .., last] => format!("{first}-{last}"),
    };
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(joined);
    runs.collect::<Vec<_>>().join(",")
}

/// Reads what [`ranges`] writes; `None` if it is no such list, or has a number beyond `most` or more
/// than so many.
#[must_use]
pub fn numbers(text: &str, most: usize) -> Option<Vec<usize>> {
    let mut numbers = Vec::new();
    for part in text.split(',') {
        let (first, last) = part.split_once('-').unwrap_or((part, part));
        let (first, last): (usize, usize) = (first.trim().parse().ok()?, last.trim().parse().ok()?);
        if first > last || last > most || numbers.len() + (last - first) >= most {
            return None;
        }
        numbers.extend(first..=last);
    }
    Some(numbers)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Against dealing the runs out one by one.
    #[test]
    fn rows_and_places_are_those_of_chunks_dealt_in_turn() {
        for (runs, chunk, of) in [(60, 4, 7), (61, 4, 7), (1, 4, 3), (10, 1, 4), (100, 256, 2)] {
            let all: Vec<usize> = (0..runs).step_by(chunk).collect();
            for set in 1_u32..1 << of {
                let shards: Vec<usize> = (1..=of).filter(|s| set >> (s - 1) & 1 == 1).collect();
                let part = Part::of(shards.clone(), of).unwrap();
                let mut rows = 0;
                let mut place = 0;
                for (number, start) in all.iter().enumerate() {
                    let mine = shards.contains(&(number % of + 1));
                    assert_eq!(part.place(number), mine.then_some(place));
                    place += usize::from(mine);
                    rows += if mine { chunk.min(runs - start) } else { 0 };
                }
                assert_eq!(part.rows(runs, chunk), Some(rows));
            }
        }
    }

    #[test]
    fn numbers_that_cannot_be_are_refused() {
        assert_eq!(Part::of(vec![2, 1, 3], 3), Some(Part::whole()));
        for shards in [vec![], vec![0], vec![4], vec![2, 2]] {
            assert_eq!(Part::of(shards, 3), None);
        }
        assert_eq!(Part::whole().rows(10, 0), None);
    }

    #[test]
    fn ranges_come_back() {
        let list = [1, 2, 3, 7, 9, 10];
        assert_eq!(ranges(&list), "1-3,7,9-10");
        assert_eq!(numbers("1-3,7,9-10", 10).unwrap(), list);
        for text in ["", "3-1", "1-11", "a", "1,,2", "-1"] {
            assert_eq!(numbers(text, 10), None, "{text}");
        }
    }
}
