//! Tells the program from which commit and for which machine it is built.

use std::process::Command;

/// The answer of git in this folder, if there is git and a repository.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

fn main() {
    let target = std::env::var("TARGET").unwrap_or_else(|_| "unknown".to_owned());
    println!("cargo::rustc-env=POUNDING_TARGET={target}");
    println!("cargo::rerun-if-changed=build.rs");
    // What HDF5 that is linked in asks of Windows, and its bindings do not name; at the end of the
    // command, as linkers look only in what follows.
    let is = |key: &str, value: &str| std::env::var(key).is_ok_and(|v| v == value);
    if is("CARGO_CFG_TARGET_OS", "windows") && std::env::var_os("CARGO_FEATURE_STATIC").is_some() {
        let library = match is("CARGO_CFG_TARGET_ENV", "msvc") {
            true => "shlwapi.lib",
            false => "-lshlwapi",
        };
        println!("cargo::rustc-link-arg-bins={library}");
    }
    // The log of HEAD grows with every commit, checkout and reset.
    for file in ["HEAD", "logs/HEAD"] {
        if let Some(path) = git(&["rev-parse", "--git-path", file]) {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    // A source archive that lies in somebody else's repository is not a commit of ours.
    let ours = git(&["ls-files", "--error-unmatch", "build.rs"]).is_some();
    let Some(commit) = git(&["rev-parse", "HEAD"]).filter(|_| ours) else {
        return;
    };
    println!("cargo::rustc-env=POUNDING_COMMIT={commit}");
}
