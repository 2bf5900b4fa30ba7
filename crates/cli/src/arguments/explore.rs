//! Arguments of `pounding explore`.

use clap::Args;

use super::{InputPath, OutputPath};

/// The page that computes.
#[derive(Debug, Args)]
pub struct ExploreArguments {
    /// Case file (TOML)
    pub case: InputPath,
    /// Page; by default the name of the case with .html beside it
    #[arg(short, long, value_name = "PAGE.html")]
    pub output: Option<OutputPath>,
    /// Records, or folders of them, that the page has beside that of the case
    #[arg(long, num_args = 1.., value_name = "FILE")]
    pub records: Vec<InputPath>,
    /// Rules of your own for the gap, a file (TOML) of tables "rule", beside those of the case
    #[arg(long, value_name = "FILE")]
    pub rules: Option<InputPath>,
    /// Where the documentation is: the page links to ADDRESS/reference/... or, of a book, to an address such
    /// as "docs/{page}.html" [default: the page names its files]
    #[arg(long, value_name = "ADDRESS")]
    pub documentation: Option<String>,
}
