//! The words of this command and of others, as a shell takes them and a child is told by them.

use std::ffi::OsStr;

/// The hidden option that tells the child that it is one.
pub const OPTION_OF_CHILD: &str = "read-in-this-process";

/// A word that a shell takes as it is.
pub fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        return text.to_owned();
    }
    format!("'{}'", text.replace('\'', "'\\''"))
}

/// This command as it was given, with `--resume`.
pub fn this_command_resumed() -> String {
    shell_line(&resumed(this_command()))
}

/// The words of a command, with `--resume`.
pub fn resumed(mut words: Vec<String>) -> Vec<String> {
    let at = end_of_options(&words);
    if !words[..at].iter().any(|word| word == "--resume") {
        words.insert(at, "--resume".to_owned());
    }
    words
}

/// Where the words of a command take one more option: before `--`, behind which all are names.
pub fn end_of_options<W: AsRef<OsStr>>(words: &[W]) -> usize {
    let mut words = words.iter();
    let all = words.len();
    words.position(|word| word.as_ref() == "--").unwrap_or(all)
}

/// The words of this command.
pub fn this_command() -> Vec<String> {
    let words = std::env::args_os().filter(|word| !is_mark_of_child(word));
    words
        .map(|word| word.to_string_lossy().into_owned())
        .collect()
}

/// Words as a shell takes them.
pub fn shell_line<W: AsRef<str>>(words: &[W]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| quoted(word.as_ref())).collect();
    quoted.join(" ")
}

/// Whether this process reads for another one, which says what there is to say.
pub fn is_child() -> bool {
    std::env::args_os().any(|word| is_mark_of_child(&word))
}

/// Whether a word of a command tells a child that it is one: no part of what was asked for.
fn is_mark_of_child(word: &OsStr) -> bool {
    word.to_str()
        .is_some_and(|word| word.strip_prefix("--") == Some(OPTION_OF_CHILD))
}
