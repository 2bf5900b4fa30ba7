//! Records that are one motion under several names.

use pounding_catalogue::wording::counted;

use super::records::CaseUnderRecord;

/// Which records are copies of others, by their samples as they are used.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Repeated {
    /// Records with the same samples, by their numbers from zero: two or more together.
    pub groups: Vec<Vec<usize>>,
    /// Records without the copies.
    pub distinct: usize,
}

impl Repeated {
    /// Copies among the records of a case.
    pub(crate) fn among(records: &[CaseUnderRecord]) -> Self {
        let same = |a: usize, b: usize| {
            let [a, b] = [a, b].map(|r| &records[r].assembly.accelerogram);
            a.time_step() == b.time_step() && a.samples() == b.samples()
        };
        Self::by(records.len(), same)
    }

    /// Copies among so many records, of which two are one motion or not.
    pub(crate) fn by(count: usize, same: impl Fn(usize, usize) -> bool) -> Self {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for r in 0..count {
            match groups.iter_mut().find(|group| same(group[0], r)) {
                Some(group) => group.push(r),
                None => groups.push(vec![r]),
            }
        }
        let distinct = groups.len();
        groups.retain(|group| group.len() > 1);
        Self { groups, distinct }
    }

    /// What the user should know of records with these names.
    pub(crate) fn warnings(&self, names: &[&str]) -> Vec<String> {
        let warning = |group: &Vec<usize>| {
            let names: Vec<&str> = group.iter().map(|r| names[*r]).collect();
            let (last, others) = names.split_last().unwrap_or((&"", &[]));
            format!(
                "{} and {last} have the same samples: they are one record, of {} in all, and weigh in every statistic as several; name each record once",
                others.join(", "),
                counted(self.distinct, "record"),
            )
        };
        self.groups.iter().map(warning).collect()
    }
}
