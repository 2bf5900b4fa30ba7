//! Paths in arguments, told apart by what becomes of the file.
//!
//! Every argument that is a path has one of these types: by them the files of a command are
//! held against one another before it does any work, and tests find every output there is.

use std::any::TypeId;
use std::ffi::OsString;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use clap::builder::{OsStringValueParser, TypedValueParser, ValueParser, ValueParserFactory};
use clap::{Arg, ArgMatches, Command};
use pounding_files::FileUse;
use serde::Serialize;

macro_rules! path_type {
    ($(#[$about:meta])* $name:ident) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq, Eq, Serialize)]
        #[serde(transparent)]
        pub struct $name(PathBuf);

        impl From<OsString> for $name {
            fn from(text: OsString) -> Self {
                Self(text.into())
            }
        }

        impl ValueParserFactory for $name {
            type Parser = ValueParser;

            fn value_parser() -> ValueParser {
                let named = |text: OsString| match text.is_empty() {
                    true => Err("the name of a file is empty"),
                    false => Ok(Self::from(text)),
                };
                ValueParser::new(OsStringValueParser::new().try_map(named))
            }
        }

        impl Deref for $name {
            type Target = Path;

            fn deref(&self) -> &Path {
                &self.0
            }
        }

        impl AsRef<Path> for $name {
            fn as_ref(&self) -> &Path {
                &self.0
            }
        }
    };
}

path_type! {
    /// A file, or a folder of files, that is read.
    InputPath
}
path_type! {
    /// A file that is written.
    OutputPath
}
path_type! {
    /// A folder into which files are written.
    OutputFolder
}

/// What becomes of the file of an argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathKind {
    /// It is read.
    Input,
    /// It is written.
    Output,
    /// Files are written into it.
    OutputFolder,
    /// A path that is not said to be read or written: no argument may be one.
    Unknown,
}

impl PathKind {
    /// The kind of an argument; `None` if it is no path.
    #[must_use]
    pub fn of(argument: &Arg) -> Option<Self> {
        let found = argument.get_value_parser().type_id();
        [
            (TypeId::of::<InputPath>(), Self::Input),
            (TypeId::of::<OutputPath>(), Self::Output),
            (TypeId::of::<OutputFolder>(), Self::OutputFolder),
            (TypeId::of::<PathBuf>(), Self::Unknown),
            (TypeId::of::<OsString>(), Self::Unknown),
        ]
        .into_iter()
        .find_map(|(id, kind)| (found == id).then_some(kind))
    }
}

/// The files that the arguments of a command name.
pub fn file_use(command: &Command, matches: &ArgMatches) -> FileUse {
    let mut files = FileUse::new();
    add(command, matches, &mut files);
    files
}

fn add(command: &Command, matches: &ArgMatches, files: &mut FileUse) {
    for argument in command.get_arguments() {
        let (id, role) = (argument.get_id().as_str(), role(argument));
        match PathKind::of(argument) {
            Some(PathKind::Input) => {
                for path in matches.get_many::<InputPath>(id).into_iter().flatten() {
                    files.reads(&role, &path.0);
                }
            }
            Some(PathKind::Output) => {
                for path in matches.get_many::<OutputPath>(id).into_iter().flatten() {
                    files.writes(&role, &path.0);
                }
            }
            Some(PathKind::OutputFolder) => {
                for path in matches.get_many::<OutputFolder>(id).into_iter().flatten() {
                    files.fills(&role, &path.0);
                }
            }
            Some(PathKind::Unknown) | None => {}
        }
    }
    if let Some((name, matches)) = matches.subcommand()
        && let Some(command) = command.find_subcommand(name)
    {
        add(command, matches, files);
    }
}

/// How a user knows an argument: by its option, or by its place's name.
fn role(argument: &Arg) -> String {
    match argument.get_long() {
        Some(long) => format!("--{long}"),
        None => argument.get_id().as_str().to_uppercase(),
    }
}
