//! What a command reads and what it will write, held against one another.

use std::path::{Path, PathBuf};

/// The files that a command reads, and those that it will write.
///
/// A command names all of them before it does any work, and [`check`](Self::check) refuses
/// an output that would take the place of an input or of another output: by whatever path,
/// through whatever link.
#[derive(Debug, Clone, Default)]
pub struct FileUse {
    read: Vec<Named>,
    written: Vec<Named>,
}

/// A path with what it is to the user.
#[derive(Debug, Clone)]
struct Named {
    /// The option that names it, or what it is: `--plot`, `record`.
    role: String,
    path: PathBuf,
    /// Whether it stands for everything in it.
    folder: bool,
}

/// An output that cannot be one.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FileUseError {
    /// It is a file that is read.
    #[error("{role} {output} would take the place of {input} ({input_role}), which is read")]
    TakesInput {
        /// Option of the output.
        role: String,
        /// The output, as given.
        output: PathBuf,
        /// The input, as given.
        input: PathBuf,
        /// Option of the input, or what it is.
        input_role: String,
    },
    /// Two outputs are one file.
    #[error("{role} {output} and {other_role} {other} name the same file")]
    SameOutput {
        /// Option of the one.
        role: String,
        /// The one, as given.
        output: PathBuf,
        /// Option of the other.
        other_role: String,
        /// The other, as given.
        other: PathBuf,
    },
    /// A file lies in a folder that the command fills and may remove.
    #[error("{role} {path} lies in {folder}, {folder_role}")]
    InFolder {
        /// Option of the file, or what it is.
        role: String,
        /// The file, as given.
        path: PathBuf,
        /// The folder.
        folder: PathBuf,
        /// What the folder is.
        folder_role: String,
    },
    /// Its name ends as that of a folder does.
    #[error("{role} {output} ends as the name of a folder, and a file is to be written there")]
    NoFileName {
        /// Option of the output.
        role: String,
        /// The output, as given.
        output: PathBuf,
    },
    /// It is a link to nothing.
    #[error("{role} {output} is a link to {target}, which does not exist")]
    DanglingLink {
        /// Option of the output.
        role: String,
        /// The output, as given.
        output: PathBuf,
        /// What the link names.
        target: PathBuf,
    },
}

impl FileUseError {
    /// What to do.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::TakesInput { role, .. } => {
                format!("give {role} another name: a file that is read is never replaced")
            }
            Self::SameOutput {
                role, other_role, ..
            } => format!("give {role} and {other_role} a file each"),
            Self::InFolder { role, .. } => {
                format!("keep {role} elsewhere, or write the result elsewhere")
            }
            Self::NoFileName { role, .. } => {
                format!("give {role} the name of a file, without a slash behind it")
            }
            Self::DanglingLink { role, .. } => {
                format!("remove the link, or let {role} name the file itself")
            }
        }
    }
}

impl FileUse {
    /// Nothing read and nothing written so far.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file that is read. `role` is the option that names it, or what it is.
    pub fn reads(&mut self, role: impl Into<String>, path: impl Into<PathBuf>) {
        self.read.push(named(role, path, false));
    }

    /// Adds a file that will be written.
    pub fn writes(&mut self, role: impl Into<String>, path: impl Into<PathBuf>) {
        self.written.push(named(role, path, false));
    }

    /// Adds a folder into which files will be written under names of their own.
    pub fn fills(&mut self, role: impl Into<String>, path: impl Into<PathBuf>) {
        self.written.push(named(role, path, true));
    }

    /// The files that will be written, as they were given.
    pub fn outputs(&self) -> impl Iterator<Item = &Path> {
        let files = self.written.iter().filter(|named| !named.folder);
        files.map(|named| named.path.as_path())
    }

    /// The folders that will be filled, as they were given, each with the option that names it, or what it is.
    pub fn folders(&self) -> impl Iterator<Item = (&str, &Path)> {
        let folders = self.written.iter().filter(|named| named.folder);
        folders.map(|named| (named.role.as_str(), named.path.as_path()))
    }

    /// Compares every output with every input and with every other output: by their paths
    /// with all links resolved, and by the files themselves, so that hard links and mounts
    /// deceive no one.
    ///
    /// # Errors
    /// The first output that cannot be one.
    pub fn check(&self) -> Result<(), FileUseError> {
        for (i, output) in self.written.iter().enumerate() {
            output.names_a_file()?;
            self.input_spared_by(output)?;
            for other in &self.written[..i] {
                output.apart_from(other)?;
            }
        }
        Ok(())
    }

    /// Compares an output, as it was given, with every input once more: a link may have come there
    /// since. Of a file that is no output of the command it knows nothing.
    ///
    /// # Errors
    /// Why it cannot be an output.
    pub fn check_output(&self, path: &Path) -> Result<(), FileUseError> {
        let files = self.written.iter().filter(|named| !named.folder);
        let mut outputs = files.filter(|named| named.path == path);
        outputs.try_for_each(|output| self.input_spared_by(output))
    }

    fn input_spared_by(&self, output: &Named) -> Result<(), FileUseError> {
        output.leads_somewhere()?;
        self.read.iter().try_for_each(|input| output.spares(input))
    }
}

fn named(role: impl Into<String>, path: impl Into<PathBuf>, folder: bool) -> Named {
    Named {
        role: role.into(),
        path: path.into(),
        folder,
    }
}

impl Named {
    fn names_a_file(&self) -> Result<(), FileUseError> {
        if !self.folder && !ends_in_a_file_name(&self.path) {
            return Err(FileUseError::NoFileName {
                role: self.role.clone(),
                output: self.path.clone(),
            });
        }
        Ok(())
    }

    fn leads_somewhere(&self) -> Result<(), FileUseError> {
        if self.path.is_symlink() && !self.path.exists() {
            return Err(FileUseError::DanglingLink {
                role: self.role.clone(),
                output: self.path.clone(),
                target: std::fs::read_link(&self.path).unwrap_or_default(),
            });
        }
        Ok(())
    }

    fn spares(&self, input: &Self) -> Result<(), FileUseError> {
        if same_file(&self.path, &input.path) {
            return Err(FileUseError::TakesInput {
                role: self.role.clone(),
                output: self.path.clone(),
                input: input.path.clone(),
                input_role: input.role.clone(),
            });
        }
        self.holds_not(input)
    }

    fn apart_from(&self, other: &Self) -> Result<(), FileUseError> {
        if same_file(&self.path, &other.path) {
            return Err(FileUseError::SameOutput {
                role: other.role.clone(),
                output: other.path.clone(),
                other_role: self.role.clone(),
                other: self.path.clone(),
            });
        }
        self.holds_not(other)?;
        other.holds_not(self)
    }

    /// Whether another path lies outside of this, if it is a folder.
    fn holds_not(&self, other: &Self) -> Result<(), FileUseError> {
        if self.folder && resolved(&other.path).starts_with(resolved(&self.path)) {
            return Err(FileUseError::InFolder {
                role: other.role.clone(),
                path: other.path.clone(),
                folder: self.path.clone(),
                folder_role: self.role.clone(),
            });
        }
        Ok(())
    }
}

/// Whether the last part of a path can be the name of a file: no slash stands behind it, and it is neither `.` nor
/// `..`. The parts that [`Path`] tells of a name leave slashes at its end out, which systems do not: they find
/// nothing under `a.h5/` where the file `a.h5` stands, and yet put nothing there.
#[must_use]
pub fn ends_in_a_file_name(path: &Path) -> bool {
    let name = path.as_os_str().as_encoded_bytes();
    let is_separator = |byte: &u8| std::path::is_separator(char::from(*byte));
    let last = name.rsplit(is_separator).next().unwrap_or_default();
    !matches!(last, b"" | b"." | b"..")
}

/// Whether two paths lead to one file, be it there already or not.
#[must_use]
pub fn same_file(a: &Path, b: &Path) -> bool {
    let by_number = match (number(a), number(b)) {
        (Some(a), Some(b)) => a == b,
        _ => false,
    };
    by_number || resolved(a) == resolved(b)
}

/// Device and number of a file, which all its names share. It is not opened: a pipe keeps
/// what is in it.
#[cfg(unix)]
fn number(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    let found = std::fs::metadata(path).ok()?;
    Some((found.dev(), found.ino()))
}

#[cfg(not(unix))]
fn number(_: &Path) -> Option<(u64, u64)> {
    None
}

/// A path without links and detours; of one that is not there, those of its folder.
fn resolved(path: &Path) -> PathBuf {
    if let Ok(real) = path.canonicalize() {
        return real;
    }
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    match (absolute.parent(), absolute.file_name()) {
        (Some(folder), Some(name)) => resolved(folder).join(name),
        _ => absolute,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[cfg(unix)]
    #[test]
    fn every_name_of_a_file_is_known() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("inside")).unwrap();
        std::fs::write(at("case.toml"), "a").unwrap();
        std::fs::hard_link(at("case.toml"), at("hard")).unwrap();
        symlink("case.toml", at("soft")).unwrap();
        symlink("soft", at("softer")).unwrap();
        symlink(".", at("here")).unwrap();
        let mut files = FileUse::new();
        files.reads("CASE", at("case.toml"));
        files.check().unwrap();
        for name in [
            "case.toml",
            "./case.toml",
            "inside/../case.toml",
            "here/case.toml",
            "hard",
            "soft",
            "softer",
        ] {
            let mut files = files.clone();
            files.writes("--plot", at(name));
            let refused = files.check().unwrap_err();
            assert!(
                matches!(&refused, FileUseError::TakesInput { role, .. } if role == "--plot"),
                "{name}: {refused}"
            );
            let told = refused.to_string();
            assert!(told.contains(name) && told.contains("CASE"), "{told}");
        }
        files.writes("--plot", at("copy.toml"));
        files.check().unwrap();
        // A link that comes after the check.
        symlink("case.toml", at("copy.toml")).unwrap();
        let refused = files.check_output(&at("copy.toml")).unwrap_err();
        assert!(matches!(refused, FileUseError::TakesInput { .. }));
        files.check_output(&at("soft")).unwrap();
    }

    #[test]
    fn two_outputs_are_two_files() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("inside")).unwrap();
        for other in ["new.h5", "./new.h5", "inside/../new.h5"] {
            let mut files = FileUse::new();
            files.writes("--output", at("new.h5"));
            files.check().unwrap();
            files.writes("--csv", at(other));
            let refused = files.check().unwrap_err().to_string();
            assert!(refused.contains("name the same file"), "{refused}");
        }
        // Nor does a folder that is not there make two of one.
        assert!(same_file(&at("none/a"), &at("./none/a")));
        assert!(!same_file(&at("none/a"), &at("none/b")));
    }

    #[test]
    fn a_folder_that_is_removed_holds_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for (reads, writes) in [
            (Some("a.h5.parts/r.csv"), None),
            (None, Some("a.h5.parts/t.csv")),
        ] {
            for filled_first in [true, false] {
                let mut files = FileUse::new();
                if filled_first {
                    files.fills("the folder of the finished runs", at("a.h5.parts"));
                }
                if let Some(path) = reads {
                    files.reads("record", at(path));
                }
                if let Some(path) = writes {
                    files.writes("--csv", at(path));
                }
                if !filled_first {
                    files.fills("the folder of the finished runs", at("a.h5.parts"));
                }
                let refused = files.check().unwrap_err();
                assert!(
                    matches!(refused, FileUseError::InFolder { .. }),
                    "{refused}"
                );
            }
        }
    }

    /// Whether a file of the name stands there or not, and before it is held against inputs.
    #[test]
    fn a_name_that_ends_as_that_of_a_folder_is_no_output() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("a.h5"), "a").unwrap();
        for name in [
            "a.h5/", "a.h5//", "a.h5/.", "a.h5/./", "a.h5/..", "new.h5/", "./", ".", "..",
        ] {
            let mut files = FileUse::new();
            files.reads("CASE", at("a.h5"));
            files.writes("--output", at(name));
            let refused = files.check().unwrap_err();
            assert!(
                matches!(&refused, FileUseError::NoFileName { role, .. } if role == "--output"),
                "{name}: {refused}"
            );
            let told = refused.to_string();
            assert!(told.contains(name), "{told}");
            assert!(refused.help().contains("without a slash"));
            // Folders are named so.
            let mut files = FileUse::new();
            files.fills("--pages", at(name));
            files.check().unwrap();
        }
        for name in ["a.h5", "./a.h5", "..a", "a..", ".a", "none/../a.h5"] {
            assert!(ends_in_a_file_name(Path::new(name)), "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_nothing_is_no_output() {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("nothing.h5", &link).unwrap();
        let mut files = FileUse::new();
        files.writes("--output", &link);
        let refused = files.check().unwrap_err().to_string();
        assert!(refused.contains("a link to nothing.h5"), "{refused}");
    }
}
