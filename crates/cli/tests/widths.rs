//! What is printed for people is no wider than `COLUMNS` says, and says all the same.
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// Standard output of a command at the root of the repository.
fn printed(arguments: &str, columns: Option<usize>) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    command
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .env_remove("COLUMNS")
        .args(arguments.split_whitespace());
    if let Some(columns) = columns {
        command.env("COLUMNS", columns.to_string());
    }
    let output = command.output().unwrap();
    // A gap that is too small is an answer, too.
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

fn is_of_a_table(line: &str) -> bool {
    line.starts_with(['|', '+'])
}

/// Words outside the lines of tables, and how often each stands in them; times and other
/// results of the clock left out.
fn words(text: &str) -> Vec<&str> {
    let lines = text.lines().filter(|l| !is_of_a_table(l));
    let words = lines.flat_map(str::split_whitespace);
    words
        .filter(|w| !w.starts_with(|c: char| c.is_ascii_digit()))
        .collect()
}

/// Words within tables: every one that stands in a cell.
fn words_of_tables(text: &str) -> BTreeSet<&str> {
    // Not the rules between rows.
    let rows = |l: &&str| l.starts_with('|') && !l.starts_with("|-");
    let cells = text.lines().filter(rows).flat_map(|l| l.split('|'));
    cells.flat_map(str::split_whitespace).collect()
}

const COMMANDS: [&str; 12] = [
    "check examples/yielding_pair/case.toml",
    "run examples/yielding_pair/case.toml --no-output",
    "run examples/linked_pair/case.toml --no-output",
    "compare examples/gap_check/case.toml --models hertz_1882,jankowski_2005,linear_elastic",
    "gap examples/gap_check/case.toml --points 3 --all",
    "gap --list",
    "models",
    "models jankowski_2005",
    "hysteresis",
    "motion info ground_motions/el_centro_1940_ns.csv ground_motions/kobe_1995_jma_ns.csv",
    "motion spectrum ground_motions/el_centro_1940_ns.csv",
    "impact jankowski_2005 hertz_1882 --example",
];

#[test]
fn no_table_and_no_paragraph_is_wider_than_columns() {
    for arguments in COMMANDS {
        let free = printed(arguments, None);
        for columns in [60, 80, 100] {
            let text = printed(arguments, Some(columns));
            for line in text.lines() {
                let wide = line.chars().count();
                let one_word = line.split_whitespace().count() < 2;
                assert!(
                    wide <= columns || (one_word && !is_of_a_table(line)),
                    "{arguments} at {columns}, {wide}: {line}"
                );
            }
            assert_eq!(words(&text), words(&free), "{arguments} at {columns}");
            let (shown, all) = (words_of_tables(&text), words_of_tables(&free));
            // Words that long may be broken.
            let whole = |word: &&&str| word.chars().count() <= columns / 3;
            let lost: Vec<_> = all.difference(&shown).filter(whole).collect();
            assert!(lost.is_empty(), "{arguments} at {columns}: {lost:?}");
        }
        let text = printed(arguments, Some(2000));
        assert_eq!(words(&text), words(&free), "{arguments} at 2000");
    }
}

/// What programs read is not broken.
#[test]
fn text_for_programs_is_as_it_is() {
    for arguments in [
        "check examples/three_storey_pair/case.toml --json",
        "schema",
        "schema study",
        "schema hazard",
        "sweep examples/sweep_three_storey_pair/study.toml --show 1",
    ] {
        assert_eq!(printed(arguments, Some(60)), printed(arguments, None));
    }
}
