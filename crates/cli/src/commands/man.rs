//! `pounding man`: the manual pages of the program and of each of its commands.

use std::path::Path;

use clap::CommandFactory;
use clap_mangen::Man;

use crate::arguments::Arguments;
use crate::failure::Failure;
use crate::output::print;
use crate::plot;

/// Writes `pounding.1`, `pounding-run.1` and so on into a folder.
pub fn man(folder: &Path) -> Result<(), Failure> {
    let refused = |e: &std::io::Error| Failure::output(e, &folder.display().to_string());
    let mut command = Arguments::command();
    command.build();
    let mut pages = Vec::new();
    collect(&command, "pounding", &mut pages).map_err(|e| refused(&e))?;
    let named = pages.iter().map(|(name, text)| (name.as_str(), &**text));
    plot::write_all(folder, named)?;
    print(&format!("{} pages in {}", pages.len(), folder.display()))
}

/// The pages of a command and of those below it, except of what is hidden.
fn collect(
    command: &clap::Command,
    name: &str,
    pages: &mut Vec<(String, String)>,
) -> std::io::Result<()> {
    let mut bytes = Vec::new();
    Man::new(command.clone()).render(&mut bytes)?;
    let text = String::from_utf8_lossy(&bytes).into_owned();
    pages.push((format!("{name}.1"), text));
    for sub in command.get_subcommands() {
        if !sub.is_hide_set() && sub.get_name() != "help" {
            collect(sub, &format!("{name}-{}", sub.get_name()), pages)?;
        }
    }
    Ok(())
}
