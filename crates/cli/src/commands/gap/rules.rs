//! Widths by codes and by combination rules, in a table.

use pounding_catalogue::numbers::rounded_up;
use pounding_catalogue::wording::{agreeing, counted};
use pounding_separation::EffectiveProperties;
use pounding_study::gap_check::{CodeGap, CombinationGap, GapCheck, GapReport, RecordDemand};

use crate::tables::new_table;

/// Stands in place of a judgement by a rule for elastic displacements where buildings
/// yield.
const ELASTIC_ONLY: &str = "not judged: elastic only";

/// Stands in place of a judgement by a rule on which texts differ.
const DISPUTED: &str = "not judged: disputed";

/// What a rule says of the provided widths.
#[derive(Clone, Copy, PartialEq)]
enum Judgement {
    /// Whether they reach it, if it says anything.
    Satisfied(Option<bool>),
    /// It holds for elastic displacements, and a building yields.
    ElasticOnly,
    /// Texts on it differ.
    Disputed,
    /// It is of the seat, not of the gap: whether there is one that reaches it.
    OfSeat(Option<bool>),
}

/// A rule with what it asks for.
struct Rule {
    name: String,
    kind: String,
    factor: Option<&'static str>,
    judgement: Judgement,
    status: &'static str,
    /// Least and greatest width over the records (m): at one level, or the maximum over the levels.
    widths: (f64, f64),
    /// The least over records and levels of the width to the demand (-).
    ratio: Option<f64>,
    /// Records that demand more at some level.
    beyond: usize,
}

impl Rule {
    fn of(
        gap: &GapReport,
        (name, kind): (String, String),
        (judgement, status): (Judgement, &'static str),
        factor: Option<&'static str>,
        level: Option<usize>,
        width: impl Fn(usize, usize) -> Option<f64> + Copy,
    ) -> Self {
        let shown = level.map_or(0..gap.levels.len(), |level| level..level + 1);
        let of_record = |r| shown.clone().filter_map(|l| width(r, l)).reduce(f64::max);
        let widths = (0..gap.demand.len()).filter_map(of_record);
        Self {
            name,
            kind,
            factor,
            judgement,
            status,
            widths: widths.fold((f64::INFINITY, 0.0_f64), |(l, h), w| (l.min(w), h.max(w))),
            ratio: gap.least_ratio(width),
            beyond: gap.records_beyond(width),
        }
    }

    fn combination(gap: &GapReport, c: &CombinationGap) -> Self {
        let level = Some(gap.reported_level(c));
        let width = |r: usize, l: usize| c.records.get(r)?.get(l).map(|l| l.width);
        let name = c.rule.title(c.effective.map(EffectiveProperties::name));
        let satisfied = Judgement::Satisfied(c.satisfied_by(&gap.levels));
        let names = (name, "combination".to_owned());
        let judged = (satisfied, c.status.name());
        Self::of(gap, names, judged, None, level, width)
    }

    /// A rule for each reading of a disputed provision, one for any other.
    fn provisions(gap: &GapReport, c: &CodeGap) -> Vec<Self> {
        let p = &c.provision;
        let kind = format!("{}, {}", p.place().name(), p.basis().name());
        let judgement = match c.caution() {
            Some(_) => Judgement::ElasticOnly,
            None if c.is_disputed() => Judgement::Disputed,
            None if c.is_of_seat() => Judgement::OfSeat(c.satisfied_by(&gap.levels, gap.seat)),
            None => Judgement::Satisfied(c.satisfied_by(&gap.levels, gap.seat)),
        };
        let judged = (judgement, p.status().name());
        let factor = p.elastic_displacement_factor();
        let readings = p.status().readings().iter().enumerate();
        let readings: Vec<Self> = readings
            .map(|(i, reading)| {
                // The rest of the text stands in the answer and in files.
                let text = reading.text.split(',').next().unwrap_or_default();
                let name = format!("{} ({text})", p.name());
                let names = (name, kind.clone());
                Self::of(gap, names, judged, factor, None, |r, l| {
                    c.width_by_reading(r, l, i)
                })
            })
            .collect();
        if !readings.is_empty() {
            return readings;
        }
        let names = (p.name().to_owned(), kind);
        let rule = Self::of(gap, names, judged, factor, None, |r, l| c.width_at(r, l));
        vec![rule]
    }

    /// Width over the records (mm).
    fn range(&self) -> String {
        let (low, high) = self.widths;
        let [low_shown, high_shown] = [low, high].map(|width| rounded_up(width * 1e3, 1));
        if high - low > 5.0e-5 {
            format!("{low_shown} to {high_shown}")
        } else {
            high_shown
        }
    }

    /// All that a row says but the names of the rule.
    fn cells(&self, records: usize) -> [String; 5] {
        let few = format!("{} of {records}", self.beyond);
        let ratio = self.ratio.map_or("-".to_owned(), |x| format!("{x:.3}"));
        let none = || "-".to_owned();
        let said = |satisfied: Option<bool>| match satisfied {
            Some(true) => "yes",
            Some(false) => "no",
            None => "-",
        };
        let (satisfied, ratio, few) = match self.judgement {
            Judgement::Satisfied(satisfied) => (said(satisfied), ratio, few),
            Judgement::OfSeat(satisfied) => (said(satisfied), none(), none()),
            Judgement::ElasticOnly => (ELASTIC_ONLY, none(), none()),
            Judgement::Disputed => (DISPUTED, none(), none()),
        };
        let satisfied = satisfied.to_owned();
        [self.range(), satisfied, ratio, few, self.status.to_owned()]
    }
}

/// All rules that give a width, the widest first.
fn rules(gap: &GapReport) -> Vec<Rule> {
    let spoken = gap.codes.iter().filter(|c| c.refusal().is_none());
    let provisions = spoken.flat_map(|c| Rule::provisions(gap, c));
    let combinations = gap.combinations.iter();
    let combinations = combinations.map(|c| Rule::combination(gap, c));
    let mut rules: Vec<Rule> = combinations.chain(provisions).collect();
    rules.sort_by(|a, b| b.widths.1.total_cmp(&a.widths.1));
    rules
}

/// The rule that asks for most, in a line.
pub fn widest(gap: &GapReport) -> String {
    let judged = |r: &Rule| matches!(r.judgement, Judgement::Satisfied(Some(_)));
    let rules = rules(gap);
    let Some(rule) = rules.iter().find(|r| judged(r)) else {
        return String::new();
    };
    let short = rules.iter().filter(|r| judged(r));
    let (reached, all) = short.fold((0, 0), |(reached, all), rule| {
        let yes = rule.judgement == Judgement::Satisfied(Some(true));
        (reached + usize::from(yes), all + 1)
    });
    format!(
        "  the provided width reaches {reached} of {}; the widest is {} mm by {} ({})\n",
        counted(all, "rule"),
        rule.range(),
        rule.name,
        rule.status
    )
}

/// How many rules give a width.
pub fn count(gap: &GapReport) -> usize {
    rules(gap).len()
}

/// Gaps by code and by combination rules: rules that ask for the same in a row, unless all are
/// asked for.
pub fn table(check: &GapCheck, gap: &GapReport, all: bool) -> String {
    let mut text = format!(
        "\nGap {}: widths by rule under {}, the widest first; boundary rules summed over both sides\n{}\n",
        gap.name,
        counted(check.records.len(), "record"),
        if all { listed(gap) } else { grouped(gap) },
    );
    text.push_str(
        "\"unverified\": the formula was not compared with any text of the code, \"seen in a secondary text\": not with the code itself; check it there before it enters a design report. docs/reference/provisions.md says what was seen.\n",
    );
    if gap
        .codes
        .iter()
        .any(|c| c.refusal().is_none() && c.is_disputed())
    {
        text.push_str(&format!(
            "\"{DISPUTED}\": texts on the rule differ; the width of each is shown, and none decides.\n"
        ));
    }
    text.push_str(&ground_added(check, gap));
    if gap.codes.iter().any(|c| c.caution().is_some()) {
        text.push_str(&elastic_only(check));
    }
    let refused: Vec<_> = gap.codes.iter().filter_map(CodeGap::refusal).collect();
    if all {
        for refusal in refused {
            text.push_str(&format!("  {refusal}\n"));
        }
        text.push_str(&taken_for_granted(gap));
    } else if !refused.is_empty() {
        text.push_str(&format!(
            "{} {}: --all says which, and lists each rule by itself\n",
            counted(refused.len(), "provision"),
            agreeing(
                &refused.len(),
                "lacks an input or does not apply",
                "lack an input or do not apply"
            )
        ));
    }
    text
}

/// Sentences on what rules take for granted, each with the rules that do.
fn taken_for_granted(gap: &GapReport) -> String {
    let mut sentences: Vec<(String, Vec<&str>)> = Vec::new();
    for c in gap.codes.iter().filter(|c| c.refusal().is_none()) {
        for (what, sentence) in c.provision.assumptions().list() {
            let sentence = format!("{what}: {sentence}");
            let name = c.provision.name();
            match sentences.iter_mut().find(|(known, _)| *known == sentence) {
                Some((_, names)) => names.push(name),
                None => sentences.push((sentence, vec![name])),
            }
        }
    }
    sentences.sort_by(|a, b| a.0.cmp(&b.0));
    let mut text = "What rules take for granted:\n".to_owned();
    for (sentence, names) in sentences {
        text.push_str(&format!("  {sentence}\n    {}\n", names.join(", ")));
    }
    text
}

const WIDTH: &str = "width (mm)";
const REACHED: &str = "provided reaches it";
const RATIO: &str = "minimum of width / demand";
const BEYOND: &str = "records that exceed it";

/// A row a rule.
fn listed(gap: &GapReport) -> String {
    let mut table = new_table([
        "rule",
        "kind",
        "elastic displacement times",
        WIDTH,
        REACHED,
        RATIO,
        BEYOND,
        "status",
    ]);
    for rule in rules(gap) {
        let factor = rule.factor.unwrap_or("-").to_owned();
        let mut row = vec![rule.name.clone(), rule.kind.clone(), factor];
        row.extend(rule.cells(gap.records()));
        table.add_row(row);
    }
    table.to_string()
}

/// A row for all rules that ask for the same.
fn grouped(gap: &GapReport) -> String {
    let mut table = new_table(["rule", WIDTH, REACHED, RATIO, BEYOND, "status"]);
    let mut rows: Vec<(Vec<String>, [String; 5])> = Vec::new();
    for rule in rules(gap) {
        let cells = rule.cells(gap.records());
        match rows.iter_mut().find(|(_, known)| *known == cells) {
            Some((names, _)) => names.push(rule.name),
            None => rows.push((vec![rule.name], cells)),
        }
    }
    for (names, cells) in rows {
        let name = match names.as_slice() {
            [first, rest @ ..] if rest.len() > 1 => {
                format!("{first} and {} more", rest.len())
            }
            names => names.join(", "),
        };
        let mut row = vec![name];
        row.extend(cells);
        table.add_row(row);
    }
    table.to_string()
}

/// What widths by rules hold beside the rule where the ground on both sides moves differently.
fn ground_added(check: &GapCheck, gap: &GapReport) -> String {
    let index = check.gaps.iter().position(|g| g.name == gap.name);
    let index = index.unwrap_or_default();
    let of = |record: &RecordDemand| {
        let levels = record.relative_ground_displacement[index].iter().flatten();
        let most = levels.copied().max_by(|a, b| a.value.total_cmp(&b.value))?;
        Some((record.name.clone(), most))
    };
    let peaks = check.records.iter().filter_map(of);
    let Some((record, most)) = peaks.max_by(|a, b| a.1.value.total_cmp(&b.1.value)) else {
        return String::new();
    };
    let uncorrelated = if gap.combinations.is_empty() {
        ""
    } else {
        "; double differences (DDC) suppose one motion under both buildings, and may be too small here"
    };
    format!(
        "The ground on both sides moves differently, by up to {:.2} mm ({record}, {:.3} s): under each record its maximum is added to the width of every rule and code, none of which has it{uncorrelated}. The demand contains it.\n",
        most.value * 1e3,
        most.time,
    )
}

/// Which buildings yield, and what that makes of rules for elastic displacements.
fn elastic_only(check: &GapCheck) -> String {
    let mut text = format!(
        "\"{ELASTIC_ONLY}\": the code multiplies the displacement of an elastic analysis, and buildings yield here without contact:\n"
    );
    let buildings = check.records.first().map_or(&[][..], |r| &r.isolated);
    for (index, building) in buildings.iter().enumerate() {
        let storeys = check.records.iter().flat_map(|record| {
            let storeys = record.isolated[index].inelastic_storeys();
            storeys
                .into_iter()
                .map(|(s, d)| (record.name.as_str(), s, d))
        });
        let most = |a: Option<f64>, b: Option<f64>| a.unwrap_or(0.0).total_cmp(&b.unwrap_or(0.0));
        let Some((record, storey, ductility)) = storeys.max_by(|a, b| most(a.2, b.2)) else {
            continue;
        };
        let yields = |r: &&RecordDemand| !r.isolated[index].inelastic_storeys().is_empty();
        let how_far = ductility.map_or("no elastic range".to_owned(), |d| {
            format!("maximum ductility {d:.2}")
        });
        text.push_str(&format!(
            "  {} under {} of {} ({how_far}, storey {} under {record})\n",
            building.name,
            check.records.iter().filter(yields).count(),
            counted(check.records.len(), "record"),
            storey + 1,
        ));
    }
    text.push_str(
        "  Their displacement is inelastic already, and a factor would count the ductility again: these widths decide nothing. Use a rule without such a factor, or a case with elastic storeys.\n",
    );
    text
}
