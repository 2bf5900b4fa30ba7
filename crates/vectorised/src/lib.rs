//! One attribute, for functions whose loops run over vector lanes: which sets of instructions they are compiled for stands
//! here alone.

use proc_macro::TokenStream;

/// What precedes a function: `multiversion` compiles it once for each of these sets and for none of them, and takes the
/// first that the processor has. None of them fuses a product and a sum unless the code asks for it, so that all give the
/// same bits.
const OF_EACH_SET: &str = r#"#[::multiversion::multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]"#;

/// Compiles a function for each set of vector instructions, and takes the best that the processor has when it is called.
/// The crate that uses it depends on `multiversion`.
///
/// # Errors
/// Arguments, of which there are none, do not compile.
#[proc_macro_attribute]
pub fn vectorised(arguments: TokenStream, function: TokenStream) -> TokenStream {
    let before = match arguments.is_empty() {
        true => OF_EACH_SET,
        false => "::core::compile_error!(\"`vectorised` takes no arguments\");",
    };
    let mut all: TokenStream = before.parse().unwrap_or_default();
    all.extend(function);
    all
}
