//! Requests and their answers, without a browser.
#![allow(clippy::unwrap_used)]
