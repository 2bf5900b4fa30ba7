//! Random numbers of studies: their samples, and what is refused.

use std::fmt::Write as _;

use pounding_study::{Study, StudyError, Value, case_of_run};

/// The study of a pair with these variables and this design.
fn parsed(folder: &std::path::Path, variables: &[&str], design: &str) -> Result<Study, StudyError> {
    let mut text = "case = \"case.toml\"\n".to_owned();
    for variable in variables {
        writeln!(text, "[[variable]]\n{variable}").unwrap();
    }
    let example = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/sweep_three_storey_pair/case.toml");
    let motions = example.parent().unwrap().join("../../ground_motions");
    let case = std::fs::read_to_string(&example).unwrap();
    let case = case.replace("../../ground_motions", &motions.display().to_string());
    std::fs::write(folder.join("case.toml"), case).unwrap();
    Study::parse(
        &format!("{text}\n[design]\n{design}\n"),
        &folder.join("study.toml"),
    )
}

fn numbers(study: &Study, variable: usize) -> Vec<f64> {
    let number = |run| match study.point(run)[variable] {
        Value::Number(x) => x,
        Value::Choice(_) => panic!("a distribution has numbers"),
    };
    (0..study.runs()).map(number).collect()
}

fn moments(numbers: &[f64]) -> [f64; 2] {
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let squares = numbers.iter().map(|x| (x - mean) * (x - mean));
    [mean, (squares.sum::<f64>() / numbers.len() as f64).sqrt()]
}

const GAP: &str = "path = \"gap.0.width\"\ndistribution = { kind = \"normal\", mean = \"30 mm\", standard_deviation = 0.004 }";
const FACTOR: &str = "path = \"building.light.stiffness\"\nrelative = true\ndistribution = { kind = \"lognormal\", mean = 1.1, coefficient_of_variation = \"25 %\" }";
const MEDIAN: &str = "path = \"building.heavy.mass\"\ndistribution = { kind = \"lognormal\", median = \"900 t\", dispersion = 0.1 }";

/// Mean and standard deviation of samples are those that the study states, of every design that samples: of a Latin
/// hypercube and a Sobol sequence closer than those of independent numbers, whose error is one over the root of the
/// runs.
#[test]
fn samples_have_the_moments_that_are_stated() {
    let place = tempfile::tempdir().unwrap();
    for (design, tolerance) in [
        ("kind = \"latin_hypercube\"\nruns = 4000", 0.01),
        ("kind = \"sobol\"\nruns = 4096\nseed = 3", 0.01),
        ("kind = \"monte_carlo\"\nruns = 4000", 0.05),
    ] {
        let study = parsed(place.path(), &[GAP, FACTOR, MEDIAN], design).unwrap();
        let near = |found: f64, stated: f64, scale: f64| {
            assert!(
                (found - stated).abs() < tolerance * scale,
                "{design}: {found} for {stated}"
            );
        };
        let [mean, deviation] = moments(&numbers(&study, 0));
        near(mean, 0.03, 0.004);
        near(deviation, 0.004, 0.004);
        let [mean, deviation] = moments(&numbers(&study, 1));
        near(mean, 1.1, 0.275);
        near(deviation, 0.275, 2.0 * 0.275);
        let logarithms: Vec<f64> = numbers(&study, 2).iter().map(|x| libm::log(*x)).collect();
        let [mean, deviation] = moments(&logarithms);
        near(mean, libm::log(9.0e5), 0.1);
        near(deviation, 0.1, 0.1);
    }
}

/// Other runs are other numbers, other seeds too; more runs of a Monte Carlo simulation begin with the same.
#[test]
fn seeds_and_runs_give_numbers_of_their_own() {
    let place = tempfile::tempdir().unwrap();
    let of = |runs: usize, seed: usize| {
        let design = format!("kind = \"monte_carlo\"\nruns = {runs}\nseed = {seed}");
        parsed(place.path(), &[GAP, MEDIAN], &design).unwrap()
    };
    let (few, many, other) = (of(300, 1), of(500, 1), of(300, 2));
    assert_eq!(numbers(&few, 0), numbers(&many, 0)[..300]);
    let mut all = [numbers(&few, 0), numbers(&other, 0)].concat();
    all.sort_by(f64::total_cmp);
    all.dedup();
    assert_eq!(all.len(), 600);
    let standardised = |study: &Study, variable| -> Vec<f64> {
        let numbers = numbers(study, variable);
        let [mean, deviation] = moments(&numbers);
        numbers.iter().map(|x| (x - mean) / deviation).collect()
    };
    let [a, b] = [0, 1].map(|variable| standardised(&many, variable));
    let product: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
    // Five standard deviations of the correlation of independent numbers.
    assert!((product / 500.0).abs() < 5.0 / 500.0_f64.sqrt());
}

const RECORDS: &str = "name = \"record\"\nrecords = [\"a.csv\", { name = \"b\", file = \"a.csv\" }, { name = \"c\", file = \"a.csv\" }]";

/// A record of twenty values.
fn record(folder: &std::path::Path) {
    let rows: Vec<String> = (0..20)
        .map(|i| format!("{},{}", 0.01 * f64::from(i), i % 3 - 1))
        .collect();
    let record = "t (s),a (m/s2)\n".to_owned() + &rows.join("\n") + "\n";
    std::fs::write(folder.join("a.csv"), record).unwrap();
}

/// A grid with samples is a grid of its variables with values; in each of its points random variables have the same
/// sets, a Latin hypercube for each record, which are one together.
#[test]
fn grids_have_the_same_random_sets_at_every_point() {
    let place = tempfile::tempdir().unwrap();
    record(place.path());
    let width = "path = \"gap.0.width\"\nvalues = [\"10 mm\", \"20 mm\"]";
    let even = "name = \"damping\"\npath = \"building.light.damping.stiffness_proportional\"\nfrom = 0.02\nto = 0.06";
    let variables = [RECORDS, FACTOR, width, even];
    let study = parsed(place.path(), &variables, "samples = 50\nseed = 4").unwrap();
    assert_eq!(study.runs(), 3 * 50 * 2);
    let number = |run: usize, variable: usize| match study.point(run)[variable] {
        Value::Number(x) => x,
        Value::Choice(i) => i as f64,
    };
    let mut sets = Vec::new();
    for record in 0..3 {
        for set in 0..50 {
            // The last variable with values runs fastest, and the sets stand where the first random variable does.
            let run = (record * 50 + set) * 2;
            assert_eq!([number(run, 0), number(run, 2)], [record as f64, 0.01]);
            assert_eq!(
                [number(run + 1, 0), number(run + 1, 2)],
                [record as f64, 0.02]
            );
            let of = |run| [number(run, 1), number(run, 3)];
            assert_eq!(of(run), of(run + 1));
            sets.push(of(run));
        }
    }
    // One in every equal share of the range, over the sets of all records.
    let mut shares: Vec<usize> = sets
        .iter()
        .map(|[_, damping]| ((damping - 0.02) / 0.04 * 150.0) as usize)
        .collect();
    shares.sort_unstable();
    assert_eq!(shares, (0..150).collect::<Vec<_>>());
    for of_record in sets.chunks(50) {
        let mut shares: Vec<usize> = of_record
            .iter()
            .map(|[_, damping]| ((damping - 0.02) / 0.04 * 50.0) as usize)
            .collect();
        shares.sort_unstable();
        assert_eq!(shares, (0..50).collect::<Vec<_>>());
    }
    let factors: Vec<f64> = sets.iter().map(|[factor, _]| *factor).collect();
    let [mean, deviation] = moments(&factors);
    assert!((mean - 1.1).abs() < 0.01 && (deviation - 0.275).abs() < 0.02);
    // Without records the sets are those of all points; and the order of variables is that of runs.
    let study = parsed(
        place.path(),
        &[width, FACTOR],
        "kind = \"grid\"\nsamples = 7",
    )
    .unwrap();
    let all = numbers(&study, 1);
    assert_eq!(all.len(), 14);
    assert_eq!(all[..7], all[7..]);
    // A single random variable is a grid of its samples.
    let study = parsed(place.path(), &[GAP], "samples = 400").unwrap();
    let [mean, deviation] = moments(&numbers(&study, 0));
    assert!(
        (mean - 0.03).abs() < 4e-5 && (deviation - 0.004).abs() < 1e-4,
        "{mean} {deviation}"
    );
}

/// `samples` without a random variable, and in designs that sample all variables; an incremental dynamic analysis with a
/// third variable that has values.
#[test]
fn samples_that_mean_nothing_are_refused() {
    let place = tempfile::tempdir().unwrap();
    record(place.path());
    let width = "path = \"gap.0.width\"\nvalues = [\"10 mm\", \"20 mm\"]";
    let intensity = "intensity = \"peak_ground_acceleration\"\nvalues = [1, 2]";
    let ida = "samples = 2\n[ida]";
    for (variables, design, message, help) in [
        (
            vec![width],
            "samples = 3",
            "no variable has a `distribution`",
            "remove `samples`",
        ),
        (
            vec![width],
            "seed = 3",
            "`seed` has no meaning for a grid without `samples`",
            "remove",
        ),
        (
            vec![width],
            "kind = \"list\"\nsamples = 3",
            "`samples` has no meaning for list",
            "remove",
        ),
        (
            vec![GAP],
            "kind = \"latin_hypercube\"\nruns = 3\nsamples = 3",
            "`samples` has no meaning for latin_hypercube",
            "remove",
        ),
        (
            vec![GAP],
            "samples = 3\nruns = 3",
            "`runs` has no meaning for grid",
            "remove",
        ),
        (
            vec![GAP],
            "seed = 3",
            "a grid without `samples`",
            "samples = ...",
        ),
        (vec![GAP], "samples = 0", "", ""),
        (
            vec![RECORDS, width, intensity, FACTOR],
            ida,
            "a fragility of its own",
            "make a study of each value",
        ),
        (
            vec![RECORDS, FACTOR],
            ida,
            "two variables: `records` and `intensity`",
            "give both",
        ),
        (
            vec![RECORDS, intensity, FACTOR],
            "kind = \"latin_hypercube\"\nruns = 5\n[ida]",
            "every record at every intensity",
            "which with `samples` has random numbers",
        ),
    ] {
        let error = parsed(place.path(), &variables, design).unwrap_err();
        let StudyError::Text { error, .. } = error else {
            panic!("{error}");
        };
        let (said, remedy) = (error.message, error.help.unwrap_or_default());
        assert!(
            said.contains(message) && remedy.contains(help),
            "{variables:?} {design}: {said}: {remedy}"
        );
    }
    let study = parsed(place.path(), &[RECORDS, intensity, FACTOR], ida).unwrap();
    assert_eq!(study.runs(), 3 * 2 * 2);
}

/// The bounds of a distribution hold in every run, and a run that is shown has the numbers of the study to the last
/// bit.
#[test]
fn bounds_hold_and_runs_are_shown_as_they_are() {
    let place = tempfile::tempdir().unwrap();
    let bounded = "name = \"gap\"\npath = \"gap.0.width\"\ndistribution = { kind = \"normal\", mean = \"30 mm\", coefficient_of_variation = 0.5, lower = \"25 mm\", upper = \"31 mm\" }";
    let study = parsed(
        place.path(),
        &[bounded],
        "kind = \"monte_carlo\"\nruns = 2000",
    )
    .unwrap();
    // The first point of the sequence is the least number.
    let sobol = parsed(place.path(), &[bounded], "kind = \"sobol\"\nruns = 8").unwrap();
    assert_eq!(numbers(&sobol, 0)[0], 0.025);
    let all = numbers(&study, 0);
    assert!(all.iter().all(|x| (0.025..=0.031).contains(x)));
    assert!(all.iter().any(|x| *x < 0.0255) && all.iter().any(|x| *x > 0.0309));
    assert_eq!(
        study.variables[0].long_name,
        "gap.0.width, normal, mean 0.03, standard deviation 0.015, from 0.025, to 0.031"
    );
    for run in [0, 7, 1999] {
        let shown = case_of_run(&study, run).unwrap();
        let line = shown.lines().find(|l| l.starts_with("width = ")).unwrap();
        let width = line.trim_start_matches("width = ");
        assert_eq!(width.parse::<f64>().unwrap().to_bits(), all[run].to_bits());
    }
}

/// A random intensity scales the record to each of its numbers: the peak of El Centro is 0.31882 g.
#[test]
fn intensities_may_be_random() {
    let place = tempfile::tempdir().unwrap();
    let random = "intensity = \"peak_ground_acceleration\"\ndistribution = { kind = \"lognormal\", median = \"0.3 g\", dispersion = 0.4 }";
    let design = "kind = \"latin_hypercube\"\nruns = 12";
    let study = parsed(place.path(), &[random], design).unwrap();
    let intensities = numbers(&study, 0);
    let scale = |run| -> f64 {
        let shown = case_of_run(&study, run).unwrap();
        let line = shown.lines().find(|l| l.starts_with("scale = ")).unwrap();
        line.trim_start_matches("scale = ").parse().unwrap()
    };
    for (run, intensity) in intensities.iter().enumerate() {
        assert!((scale(run) * 0.31882 * 9.80665 / intensity - 1.0).abs() < 1e-3);
    }
    // A Latin hypercube has half of its runs below the median.
    let below = intensities.iter().filter(|x| **x < 0.3 * 9.80665).count();
    assert_eq!(below, 6);
}

/// What is wrong is said at its place, with what to write.
#[test]
fn wrong_distributions_are_refused() {
    let place = tempfile::tempdir().unwrap();
    record(place.path());
    let sampled = "kind = \"latin_hypercube\"\nruns = 50";
    let random = |of: &str| format!("path = \"gap.0.width\"\ndistribution = {{ {of} }}");
    let refused = |variable: &str, design: &str| {
        let error = parsed(place.path(), &[variable], design).unwrap_err();
        let StudyError::Text { error, source_text } = error else {
            panic!("{error}");
        };
        let at = source_text[error.span.clone()].to_owned();
        (at, error.message, error.help.unwrap_or_default())
    };
    for (of, at, message, help) in [
        (
            "kind = \"uniform\", lower = 0, upper = 1",
            "\"uniform\"",
            "a range of the variable itself",
            "`from = ...`",
        ),
        (
            "kind = \"gumbel\", mean = 1",
            "\"gumbel\"",
            "unknown",
            "normal, lognormal",
        ),
        (
            "kind = \"normal\", mean = 0.03",
            "{",
            "no `standard_deviation`",
            "add",
        ),
        (
            "kind = \"normal\", standard_deviation = 0.03",
            "{",
            "no `mean`",
            "add",
        ),
        (
            "kind = \"lognormal\", median = 0.03",
            "{",
            "no `dispersion`",
            "add",
        ),
        (
            "kind = \"normal\", median = 0.03, standard_deviation = 0.01",
            "0.03",
            "`mean`",
            "mean",
        ),
        (
            "kind = \"normal\", mean = 0.03, dispersion = 0.1",
            "0.1",
            "no `dispersion`",
            "coefficient_of_variation",
        ),
        (
            "kind = \"normal\", mean = 0, coefficient_of_variation = 0.1",
            "0.1",
            "mean of zero",
            "standard_deviation",
        ),
        (
            "kind = \"normal\", mean = 0.03, standard_deviation = 0",
            "0",
            "greater than zero",
            "above zero",
        ),
        (
            "kind = \"normal\", mean = 0.03, standard_deviation = -0.01",
            "-0.01",
            "greater than zero",
            "above zero",
        ),
        (
            "kind = \"normal\", mean = \"30 mm\", standard_deviation = \"2 kg\"",
            "\"2 kg\"",
            "a length (m), and its `standard_deviation` a mass",
            "same unit",
        ),
        (
            "kind = \"normal\", mean = 0.03, standard_deviation = \"2 mm\"",
            "\"2 mm\"",
            "has none",
            "same unit",
        ),
        (
            "kind = \"normal\", mean = \"30 kg\", standard_deviation = \"2 kg\"",
            "\"30 kg\"",
            "must be a length",
            "",
        ),
        (
            "kind = \"lognormal\", mean = -0.03, dispersion = 0.1",
            "-0.03",
            "above zero",
            "normal",
        ),
        (
            "kind = \"lognormal\", median = 0.03, standard_deviation = 0.1",
            "0.1",
            "goes with the `mean`",
            "dispersion",
        ),
        (
            "kind = \"lognormal\", median = 0.03, mean = 0.04, dispersion = 0.1",
            "0.03",
            "exclude one another",
            "remove",
        ),
        (
            "kind = \"lognormal\", median = 0.03, dispersion = \"2 mm\"",
            "\"2 mm\"",
            "must be a pure number",
            "",
        ),
        (
            "kind = \"normal\", mean = 0.03, standard_deviation = 0.01, lower = 0.04",
            "0.04",
            "above the mean",
            "correct",
        ),
        (
            "kind = \"normal\", mean = 0.03, standard_deviation = 0.01, upper = 0.02",
            "0.02",
            "below the mean",
            "correct",
        ),
        (
            "kind = \"normal\", mean = 0.03, standard_deviation = 0.01, lower = 0.03, upper = 0.03",
            "0.03",
            "not above",
            "correct",
        ),
        (
            "kind = \"normal\", mean = 0.03, standard_deviation = 0.02",
            "[[variable]]",
            "about one of 50 runs has",
            "lower",
        ),
    ] {
        let (found, said, remedy) = refused(&random(of), sampled);
        assert!(
            found.starts_with(at) && said.contains(message) && remedy.contains(help),
            "{of}: at {found}: {said}: {remedy}"
        );
    }
    let normal = random("kind = \"normal\", mean = 0.03, standard_deviation = 0.002");
    for (variable, design, message, help) in [
        (normal.clone() + "\nvalues = [1]", sampled, "`values` and `distribution`", "remove"),
        (normal.clone() + "\nfrom = 1", sampled, "`from` and `distribution`", "remove"),
        (normal.clone(), "kind = \"grid\"", "a grid without `samples` takes no samples", "samples = ..."),
        (normal.clone(), "kind = \"list\"", "a list takes no samples", "latin_hypercube"),
        (normal.clone(), "kind = \"sobol\"\nruns = 8", "without `seed`", "seed = 1"),
        (
            "intensity = \"peak_ground_acceleration\"\ndistribution = { kind = \"normal\", mean = 1, standard_deviation = 0.5 }".to_owned(),
            sampled,
            "above zero",
            "lower",
        ),
        (
            "records = [\"a.csv\"]\ndistribution = { kind = \"normal\", mean = 1, standard_deviation = 0.1 }".to_owned(),
            sampled,
            "no meaning",
            "`path` or `intensity`",
        ),
    ] {
        let (_, said, remedy) = refused(&variable, design);
        assert!(
            said.contains(message) && remedy.contains(help),
            "{variable}: {said}: {remedy}"
        );
    }
}
