//! A file by whose lock processes agree who is at work.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

/// Opens a file that is there to be locked, and makes it if it is not there. Nothing is ever written into it, so that a
/// file which holds something, or goes by another name too, is one of somebody else: it stays as it is.
///
/// # Errors
/// A link, a file with another name or with content, a folder, a device or a pipe; what the system says.
pub fn open_lock(path: &Path) -> Result<File> {
    match path.symlink_metadata() {
        Ok(found) => may_be_locked(&found)?,
        Err(e) if e.kind() == ErrorKind::NotFound => {}
        Err(e) => return Err(e),
    }
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        // A link that has come in between is not followed.
        options.custom_flags(rustix::fs::OFlags::NOFOLLOW.bits().cast_signed());
    }
    let file = options.open(path)?;
    // What has come in between.
    may_be_locked(&file.metadata()?)?;
    Ok(file)
}

fn may_be_locked(found: &Metadata) -> Result<()> {
    let refused = |reason: &str| {
        Err(Error::other(format!(
            "{reason}: it is not the lock that stands here while runs are made; move it away"
        )))
    };
    if found.is_symlink() {
        return refused("this is a link");
    }
    if !found.is_file() {
        return refused("this is no regular file");
    }
    if found.len() > 0 {
        return refused("this file holds something");
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        if found.nlink() > 1 {
            return refused("this file has another name, by a hard link");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn files_of_others_are_no_locks() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        open_lock(&at("lock")).unwrap();
        open_lock(&at("lock")).unwrap();
        std::fs::write(at("text"), "mine").unwrap();
        std::fs::create_dir(at("folder")).unwrap();
        let refused = |name: &str, why: &str| {
            let told = open_lock(&at(name)).unwrap_err().to_string();
            assert!(told.starts_with(why), "{name}: {told}");
        };
        refused("text", "this file holds something");
        refused("folder", "this is no regular file");
        #[cfg(unix)]
        {
            use std::os::unix::fs::symlink;
            symlink("text", at("soft")).unwrap();
            symlink("nothing", at("dangling")).unwrap();
            std::fs::write(at("empty"), "").unwrap();
            std::fs::hard_link(at("empty"), at("hard")).unwrap();
            refused("soft", "this is a link");
            refused("dangling", "this is a link");
            refused("hard", "this file has another name");
            assert!(!at("nothing").exists());
        }
        assert_eq!(std::fs::read(at("text")).unwrap(), b"mine");
    }
}
