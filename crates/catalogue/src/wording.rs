//! Numbers of things in sentences.

use std::fmt::Display;

/// A number with the noun that it counts: `1 gap`, `2 gaps`, `0 gaps`. Nouns whose plural takes
/// an `s`.
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, noun: &str) -> String {
    let end = agreeing(&count, "", "s");
    format!("{count} {noun}{end}")
}

/// The word that agrees with a number: the first with one, else the second.
pub fn agreeing<'w, N: PartialEq + From<u8>>(count: &N, one: &'w str, others: &'w str) -> &'w str {
    if *count == N::from(1) { one } else { others }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular() {
        assert_eq!(counted(0_usize, "gap"), "0 gaps");
        assert_eq!(counted(1_usize, "gap"), "1 gap");
        assert_eq!(counted(2_u64, "storey"), "2 storeys");
        assert_eq!(agreeing(&1_usize, "closes", "close"), "closes");
        assert_eq!(agreeing(&3_usize, "closes", "close"), "close");
    }
}
