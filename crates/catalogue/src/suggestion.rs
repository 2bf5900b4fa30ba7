//! The known name that was probably meant.

/// The known name with the fewest letters to change, if they are no more than so many; the first
/// of equals.
pub fn nearest_within<T: AsRef<str>>(
    name: &str,
    known: impl IntoIterator<Item = T>,
    most: usize,
) -> Option<T> {
    let letters = |name: &str| name.chars().count();
    let of_name = letters(name);
    // So many are inserted or removed at least.
    let near = known
        .into_iter()
        .filter(|known| letters(known.as_ref()).abs_diff(of_name) <= most)
        .map(|known| (letters_to_change(name, known.as_ref()), known));
    near.filter(|(change, _)| *change <= most)
        .min_by_key(|(change, _)| *change)
        .map(|(_, known)| known)
}

/// The known name that `name` is in other case; else the one of which it is an abbreviation; else
/// the one with the fewest letters to change, if they are no more than one and a third of those of `name`, and any
/// letter stays, or to change in its first words, if they are no more than a fifth (`jankovski` of `jankowski_2005`).
pub fn misspelt<T: AsRef<str>>(name: &str, known: impl IntoIterator<Item = T>) -> Option<T> {
    let letters = name.chars().count();
    let change = |known: &T| {
        let known = known.as_ref();
        let is_same = known.to_lowercase() == name.to_lowercase();
        let in_first_words = letters_to_change(name, first_words(known, name.split('_').count()));
        let change = letters_to_change(name, known);
        let change = match in_first_words <= letters / 5 {
            true => change.min(in_first_words + 1),
            false => change,
        };
        let is_short = is_abbreviation(name, known);
        let is_like = change <= 1 + letters / 3 && change < letters.max(known.chars().count());
        (is_same || is_short || is_like).then_some((!is_same, !is_short, change))
    };
    let near = known
        .into_iter()
        .filter_map(|known| Some((change(&known)?, known)));
    near.min_by_key(|(change, _)| *change)
        .map(|(_, known)| known)
}

/// Letters below which a name abbreviates nothing: too many names begin with them.
const SHORTEST_ABBREVIATION: usize = 3;

/// Whether each word of a name, of three letters or more, begins one of the known name in
/// their order, as `mid_freq` does of `middle_frequency`.
fn is_abbreviation(name: &str, known: &str) -> bool {
    let (words, of) = (name.split('_'), known.split('_'));
    words.clone().count() <= of.clone().count()
        && words
            .zip(of)
            .all(|(word, of)| word.len() >= SHORTEST_ABBREVIATION && of.starts_with(word))
}

/// So many words of a name, or all.
fn first_words(name: &str, words: usize) -> &str {
    let mut ends = name.match_indices('_').map(|(end, _)| end);
    let end = words.checked_sub(1).and_then(|before| ends.nth(before));
    &name[..end.unwrap_or(name.len())]
}

/// How many letters have to be inserted, removed or replaced (Levenshtein's distance).
#[must_use]
pub fn letters_to_change(name: &str, known: &str) -> usize {
    strsim::levenshtein(name, known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_abbreviation_is_meant_before_a_slip() {
        let keys = ["middle_time", "middle_frequency", "magnitude", "factor"];
        for (name, meant) in [
            // Four letters from `middle_time`, five from `middle_frequency`.
            ("middle_freq", Some("middle_frequency")),
            ("mid_freq", Some("middle_frequency")),
            ("mag", Some("magnitude")),
            ("fact", Some("factor")),
            // Of two that begin so, the nearer.
            ("middle", Some("middle_time")),
            // One letter, which is a slip.
            ("middle_tme", Some("middle_time")),
            // Too short for one, and like none.
            ("fa", None),
            ("freq", None),
        ] {
            assert_eq!(misspelt(name, keys), meant, "{name}");
        }
        // Another letter alone says nothing, the same one in other case does.
        assert_eq!(misspelt("h", ["L", "H"]), Some("H"));
        assert_eq!(misspelt("x", ["L", "H"]), None);
        assert_eq!(misspelt("L", ["L1", "H1"]), Some("L1"));
        assert_eq!(misspelt("LEFT", ["lift", "left"]), Some("left"));
        assert_eq!(
            misspelt("rate", ["ratio", "rate_of_decay"]),
            Some("rate_of_decay")
        );
    }

    /// The first words of a name may have a slip, and the others be left away.
    #[test]
    fn a_slip_in_the_first_words_is_understood() {
        let models = [
            "anagnostopoulos_2004",
            "jankowski_2005",
            "ye_li_2009",
            "hertz_1882",
            "linear_elastic",
        ];
        for (name, meant) in [
            ("jankovski", Some("jankowski_2005")),
            ("anagnostopolous", Some("anagnostopoulos_2004")),
            ("ye_lu", Some("ye_li_2009")),
            ("nonlinear", None),
            ("hertz", Some("hertz_1882")),
            ("nothing", None),
        ] {
            assert_eq!(misspelt(name, models), meant, "{name}");
        }
    }

    #[test]
    fn the_first_of_the_nearest_is_meant() {
        assert_eq!(nearest_within("ab", ["abc", "abd"], 2), Some("abc"));
        assert_eq!(nearest_within("ab", ["axyz", "abd"], 3), Some("abd"));
        assert_eq!(nearest_within("ab", ["axy", "abd"], 1), Some("abd"));
        assert_eq!(nearest_within("ab", Vec::<String>::new(), 9), None);
        assert_eq!(
            misspelt("restitutoin", ["stiffness", "restitution"]),
            Some("restitution")
        );
        assert_eq!(misspelt("né", ["ne"]), Some("ne"));
        assert_eq!(misspelt("mass", ["stiffness"]), None);
        assert_eq!(nearest_within("width", ["widht"], 2), Some("widht"));
        assert_eq!(nearest_within("width", ["widht"], 1), None);
    }
}
