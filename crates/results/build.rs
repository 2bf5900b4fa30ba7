//! Tells whether the HDF5 that is linked in lets a file be opened without a lock.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(file_locking)");
    let has = |release: &str| std::env::var_os(format!("DEP_HDF5_VERSION_{release}")).is_some();
    // It came with 1.10.7 and 1.12.1.
    if has("1_12_1") || has("1_10_7") && !has("1_12_0") {
        println!("cargo::rustc-cfg=file_locking");
    }
}
