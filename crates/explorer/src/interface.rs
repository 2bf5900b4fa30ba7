//! What a host of the WebAssembly module calls, and the one function that it gives.
//!
//! To ask, it calls `pounding_reserve` with the length of a request, writes the request into the
//! memory there, and calls `pounding_answer`, which returns where the answer begins;
//! `pounding_answer_length` says how long it is. Both stay until the next request.
// A C interface has no other form: the names of its functions are global, and the host's function
// is known by its name alone. No pointer is followed here.
#![allow(unsafe_code)]

use std::cell::RefCell;

use crate::explorer::Explorer;
use crate::limits::LONGEST_REQUEST;

#[link(wasm_import_module = "pounding")]
unsafe extern "C" {
    /// Milliseconds since the beginning of 1970: takes nothing and touches no memory.
    safe fn pounding_now() -> f64;
}

/// Milliseconds since the beginning of 1970.
pub(crate) fn now() -> f64 {
    pounding_now()
}

#[derive(Default)]
struct Host {
    explorer: Explorer,
    request: Vec<u8>,
    answer: Vec<u8>,
}

thread_local! {
    static HOST: RefCell<Host> = RefCell::default();
}

/// Memory for a request of this length (bytes), or null for one that is too long.
#[unsafe(no_mangle)]
pub extern "C" fn pounding_reserve(length: usize) -> *mut u8 {
    HOST.with_borrow_mut(|host| {
        let mut request = Vec::new();
        if length > LONGEST_REQUEST || request.try_reserve_exact(length).is_err() {
            return std::ptr::null_mut();
        }
        request.resize(length, 0);
        host.request = request;
        host.request.as_mut_ptr()
    })
}

/// Answers the request that was written, and returns where the answer begins.
#[unsafe(no_mangle)]
pub extern "C" fn pounding_answer() -> *const u8 {
    HOST.with_borrow_mut(|host| {
        let request = std::mem::take(&mut host.request);
        host.answer = host.explorer.answer(&request);
        host.answer.as_ptr()
    })
}

/// Length of the answer (bytes).
#[unsafe(no_mangle)]
pub extern "C" fn pounding_answer_length() -> usize {
    HOST.with_borrow(|host| host.answer.len())
}
