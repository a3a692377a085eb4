//! Tells the module what it was built with and for: figures of a bench are hearsay without that.

use std::env::var;
use std::process::Command;

fn main() {
    let compiler = var("RUSTC").unwrap_or_default();
    let version = Command::new(&compiler).arg("--version").output().ok();
    let version = version.and_then(|said| String::from_utf8(said.stdout).ok());
    let features = var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    let facts = [
        ("RUSTC", version.unwrap_or_default().trim().to_owned()),
        ("TARGET", var("TARGET").unwrap_or_default()),
        ("TARGET_FEATURES", features),
        (
            "FLAGS",
            var("CARGO_ENCODED_RUSTFLAGS")
                .unwrap_or_default()
                .replace('\u{1f}', " "),
        ),
        ("OPT_LEVEL", var("OPT_LEVEL").unwrap_or_default()),
    ];
    for (name, fact) in facts {
        println!("cargo::rustc-env=KUGLICE_{name}={fact}");
    }
    println!("cargo::rerun-if-changed=build.rs");
}
