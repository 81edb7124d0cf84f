//! The header that is in the repository is the one that the code makes.

use std::path::Path;

#[test]
fn the_header_is_what_the_code_says() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(package.join("cbindgen.toml")).unwrap();
    let bindings = cbindgen::Builder::new().with_crate(package).with_config(config).generate().unwrap();
    let mut text = Vec::new();
    bindings.write(&mut text);
    let text = String::from_utf8(text).unwrap();
    let path = package.join("include/vair.h");
    if std::env::var_os("VAIR_BLESS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap();
    assert!(committed == text, "include/vair.h is not what src makes: VAIR_BLESS=1 cargo test --test header");
}
