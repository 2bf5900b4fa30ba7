//! The page that computes: a case with the files that it names, the solver as a WebAssembly
//! module, and the controls that move it, in one file that asks for nothing.
//!
//! The module is `pounding-explorer`, compiled by the build script of this crate; in the page two
//! workers have an instance of it each, one for the run that is looked at, the other for sweeps.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use pounding_report::DASHES;
use pounding_report::page::{COLLAPSE_AT_WIDTHS, Document, Script};
use serde_json::json;

/// The module, or why this program has none.
const MODULE: Result<Module, &str> = include!(concat!(env!("OUT_DIR"), "/module.rs"));
/// What is in the page beside its header.
const BODY: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// Of the workers, which know no page, behind the script of the module.
const WORKER: &str = concat!(include_str!("module.js"), include_str!("worker.js"));
/// Of the page, in the order in which one needs the other.
const SCRIPTS: &str = concat!(
    include_str!("page/elements.js"),
    include_str!("page/workers.js"),
    include_str!("page/state.js"),
    include_str!("page/controls.js"),
    include_str!("page/motion.js"),
    include_str!("page/results.js"),
    include_str!("page/sweep.js"),
    include_str!("page/files.js"),
    include_str!("page/page.js"),
);
/// Beside its scripts the page runs the module, and workers that are made from a text in it;
/// figures become pictures.
const MAY: &str = " &#39;wasm-unsafe-eval&#39;; worker-src blob:; img-src blob: data:";

/// The solver as a page holds it.
struct Module {
    /// The script that calls it, by `wasm-bindgen`.
    script: &'static str,
    /// The WebAssembly module, packed by gzip.
    packed: &'static [u8],
}

/// What a page is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs<'a> {
    /// Title of the case; may be empty.
    pub title: &'a str,
    /// Name of the case file.
    pub name: &'a str,
    /// Its text.
    pub case: &'a str,
    /// The files that it names, by the names that it gives them, and other records.
    pub files: &'a [(String, Vec<u8>)],
    /// A file of rules for the gap: its name and its text.
    pub rules: Option<(&'a str, &'a str)>,
    /// Where the pages of the documentation are: what their names follow, such as
    /// `https://example.org/docs/`.
    pub documentation: Option<&'a str>,
}

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExplorerPageError {
    /// The program has no module.
    #[error("this program holds no solver for pages: {reason}")]
    NoModule {
        /// Why, and what to do.
        reason: &'static str,
    },
    /// A file cannot be packed.
    #[error("a file of the case cannot be packed: {0}")]
    Packing(#[from] std::io::Error),
}

/// Whether this program has a solver for pages.
///
/// # Errors
/// [`ExplorerPageError::NoModule`]: why not, and what to do.
pub fn has_module() -> Result<(), ExplorerPageError> {
    module().map(|_| ())
}

fn module() -> Result<Module, ExplorerPageError> {
    MODULE.map_err(|reason| ExplorerPageError::NoModule { reason })
}

/// The page of a case, as one file of HTML.
///
/// # Errors
/// [`ExplorerPageError::NoModule`] in a program that was built without; a file that cannot be
/// packed.
pub fn page(inputs: &Inputs<'_>) -> Result<String, ExplorerPageError> {
    let Module {
        script,
        packed: module,
    } = module()?;
    let files = inputs.files.iter().map(|(name, bytes)| {
        let packed = STANDARD.encode(packed(bytes)?);
        Ok(json!({ "name": name, "data": packed }))
    });
    let files: Result<Vec<_>, ExplorerPageError> = files.collect();
    let data = json!({
        "module": STANDARD.encode(module),
        "worker": format!("{script}{WORKER}"),
        "version": env!("CARGO_PKG_VERSION"),
        "name": inputs.name,
        "case": inputs.case,
        "files": files?,
        "rules": inputs.rules.map(|(name, text)| json!({ "name": name, "text": text })),
        "documentation": inputs.documentation,
        "dashes": DASHES,
        "collapse": COLLAPSE_AT_WIDTHS,
    });
    let document = Document {
        title: match inputs.title {
            "" => inputs.name,
            title => title,
        },
        origin: &[
            inputs.name.to_owned(),
            format!("pounding {}", env!("CARGO_PKG_VERSION")),
            "computed in this page".to_owned(),
        ],
        body: BODY,
        script: Some(Script {
            source: format!("{}{SCRIPTS}", pounding_elevation::SCRIPT),
            data,
            may: MAY,
        }),
        style: STYLE,
    };
    Ok(document.html())
}

/// Bytes as a browser unpacks them.
fn packed(bytes: &[u8]) -> Result<Vec<u8>, std::io::Error> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}
