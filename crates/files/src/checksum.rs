//! A checksum at the end of a result file, which is read without HDF5.
//!
//! The last [`LENGTH`] bytes of a file that we wrote are a line of text,
//! `pounding-sha256:1 <64 hexadecimal digits>`: the SHA-256 of all bytes before it. HDF5
//! says itself where its content ends and ignores what follows, so that every reader of
//! HDF5 opens the file. A library that parses a damaged HDF5 file may crash, hang or
//! return zeros: [`check`] tells before it sees the file.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::{input, label_line};

/// Start of the line; the number is the version of its form.
const START: &[u8] = b"pounding-sha256:1 ";
/// Start of the line in any version.
const ANY_VERSION: &[u8] = b"pounding-sha256:";
/// Hexadecimal digits of a SHA-256.
const DIGITS: usize = 64;
/// Bytes of the line with its end.
pub const LENGTH: usize = START.len() + DIGITS + 1;
/// First bytes of every HDF5 file.
const SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";
/// Bytes that are read at once.
const BLOCK: usize = 1 << 18;

/// What people are told of a file that was read without a checksum.
pub const ABSENT: &str = "has no checksum: a version of the program that wrote none made it, and damage to its numbers would not be seen";

/// Bytes in hexadecimal digits.
#[must_use]
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

/// What the checksum of a file says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Checksum {
    /// It is that of the content.
    Matches,
    /// There is none: a version of the program that wrote none made the file.
    Absent,
}

/// What to do with a file that has no checksum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WithoutChecksum {
    /// It is refused.
    #[default]
    Refuse,
    /// It is read. If it is damaged, HDF5 may crash or hang: for a process that has
    /// nothing to lose.
    Accept,
}

/// Why a file must not be parsed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChecksumError {
    /// The operating system cannot read it.
    #[error("{0}")]
    Read(#[from] io::Error),
    /// It does not begin as HDF5 does.
    #[error("it is not HDF5")]
    NotHdf5,
    /// It ends before its content does.
    #[error("it is damaged: its end is missing")]
    Truncated,
    /// Its content has changed since it was written.
    #[error("it is damaged: its content does not match its checksum")]
    Mismatch,
    /// What follows the content is no checksum that we know.
    #[error("it is damaged: what follows its content is not its checksum")]
    NotAChecksum,
    /// Its header says nothing that HDF5 would write.
    #[error("it is damaged: its header is not that of a result file")]
    Header,
    /// It has no checksum, and none was not to be accepted.
    #[error("it has no checksum")]
    Absent,
    /// A file that was written with a checksum has none.
    #[error(
        "its checksum is missing: it was cut, or opened for writing by another program, after it was written"
    )]
    Removed,
}

impl ChecksumError {
    /// Whether the file is not as it was written, whoever reads it.
    #[must_use]
    pub fn is_damage(&self) -> bool {
        !matches!(self, Self::Read(_) | Self::Absent)
    }

    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::Read(_) | Self::NotHdf5 => None,
            Self::Truncated | Self::Mismatch | Self::NotAChecksum | Self::Header => {
                Some("copy the file again from where it is whole, or run it again")
            }
            Self::Absent => Some("read it in a process of its own, or run it again"),
            Self::Removed => Some(
                "use the file as it was written: changes, such as attributes, belong into a copy; or run it again",
            ),
        }
    }
}

/// Appends the checksum to a file that is finished and closed.
///
/// # Errors
/// What the operating system says.
pub fn append(path: &Path) -> io::Result<()> {
    let mut file = File::options().read(true).write(true).open(path)?;
    let length = file.seek(SeekFrom::End(0))?;
    let line = line(&mut file, length)?;
    file.seek(SeekFrom::End(0))?;
    file.write_all(&line)
}

/// Compares a file with its checksum.
///
/// # Errors
/// [`ChecksumError`] if it may not be parsed.
pub fn check(path: &Path, without: WithoutChecksum) -> Result<Checksum, ChecksumError> {
    match check_content(&mut input::open(path)?)? {
        Checksum::Absent if without == WithoutChecksum::Refuse => Err(ChecksumError::Absent),
        found => Ok(found),
    }
}

/// Whether a file is whole but has no checksum, by its first and last bytes alone.
///
/// # Errors
/// [`ChecksumError`] if it is damaged already by these bytes.
pub fn is_absent(path: &Path) -> Result<bool, ChecksumError> {
    Ok(ending(&mut input::open(path)?)?.is_none())
}

/// Compares content with the checksum at its end.
///
/// # Errors
/// As [`check`].
pub fn check_content(content: &mut (impl Read + Seek)) -> Result<Checksum, ChecksumError> {
    let Some((found, length)) = ending(content)? else {
        return Ok(Checksum::Absent);
    };
    match line(content, length)? == found {
        true => Ok(Checksum::Matches),
        false => Err(ChecksumError::Mismatch),
    }
}

/// Where the line begins, or the end of what has none.
pub(crate) fn without_line(content: &mut (impl Read + Seek)) -> io::Result<u64> {
    let length = content.seek(SeekFrom::End(0))?;
    let Some(before) = length.checked_sub(LENGTH as u64) else {
        return Ok(length);
    };
    content.seek(SeekFrom::Start(before))?;
    let mut last = [0; LENGTH];
    content.read_exact(&mut last)?;
    let ours = last.starts_with(START) && last.ends_with(b"\n");
    Ok(if ours { before } else { length })
}

/// The line at the end and the number of bytes before it; `None` if the content ends where
/// HDF5 says that it does.
fn ending(content: &mut (impl Read + Seek)) -> Result<Option<([u8; LENGTH], u64)>, ChecksumError> {
    let length = content.seek(SeekFrom::End(0))?;
    content.rewind()?;
    let mut header = [0; 64];
    let read = fill(content, &mut header)?;
    if !header[..read].starts_with(SIGNATURE) {
        return Err(ChecksumError::NotHdf5);
    }
    if read < header.len() {
        return Err(ChecksumError::Truncated);
    }
    let mut last = [0; LENGTH];
    if let Some(before) = length.checked_sub(LENGTH as u64) {
        content.seek(SeekFrom::Start(before))?;
        content.read_exact(&mut last)?;
        if last.starts_with(START) && last.ends_with(b"\n") {
            return Ok(Some((last, before)));
        }
    }
    let end = end_of_content(&header).ok_or(ChecksumError::Header)?;
    if end < length && labelled(content, end)? {
        return Err(ChecksumError::Removed);
    }
    match end.cmp(&length) {
        std::cmp::Ordering::Equal if !last.starts_with(ANY_VERSION) => Ok(None),
        std::cmp::Ordering::Greater => Err(ChecksumError::Truncated),
        _ => Err(ChecksumError::NotAChecksum),
    }
}

/// Whether what follows the content is a label and nothing else: the checksum was cut off.
fn labelled(content: &mut (impl Read + Seek), end: u64) -> io::Result<bool> {
    content.seek(SeekFrom::Start(end))?;
    let mut rest = Vec::new();
    content.take(label_line::LONGEST).read_to_end(&mut rest)?;
    let text = rest.strip_prefix(label_line::START.as_bytes());
    let line = text.and_then(|text| text.strip_suffix(b"\n"));
    Ok(line.is_some_and(|line| !line.contains(&b'\n')))
}

/// The end of the content as the superblock of HDF5 has it (File Format Specification,
/// II.A), for the sizes and the base address that our files have.
fn end_of_content(header: &[u8; 64]) -> Option<u64> {
    let (sizes, base, end) = match header[8] {
        0 => (13, 24, 40),
        1 => (13, 28, 44),
        2 | 3 => (9, 12, 28),
        _ => return None,
    };
    let number = |at: usize| {
        let bytes = header.get(at..at + 8)?;
        Some(u64::from_le_bytes(bytes.try_into().ok()?))
    };
    (header[sizes..sizes + 2] == [8, 8] && number(base)? == 0).then(|| number(end))?
}

/// The line of the first `length` bytes.
fn line(content: &mut (impl Read + Seek), length: u64) -> io::Result<[u8; LENGTH]> {
    content.rewind()?;
    let mut content = content.take(length);
    let mut hash = Sha256::new();
    let mut block = vec![0; BLOCK];
    loop {
        match fill(&mut content, &mut block)? {
            0 => break,
            read => hash.update(&block[..read]),
        }
    }
    let mut line = [b'\n'; LENGTH];
    line[..START.len()].copy_from_slice(START);
    let digits = line[START.len()..].chunks_exact_mut(2);
    for (digits, byte) in digits.zip(hash.finalize()) {
        for (digit, half) in digits.iter_mut().zip([byte >> 4, byte & 15]) {
            *digit = b"0123456789abcdef"[usize::from(half)];
        }
    }
    Ok(line)
}

/// Reads until the buffer is full or nothing is left.
fn fill(content: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < buffer.len() {
        match content.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(read) => filled += read,
            Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
            Err(e) => return Err(e),
        }
    }
    Ok(filled)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::io::Cursor;

    use super::*;

    /// What begins as HDF5 and says where it ends.
    fn content(length: usize) -> Vec<u8> {
        let mut bytes: Vec<u8> = (0..length).map(|i| (i * 131 % 251) as u8).collect();
        bytes[..8].copy_from_slice(SIGNATURE);
        bytes[8] = 0;
        bytes[13..15].copy_from_slice(&[8, 8]);
        bytes[24..32].fill(0);
        bytes[40..48].copy_from_slice(&(length as u64).to_le_bytes());
        bytes
    }

    fn with_checksum(length: usize) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        std::fs::write(&path, content(length)).unwrap();
        append(&path).unwrap();
        std::fs::read(path).unwrap()
    }

    fn found(bytes: &[u8]) -> Result<Checksum, ChecksumError> {
        check_content(&mut Cursor::new(bytes))
    }

    #[test]
    fn the_line_is_the_hash_of_what_stands_before_it() {
        // Around the size of a block too.
        for length in [64, 1000, BLOCK - 1, BLOCK, BLOCK + 1] {
            let bytes = with_checksum(length);
            assert_eq!(bytes.len(), length + LENGTH);
            assert_eq!(found(&bytes).unwrap(), Checksum::Matches);
            let (before, line) = bytes.split_at(length);
            assert_eq!(before, content(length));
            let digits = hexadecimal(&Sha256::digest(before));
            let expected = format!("pounding-sha256:1 {digits}\n");
            assert_eq!(line, expected.as_bytes());
        }
    }

    #[test]
    fn every_flipped_bit_every_cut_and_every_addition_is_seen() {
        let whole = with_checksum(700);
        for at in 0..whole.len() {
            for bit in 0..8 {
                let mut bytes = whole.clone();
                bytes[at] ^= 1 << bit;
                assert!(found(&bytes).is_err(), "bit {bit} of byte {at}");
            }
            // Cut right before the line it is a file without a checksum: see below.
            if at != 700 {
                assert!(found(&whole[..at]).is_err(), "cut at {at}");
            }
        }
        for more in [&b"\n"[..], b"\0", b"pounding-sha256:1 ", &whole[700..]] {
            assert!(found(&[&whole, more].concat()).is_err());
        }
    }

    #[test]
    fn a_whole_file_without_checksum_is_told_from_a_damaged_one() {
        let whole = content(700);
        assert_eq!(found(&whole).unwrap(), Checksum::Absent);
        for (bytes, word) in [
            (whole[..699].to_vec(), "end is missing"),
            (whole[..20].to_vec(), "end is missing"),
            ([&whole[..], b"x"].concat(), "not its checksum"),
            ([&whole[..], &[b'x'; LENGTH]].concat(), "not its checksum"),
            (b"\x89PNG".to_vec(), "not HDF5"),
            (Vec::new(), "not HDF5"),
        ] {
            let told = found(&bytes).unwrap_err().to_string();
            assert!(told.contains(word), "{told}");
        }
        // What was written with a label was written with a checksum.
        let label = [label_line::START.as_bytes(), b"text\n"].concat();
        let cut = found(&[&whole[..], &label].concat());
        assert!(matches!(cut, Err(ChecksumError::Removed)), "{cut:?}");
        let mut other = content(700);
        other[13] = 4;
        assert!(matches!(found(&other), Err(ChecksumError::Header)));
        // A size that cannot be is not shown.
        other = content(700);
        other[40..48].fill(0xff);
        let told = found(&other).unwrap_err().to_string();
        assert_eq!(told, "it is damaged: its end is missing");
    }

    #[test]
    fn what_has_no_checksum_is_refused_unless_accepted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.h5");
        std::fs::write(&path, content(700)).unwrap();
        assert!(is_absent(&path).unwrap());
        let refused = check(&path, WithoutChecksum::Refuse);
        assert!(matches!(refused, Err(ChecksumError::Absent)));
        let accepted = check(&path, WithoutChecksum::Accept);
        assert_eq!(accepted.unwrap(), Checksum::Absent);
        append(&path).unwrap();
        assert!(!is_absent(&path).unwrap());
        let checked = check(&path, WithoutChecksum::Refuse);
        assert_eq!(checked.unwrap(), Checksum::Matches);
    }
}
