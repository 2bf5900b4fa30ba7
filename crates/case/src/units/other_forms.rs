//! Units in forms that are not read, brought to that which is.

use super::{LARGEST_POWER, UNITS};

/// A unit with brackets, or with `-`, `.` or `*` between its factors, as it can be read: with blanks, powers and one `/`
/// for each divisor.
pub(super) fn without_brackets(unit: &str) -> Option<String> {
    let signs: Vec<char> = unit.chars().collect();
    let mut at = 0;
    let factors = factors(&signs, &mut at, 0)?;
    if at < signs.len() || factors.is_empty() {
        return None;
    }
    let shown = |symbol: &str, power: f64| match power {
        1.0 => symbol.to_owned(),
        power => format!("{symbol}^{power}"),
    };
    let above = factors.iter().filter(|(_, power)| *power > 0.0);
    let above: Vec<String> = above.map(|(symbol, power)| shown(symbol, *power)).collect();
    let mut plain = match above.is_empty() {
        true => "1".to_owned(),
        false => above.join(" "),
    };
    for (symbol, power) in factors.iter().filter(|(_, power)| *power < 0.0) {
        plain.push('/');
        plain.push_str(&shown(symbol, -power));
    }
    Some(plain)
}

/// Brackets in brackets up to which a unit is looked through.
const DEEPEST: usize = 8;

/// Symbols with their powers, up to the end or a bracket that closes; `None` where a product after `/` can be read in two
/// ways.
fn factors(signs: &[char], at: &mut usize, depth: usize) -> Option<Vec<(String, f64)>> {
    let mut found = Vec::new();
    let (mut divides, mut divided) = (false, false);
    while let Some(sign) = signs.get(*at).copied() {
        match sign {
            ')' | ']' | '}' if depth > 0 => break,
            '/' => {
                divides = true;
                *at += 1;
            }
            '*' | '.' | '-' => *at += 1,
            _ if sign.is_whitespace() => *at += 1,
            _ => {
                if divided && !divides {
                    return None;
                }
                let inner = match sign {
                    '(' | '[' | '{' if depth < DEEPEST => {
                        *at += 1;
                        let inner = factors(signs, at, depth + 1)?;
                        // The bracket that closes.
                        signs.get(*at)?;
                        *at += 1;
                        (!inner.is_empty()).then_some(inner)?
                    }
                    '1' if divides || found.is_empty() => {
                        *at += 1;
                        Vec::new()
                    }
                    _ => vec![(symbol(signs, at)?, 1.0)],
                };
                let power = power(signs, at)? * if divides { -1.0 } else { 1.0 };
                (divides, divided) = (false, divides);
                found.extend(inner.into_iter().map(|(symbol, p)| (symbol, p * power)));
            }
        }
    }
    Some(found)
}

/// A known symbol that begins here.
fn symbol(signs: &[char], at: &mut usize) -> Option<String> {
    let rest = &signs[*at..];
    let letters = rest.iter().take_while(|c| c.is_alphabetic() || **c == '%');
    let symbol: String = letters.collect();
    *at += symbol.chars().count();
    UNITS.iter().any(|u| u.symbol == symbol).then_some(symbol)
}

/// A power that stands here, 1 if none does; `None` for one that is none.
fn power(signs: &[char], at: &mut usize) -> Option<f64> {
    let is_raised = signs.get(*at) == Some(&'^');
    let begin = *at + usize::from(is_raised);
    let is_digit = |c: Option<&char>| c.is_some_and(char::is_ascii_digit);
    let in_brackets = is_raised && signs.get(begin) == Some(&'(');
    let begin = begin + usize::from(in_brackets);
    let sign = usize::from(matches!(signs.get(begin), Some('+' | '-')));
    if !is_digit(signs.get(begin + sign)) {
        return (!is_raised).then_some(1.0);
    }
    let mut end = begin + sign;
    while is_digit(signs.get(end)) || signs.get(end) == Some(&'.') && is_digit(signs.get(end + 1)) {
        end += 1;
    }
    let power: String = signs[begin..end].iter().collect();
    let power: f64 = power.parse().ok()?;
    if in_brackets && signs.get(end) != Some(&')') {
        return None;
    }
    *at = end + usize::from(in_brackets);
    (power.abs() <= LARGEST_POWER).then_some(power)
}
