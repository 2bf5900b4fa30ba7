//! Compiles `pounding-explorer` to the WebAssembly module that pages hold, and writes the
//! JavaScript that calls it, by the library of `wasm-bindgen`.
//!
//! A cargo of its own does it, with a profile of its own (`explorer` in the workspace's
//! `Cargo.toml`), whatever the outer build is for. Its target folder, `explorer-module` beside
//! those of profiles, is the same for builds, tests, clippy and documentation: the module is
//! compiled once, and again only where a source of it has changed.
//!
//! Where it cannot be compiled, as without the target `wasm32-unknown-unknown`, the build goes
//! on: the command that writes such pages says why it has none. `POUNDING_EXPLORER_MODULE=skip`
//! leaves it out; with a path in the place of `skip` that module is taken.

use std::env::{var, var_os, vars_os};
use std::error::Error;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use flate2::Compression;
use flate2::write::GzEncoder;
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";
/// Says where the module comes from.
const CHOICE: &str = "POUNDING_EXPLORER_MODULE";
/// What the JavaScript calls the module.
const GLOBAL: &str = "pounding";
/// What the linker is told: memory that a page may take (bytes), and of it the stack.
const LINKER: [&str; 2] = ["--max-memory=1073741824", "-zstack-size=4194304"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-env-changed={CHOICE}");
    let out = PathBuf::from(var("OUT_DIR")?);
    let module = match var_os(CHOICE) {
        Some(choice) if choice == "skip" => Err(format!(
            "the program was built with {CHOICE}=skip; build it without"
        )),
        Some(choice) if !choice.is_empty() => {
            let path = PathBuf::from(choice);
            println!("cargo::rerun-if-changed={}", path.display());
            Ok(path)
        }
        _ => compiled(&out),
    };
    let rust = match module.and_then(|path| bound(&path)) {
        Ok((script, module)) => {
            let (glue, packed) = (out.join("module.js"), out.join("module.wasm.gz"));
            fs::write(&glue, script)?;
            let mut encoder = GzEncoder::new(fs::File::create(&packed)?, Compression::best());
            encoder.write_all(&module)?;
            encoder.finish()?;
            format!(
                "Ok(Module {{ script: include_str!({glue:?}), packed: include_bytes!({packed:?}) }})"
            )
        }
        Err(reason) => {
            println!("cargo::warning=`pounding explore` will write no page: {reason}");
            format!("Err({reason:?})")
        }
    };
    fs::write(out.join("module.rs"), rust)?;
    Ok(())
}

/// The module, compiled from the workspace around this crate; or why there is none, and what to
/// do.
fn compiled(out: &Path) -> Result<PathBuf, String> {
    let own = PathBuf::from(var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let workspace = own.join("../..");
    let manifest = own.join("../explorer/Cargo.toml");
    if !manifest.is_file() {
        return Err("the program was built from a package, without the sources of the module beside it; build it from a clone".to_owned());
    }
    for file in ["Cargo.toml", "Cargo.lock"] {
        println!("cargo::rerun-if-changed={}", workspace.join(file).display());
    }
    println!("cargo::rerun-if-changed={}", own.join("build.rs").display());
    if !has_target() {
        return Err(format!(
            "the target {TARGET} was not installed when the program was built; `rustup target add {TARGET}`, and build again"
        ));
    }
    let folder = target_folder(out).join("explorer-module");
    let output = cargo(&manifest, &workspace, &folder).output();
    let output = output.map_err(|e| format!("no cargo could be started: {e}"))?;
    if !output.status.success() {
        watch_all(&workspace);
        let told = String::from_utf8_lossy(&output.stderr);
        return Err(format!(
            "the module could not be compiled: {}",
            told.trim().replace('\n', " | ")
        ));
    }
    let made = folder.join(TARGET).join("explorer");
    watch(&made.join("pounding_explorer.d"), &workspace);
    Ok(made.join("pounding_explorer.wasm"))
}

/// The JavaScript that calls a module, and the module as it wants it; or why there are none.
fn bound(path: &Path) -> Result<(String, Vec<u8>), String> {
    let mut bindgen = Bindgen::new();
    let made = bindgen
        .input_path(path)
        // A script of a page: it is given the module, and loads nothing.
        .no_modules(true)
        .and_then(|b| b.no_modules_global(GLOBAL))
        .map(|b| b.omit_default_module_path(true).typescript(false))
        .map(|b| b.remove_name_section(true).remove_producers_section(true))
        .and_then(Bindgen::generate_output);
    let mut made = made.map_err(|e| {
        let path = path.display();
        format!("the JavaScript of the module {path} could not be written: {e:#}")
    })?;
    Ok((made.js().to_owned(), made.wasm_mut().emit_wasm()))
}

/// Whether the compiler can compile for the target.
fn has_target() -> bool {
    let rustc = var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let asked = Command::new(rustc)
        .args(["--print", "target-libdir", "--target", TARGET])
        .output();
    asked.is_ok_and(|told| {
        let folder = String::from_utf8_lossy(&told.stdout);
        told.status.success() && Path::new(folder.trim()).is_dir()
    })
}

/// The folder of all builds of the outer cargo: above `OUT_DIR`, which lies in `build` of a profile,
/// beside or in the folder of a target. What cargo marks its folder with is not asked: a folder
/// that was there before cargo has no mark.
fn target_folder(out: &Path) -> PathBuf {
    let is_build = |folder: &&Path| folder.file_name().is_some_and(|name| name == "build");
    let build = out.ancestors().find(is_build);
    let Some(folder) = build.and_then(Path::parent).and_then(Path::parent) else {
        return out.to_owned();
    };
    let of_target = folder.file_name() == var_os("TARGET").as_deref();
    let above = folder.parent().filter(|_| of_target);
    above.unwrap_or(folder).to_owned()
}

/// A cargo that compiles the module as if nobody had called it.
fn cargo(manifest: &Path, workspace: &Path, folder: &Path) -> Command {
    let mut cargo = Command::new(var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // What the outer cargo, clippy or the user say of another target is not meant for this one.
    const FOREIGN: [&str; 6] = [
        "RUSTFLAGS",
        "RUSTDOCFLAGS",
        "RUSTC_WRAPPER",
        "RUSTC_WORKSPACE_WRAPPER",
        "CLIPPY_ARGS",
        "CLIPPY_CONF_DIR",
    ];
    const FOREIGN_STARTS: [&str; 6] = [
        "CARGO_BUILD_",
        "CARGO_CFG_",
        "CARGO_FEATURE_",
        "CARGO_PROFILE_",
        "CARGO_TARGET_",
        "CARGO_PKG_",
    ];
    for (name, _) in vars_os() {
        let text = name.to_string_lossy();
        if FOREIGN.contains(&text.as_ref()) || FOREIGN_STARTS.iter().any(|s| text.starts_with(s)) {
            cargo.env_remove(&name);
        }
    }
    let mut flags: Vec<String> = LINKER.map(|word| format!("-Clink-arg={word}")).to_vec();
    // No page holds the names of folders of the machine that built it.
    let home = var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(PathBuf::from(var_os("HOME")?).join(".cargo")));
    let workspace = workspace.canonicalize();
    for (folder, name) in [(home, "registry"), (workspace.ok(), "pounding")] {
        let folder = folder.map(|folder| folder.display().to_string());
        flags.extend(folder.map(|folder| format!("--remap-path-prefix={folder}={name}")));
    }
    cargo
        .args(["rustc", "--quiet", "--locked", "--lib"])
        .args(["--crate-type", "cdylib", "--profile", "explorer"])
        .args(["--target", TARGET, "--manifest-path"])
        .arg(manifest)
        .arg("--target-dir")
        .arg(folder)
        .env("CARGO_INCREMENTAL", "0")
        .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
    cargo
}

/// Has this script run again where a source of the module changes: those that cargo names beside
/// it, and what says how crates are compiled.
fn watch(named: &Path, workspace: &Path) {
    let Ok(text) = fs::read_to_string(named) else {
        return watch_all(workspace);
    };
    let files = text.split_once(": ").map_or("", |(_, files)| files);
    // Spaces in names are escaped.
    let files = files.trim().replace("\\ ", "\u{1f}");
    let mut manifests = Vec::new();
    for file in files.split_whitespace() {
        let file = PathBuf::from(file.replace('\u{1f}', " "));
        let crate_of = file.ancestors().map(|a| a.join("Cargo.toml"));
        manifests.extend(crate_of.into_iter().find(|m| m.is_file()));
        // Folders of crates that are not compiled here stand for their build scripts.
        if file.is_file() {
            println!("cargo::rerun-if-changed={}", file.display());
        }
    }
    manifests.sort();
    manifests.dedup();
    for manifest in manifests {
        println!("cargo::rerun-if-changed={}", manifest.display());
    }
}

/// The same for whatever may be a source.
fn watch_all(workspace: &Path) {
    println!(
        "cargo::rerun-if-changed={}",
        workspace.join("crates").display()
    );
}
