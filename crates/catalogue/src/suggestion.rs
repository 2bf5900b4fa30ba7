//! The known name that was probably meant.

/// The known name with the fewest letters to change; the first of equals.
pub fn nearest<T: AsRef<str>>(name: &str, known: impl IntoIterator<Item = T>) -> Option<T> {
    let distance = |known: &T| letters_to_change(name, known.as_ref());
    known.into_iter().min_by_key(distance)
}

/// The known name with the fewest letters to change, if they are no more than one and a third
/// of those of `name`.
pub fn misspelt<T: AsRef<str>>(name: &str, known: impl IntoIterator<Item = T>) -> Option<T> {
    let letters = name.chars().count();
    nearest(name, known).filter(|known| is_within(name, known.as_ref(), 1 + letters / 3))
}

/// Whether at most this many letters have to be changed.
#[must_use]
pub fn is_within(name: &str, known: &str, letters: usize) -> bool {
    letters_to_change(name, known) <= letters
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
    fn the_first_of_the_nearest_is_meant() {
        assert_eq!(nearest("ab", ["abc", "abd"]), Some("abc"));
        assert_eq!(nearest("ab", ["axyz", "abd"]), Some("abd"));
        assert_eq!(nearest("ab", Vec::<String>::new()), None);
        assert_eq!(
            misspelt("restitutoin", ["stiffness", "restitution"]),
            Some("restitution")
        );
        assert_eq!(misspelt("é", ["e"]), Some("e"));
        assert_eq!(misspelt("mass", ["stiffness"]), None);
        assert!(is_within("width", "widht", 2) && !is_within("width", "widht", 1));
    }
}
