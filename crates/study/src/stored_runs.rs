//! What files of stored runs have in common: a line of JSON, numbers, and a hash of all before it.

use serde_json::Value;
use sha2::{Digest, Sha256};

/// Bytes of the hash at the end.
pub(crate) const HASH: usize = 32;

/// Puts the hash of all bytes at their end.
pub(crate) fn with_hash(mut bytes: Vec<u8>) -> Vec<u8> {
    let hash = Sha256::digest(&bytes);
    bytes.extend_from_slice(&hash);
    bytes
}

/// What stands before the hash, if that is its.
pub(crate) fn whole(bytes: &[u8]) -> Option<&[u8]> {
    let (content, hash) = bytes.split_at(bytes.len().checked_sub(HASH)?);
    (Sha256::digest(content).as_slice() == hash).then_some(content)
}

/// The line of JSON and the bytes of the numbers.
pub(crate) fn head_and_numbers(content: &[u8]) -> Option<(Value, &[u8])> {
    let end = content.iter().position(|b| *b == b'\n')?;
    let head = serde_json::from_slice(&content[..end]).ok()?;
    Some((head, &content[end + 1..]))
}
