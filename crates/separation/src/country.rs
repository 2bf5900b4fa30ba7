//! Names of countries: other ones of those that have codes here, and countries that share the code of others.

use pounding_catalogue::suggestion;

use crate::codes::CodeDescriptor;
use crate::error::SeparationError;

/// Other names of regions, in lower case.
const ALIASES: [(&[&str], &str); 6] = [
    (
        &["us", "u.s.", "usa", "u.s.a.", "united states of america"],
        "united states",
    ),
    (&["turkiye", "t\u{fc}rkiye"], "turkey"),
    (&["nz", "aotearoa"], "new zealand"),
    (&["south korea", "republic of korea"], "korea"),
    (
        &["ciudad de mexico", "ciudad de m\u{e9}xico", "cdmx"],
        "mexico city",
    ),
    (&["hellas"], "greece"),
];

/// Countries in which EN 1998-1 holds with a National Annex, in lower case.
const EN_1998: [&str; 32] = [
    "france",
    "germany",
    "spain",
    "portugal",
    "romania",
    "belgium",
    "netherlands",
    "austria",
    "slovenia",
    "croatia",
    "bulgaria",
    "cyprus",
    "slovakia",
    "czechia",
    "czech republic",
    "hungary",
    "poland",
    "ireland",
    "norway",
    "denmark",
    "finland",
    "sweden",
    "iceland",
    "estonia",
    "latvia",
    "lithuania",
    "luxembourg",
    "malta",
    "united kingdom",
    "uk",
    "great britain",
    "the netherlands",
];

/// The name of a country or city as it is compared.
pub(crate) fn plain(name: &str) -> String {
    name.trim().to_lowercase().replace(['_', '-'], " ")
}

/// The region that a name stands for, as it is compared.
pub(crate) fn region(name: &str) -> String {
    let name = plain(name);
    let alias = ALIASES
        .iter()
        .find(|(names, _)| names.contains(&name.as_str()));
    alias.map_or(name, |(_, region)| (*region).to_owned())
}

/// What can be said of a country without a code of its own, if it is more than a name like it.
pub(crate) fn hint(
    country: &str,
    known: &[&'static str],
    code_in: impl Fn(&str) -> Result<&'static CodeDescriptor, SeparationError>,
) -> Option<String> {
    if EN_1998.contains(&plain(country).as_str()) {
        return Some(format!(
            "EN 1998-1, which {country} applies with a National Annex, stands under \"Europe\"; what that annex says otherwise is yours to check"
        ));
    }
    let meant = suggestion::misspelt(country, known)?;
    let error = code_in(meant).err()?;
    let of_day = matches!(error, SeparationError::NotInForce { .. });
    let help = error.help().filter(|_| of_day)?;
    Some(format!("did you mean \"{meant}\"? But {error}; {help}"))
}
