//! How far a command is, where there is no terminal.

use super::fixture::{Fixture, message};

/// A short command says nothing; with a short time between lines all that have progress
/// say how far they are.
#[test]
fn lines_of_progress_come_where_there_is_no_terminal() {
    let fixture = Fixture::new();
    for (words, line) in [
        ("run case.toml -o a.h5", " %, "),
        ("gap case.toml --points 400", " runs ("),
        ("compare case.toml", " runs ("),
        ("sweep study.toml -o b.h5 --threads 1", " runs ("),
        ("ida study.toml -o c.h5 --threads 1", " runs ("),
    ] {
        let words: Vec<&str> = words.split_whitespace().collect();
        let silent = fixture.run(&words);
        assert!(silent.stderr.is_empty(), "{words:?}: {}", message(&silent));
        let mut command = fixture.command(&words);
        let talking = command
            .env("POUNDING_PROGRESS_SECONDS", "1e-4")
            .output()
            .unwrap();
        let told = String::from_utf8(talking.stderr).unwrap();
        assert!(told.lines().count() > 0, "{words:?}");
        for one in told.lines() {
            assert!(one.contains(line) && one.contains(" s elapsed"), "{one}");
        }
        // The answer is the same.
        let lines = |bytes: &[u8]| String::from_utf8_lossy(bytes).lines().count();
        assert_eq!(lines(&silent.stdout), lines(&talking.stdout), "{words:?}");
    }
    let mut command = fixture.command(&["run", "case.toml", "-o", "a.h5"]);
    let refused = command
        .env("POUNDING_PROGRESS_SECONDS", "soon")
        .output()
        .unwrap();
    let told = message(&refused);
    assert_eq!(refused.status.code(), Some(2), "{told}");
    assert!(
        told.contains("POUNDING_PROGRESS_SECONDS=soon") && told.contains("300"),
        "{told}"
    );
}
