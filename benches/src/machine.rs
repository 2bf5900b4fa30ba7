//! What was measured on.

use std::process::Command;

/// One sentence about processor, compilers and load.
pub(crate) fn sentence() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |key: &str| {
        let line = cpu.lines().find(|l| l.starts_with(key));
        line.and_then(|l| l.split_once(':')).map(|p| p.1.trim())
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let flags: Vec<&str> = field("flags").unwrap_or_default().split(' ').collect();
    let vectors: Vec<&str> = ["sse4_2", "avx", "avx2", "fma", "avx512f"]
        .into_iter()
        .filter(|f| flags.contains(f))
        .collect();
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    format!(
        "{}, {threads} processors ({}), load {} at the start; {}; {}. Ours is built by `cargo \
         --release` for {}{}, `peer.c` with `-O3 -march=native`.",
        field("model name").unwrap_or("unknown processor"),
        vectors.join(", "),
        load.split(' ').next().unwrap_or("?"),
        version("rustc"),
        version("gcc"),
        std::env::consts::ARCH,
        if cfg!(target_feature = "avx2") {
            " with AVX2"
        } else {
            ""
        },
    )
}

fn version(program: &str) -> String {
    let output = Command::new(program).arg("--version").output();
    let text = output.map(|o| String::from_utf8_lossy(&o.stdout).into_owned());
    match text.as_deref().map(|t| t.lines().next()) {
        Ok(Some(line)) => line.to_owned(),
        _ => format!("no {program}"),
    }
}
