//! Parameters of impact models and laws: the keys of a table that are its model's to judge.

use super::spread;
use crate::document::{Entry, FreeKeys, OneOrEach, Reader};
use crate::error::UnreadParameter;
use crate::located::Located;
use crate::types::Parameter;
use crate::units::Quantity;

/// One value for all places, or one for each.
pub(super) type Values = OneOrEach<Located<Quantity>, 0>;

/// The parameters of a model, and the keys of those that could not be read: one value for each of so
/// many places, which are called so, or for one where their number is not known.
pub(super) fn parameters(
    reader: &Reader<'_>,
    keys: FreeKeys<Values>,
    (count, place): (Option<usize>, &str),
) -> (Vec<Parameter>, Vec<Located<String>>) {
    let mut unread = Vec::new();
    let mut parameters = Vec::new();
    for (key, values) in keys.0 {
        let values = values.located().and_then(|values| match count {
            Some(count) => spread(reader, values, count, place),
            None => Some(values.value.into_list()),
        });
        let values: Option<Vec<_>> = values.filter(|values| !values.is_empty());
        match values {
            Some(values) => parameters.push(Parameter { key, values }),
            None => unread.push(key),
        }
    }
    (parameters, unread)
}

/// Says which parameters of a model, of a gap or not, could not be read.
pub(super) fn not_whole(
    reader: &Reader<'_>,
    (model, of_gap): (&Located<String>, bool),
    unread: Vec<Located<String>>,
) {
    for key in unread {
        reader.errors.unread(UnreadParameter {
            key,
            model: model.clone(),
            of_gap,
        });
    }
}

/// Puts values, which stand in the order in which levels are named, in the order of levels: the
/// places among the named ones.
pub(super) fn arrange(parameters: &mut [Parameter], order: &[usize]) {
    for parameter in parameters {
        if parameter.values.len() == order.len() {
            let values = &parameter.values;
            parameter.values = order.iter().map(|p| values[*p].clone()).collect();
        }
    }
}
