//! Descriptors by name.

use crate::descriptor::Descriptor;
use crate::error::DefinitionError;
use crate::suggestion;

/// Words of other programs and of the literature, and the name of what does what they say.
type Synonyms = &'static [(&'static [&'static str], &'static str)];

/// All descriptors of one kind, in the order in which users see them.
#[derive(Debug)]
pub struct Registry<D: 'static> {
    all: &'static [&'static D],
    synonyms: Synonyms,
}

impl<D: Descriptor> Registry<D> {
    /// A registry of these. Synonyms, which are words within a name, are suggested and never
    /// taken.
    #[must_use]
    pub const fn new(all: &'static [&'static D], synonyms: Synonyms) -> Self {
        Self { all, synonyms }
    }

    /// All descriptors.
    #[must_use]
    pub const fn all(&self) -> &'static [&'static D] {
        self.all
    }

    /// Names of all, without aliases.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<D> {
        self.all.iter().map(|d| d.name())
    }

    /// What has this name or alias.
    ///
    /// # Errors
    /// [`DefinitionError::UnknownName`] with the nearest known name.
    pub fn find(&self, name: &str) -> Result<&'static D, DefinitionError> {
        self.all
            .iter()
            .find(|d| names(**d).any(|known| known == name))
            .copied()
            .ok_or_else(|| DefinitionError::UnknownName {
                kind: D::KIND,
                name: name.to_owned(),
                nearest: self.nearest(name),
                known: self.names().collect(),
            })
    }

    /// The known name that is meant: one with the same letters and numbers, else one that but for a slip
    /// is so spelt, else one by a word that means it, else one that is nearly so spelt, else one of which
    /// this is a part, else one that is spelt somehow so. Empty if it is like none.
    #[must_use]
    pub fn nearest(&self, name: &str) -> &'static str {
        let known = || self.all.iter().flat_map(|d| names(*d));
        let within = |most| suggestion::nearest_within(name, known(), most);
        let nearly = 1 + name.chars().count() / 4;
        let by_part = || known().find(|k| !name.is_empty() && k.contains(name));
        known()
            .find(|known| has_parts_of(known, name))
            .or_else(|| within(nearly.min(SLIP)))
            .or_else(|| self.by_word(name))
            .or_else(|| within(nearly))
            .or_else(by_part)
            .or_else(|| suggestion::misspelt(name, known()))
            .unwrap_or_default()
    }

    /// What a known word within the name means.
    fn by_word(&self, name: &str) -> Option<&'static str> {
        let plain = name.to_lowercase().replace(['-', ' '], "_");
        let within = |word: &&str| format!("_{plain}_").contains(&format!("_{word}_"));
        let mut meanings = self.synonyms.iter();
        let (_, meant) = meanings.find(|(words, _)| words.iter().any(within))?;
        Some(meant)
    }
}

/// Letters to change that are a slip, and no other word.
const SLIP: usize = 2;

/// Whether a known name has the letters and numbers of this one, whatever separates them: `asce7-16` is `asce_7_2016`.
fn has_parts_of(known: &str, name: &str) -> bool {
    let letters = |name: &str| -> String {
        let letters = name.chars().filter(|c| c.is_alphabetic());
        letters.flat_map(char::to_lowercase).collect()
    };
    let (given, of_known) = (numbers(name), numbers(known));
    let is_same = |(given, known): (&&str, &&str)| {
        let is_year = given.len() == 2 && known.len() == 4;
        given == known || is_year && known.ends_with(*given)
    };
    letters(known) == letters(name)
        && !given.is_empty()
        && given.len() == of_known.len()
        && given.iter().zip(&of_known).all(is_same)
}

/// The numbers within a name.
fn numbers(name: &str) -> Vec<&str> {
    let numbers = name.split(|c: char| !c.is_ascii_digit());
    numbers.filter(|number| !number.is_empty()).collect()
}

fn names<D: Descriptor>(descriptor: &D) -> impl Iterator<Item = &'static str> + use<D> {
    let aliases = descriptor.aliases().iter().map(|a| a.name);
    std::iter::once(descriptor.name()).chain(aliases)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Alias, ParameterDescriptor, ParameterUnit, Parameters, non_negative, optional_positive,
    };

    struct Law(&'static str, &'static [Alias]);

    const PARAMETERS: &[ParameterDescriptor] = &[
        non_negative("friction", ParameterUnit::Newton, "Friction"),
        non_negative("ratio", ParameterUnit::One, "Ratio").default_to(0.5),
        optional_positive("length", ParameterUnit::Metre, "Length"),
    ];

    impl Descriptor for Law {
        const KIND: &'static str = "test law";
        const NOUN: &'static str = "law";
        fn name(&self) -> &'static str {
            self.0
        }
        fn aliases(&self) -> &'static [Alias] {
            self.1
        }
        fn parameters(&self) -> &'static [ParameterDescriptor] {
            PARAMETERS
        }
    }

    const COULOMB: &[Alias] = &[Alias {
        name: "coulomb",
        citation: "common",
    }];
    static ALL: Registry<Law> = Registry::new(
        &[
            &Law("coulomb_friction", COULOMB),
            &Law("linear_spring", &[]),
            &Law("cubic_spring", &[]),
        ],
        &[
            (&["elastic", "hooke"], "linear_spring"),
            (&["bent"], "cubic_spring"),
        ],
    );

    #[test]
    fn spelling_comes_before_words_and_words_before_parts() {
        for (name, nearest) in [
            ("coulom", "coulomb"),
            ("cubic_sprng", "cubic_spring"),
            ("Hooke-law", "linear_spring"),
            ("an elastic part", "linear_spring"),
            // A part of a word means nothing, and no name is spelt so.
            ("inelastic_part", ""),
            ("bic", "cubic_spring"),
            ("cub_spr", "cubic_spring"),
            ("cobic_sprngs", "cubic_spring"),
            // Five letters from the linear one, by a word the other.
            ("linear_bent_spring", "cubic_spring"),
            // Like none.
            ("peer_at2", ""),
        ] {
            let Err(DefinitionError::UnknownName { nearest: found, .. }) = ALL.find(name) else {
                panic!("{name} was found");
            };
            assert_eq!(found, nearest, "{name}");
        }
        let found = ALL.find("coulomb").map(Descriptor::name);
        assert_eq!(found, Ok("coulomb_friction"));
        let empty: Registry<Law> = Registry::new(&[], &[]);
        assert_eq!(empty.nearest("coulomb"), "");
        let help = |name| ALL.find(name).map_err(|e| e.help()).err();
        assert_eq!(help("coulom").as_deref(), Some("did you mean \"coulomb\"?"));
        let all = "known are coulomb_friction, linear_spring, cubic_spring";
        assert_eq!(help("peer_at2").as_deref(), Some(all));
        let names: Vec<_> = ALL.names().collect();
        assert_eq!(names, ["coulomb_friction", "linear_spring", "cubic_spring"]);
    }

    /// Whatever separates letters and numbers, which are nearer to each other than to those of another name.
    #[test]
    fn names_are_known_by_their_letters_and_numbers() {
        static CODES: Registry<Law> =
            Registry::new(&[&Law("code_41", &[]), &Law("code_7_2016", &[])], &[]);
        for (name, nearest) in [
            ("CODE7-16", "code_7_2016"),
            ("code 7 2016", "code_7_2016"),
            ("code41", "code_41"),
        ] {
            assert_eq!(CODES.nearest(name), nearest, "{name}");
        }
    }

    #[test]
    fn parameters_are_given_by_default_or_missing() {
        let law = ALL.all()[0];
        let given = Parameters::from_pairs(&[("friction", 2.0)]);
        assert_eq!(given.check(law), Ok(()));
        assert_eq!(given.get(law, "friction"), Ok(2.0));
        assert_eq!(given.get(law, "ratio"), Ok(0.5));
        assert_eq!(given.clone().with("ratio", 0.1).get(law, "ratio"), Ok(0.1));
        assert_eq!(given.given("ratio"), None);
        let refused =
            |parameters: Parameters| parameters.check(law).map_err(|e| (e.to_string(), e.help()));
        let because = |what: &str, help: &str| Err((what.to_owned(), help.to_owned()));
        assert_eq!(
            refused(Parameters::default()),
            because(
                "law coulomb_friction needs friction",
                "add friction to the law"
            )
        );
        assert_eq!(
            refused(given.clone().with("lenght", 1.0)),
            because(
                "law coulomb_friction has no parameter \"lenght\"",
                "did you mean \"length\"? its parameters are friction, ratio, length"
            )
        );
        assert_eq!(
            refused(given.clone().with("colour", 1.0)),
            because(
                "law coulomb_friction has no parameter \"colour\"",
                "its parameters are friction, ratio, length"
            )
        );
        for (value, shown) in [(0.0, "0"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
            assert_eq!(
                refused(given.clone().with("length", value)),
                because(
                    &format!("law coulomb_friction: length = {shown} is outside (0, inf)"),
                    "length: Length; check the unit"
                )
            );
        }
        assert_eq!(refused(given.with("friction", 0.0)), Ok(()));
    }
}
