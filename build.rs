//! Compiles the shaders.

fn main() {
    let out = std::env::var("OUT_DIR").unwrap();
    std::fs::write(format!("{out}/shader_table.rs"), "").unwrap();
    std::fs::write(format!("{out}/shader_layout.rs"), "").unwrap();
}
