//! Promise: what the README says of presets and parameters is what the program knows of them.
//!
//! The text between the marks is made from the declarations; `tools/bless` writes it.

use std::fmt::Write;
use std::path::Path;
use vair::material::{KINDS, Parameter, presets, procedural};

const COLUMNS: usize = 4;

/// A table of pictures, and under each the preset's name and help.
fn gallery() -> String {
    let mut text = String::new();
    let cell = |preset: &vair::material::Preset| {
        let file = preset.hyphenated();
        format!(
            "<img src=\"docs/presets/{file}.png\" width=\"200\"><br>**{}** ({}): {}",
            preset.name,
            preset.kind(),
            preset.help
        )
    };
    writeln!(text, "{}", "| ".repeat(COLUMNS) + "|").unwrap();
    writeln!(text, "{}", "|---".repeat(COLUMNS) + "|").unwrap();
    for row in presets().chunks(COLUMNS) {
        let mut cells: Vec<String> = row.iter().map(cell).collect();
        cells.resize(COLUMNS, String::new());
        writeln!(text, "| {} |", cells.join(" | ")).unwrap();
    }
    text
}

/// One folded list of the images that are made by formula.
fn images() -> String {
    let lines = procedural::ALL.iter().map(|image| format!("| `{}` | {} |\n", image.name, image.help));
    let table: String = lines.collect();
    format!("<details><summary>Images by formula</summary>\n\n| name | |\n|---|---|\n{table}\n</details>\n")
}

/// One folded table a kind of material.
fn parameters() -> String {
    let mut text = String::new();
    for (kind, list) in KINDS {
        let count = list.len();
        writeln!(text, "<details><summary><b>{kind}</b>: {count} keys</summary>\n").unwrap();
        writeln!(text, "| key | takes | range | default | |\n|---|---|---|---|---|").unwrap();
        for parameter in *list {
            let Parameter { name, help, .. } = parameter;
            let default = (parameter.default)();
            writeln!(text, "| `{name}` | {} | {} | `{default}` | {help} |", takes(parameter), range(parameter))
                .unwrap();
        }
        writeln!(text, "\n</details>\n").unwrap();
    }
    text
}

fn takes(parameter: &Parameter) -> String {
    match parameter.choices {
        [] if parameter.kind.contains("file.png") => "texture".to_owned(),
        [] => parameter.kind.to_owned(),
        choices => choices.iter().map(|choice| format!("`\"{choice}\"`")).collect::<Vec<_>>().join(" "),
    }
}

fn range(parameter: &Parameter) -> String {
    let (least, most) = parameter.range;
    let unit = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
    if least.is_finite() && most.is_finite() { format!("{least} to {most}{unit}") } else { unit.trim().to_owned() }
}

#[test]
fn tables_are_those_of_the_declarations() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let readme = std::fs::read_to_string(&path).unwrap();
    let mut made = readme.clone();
    for (mark, table) in [("procedural", images()), ("presets", gallery()), ("parameters", parameters())] {
        let (begin, end) = (format!("<!-- {mark}: begin -->\n"), format!("<!-- {mark}: end -->"));
        let start = made.find(&begin).unwrap_or_else(|| panic!("README.md has no `{}`", begin.trim())) + begin.len();
        let stop = start + made[start..].find(&end).unwrap_or_else(|| panic!("README.md has no `{end}`"));
        made.replace_range(start..stop, &format!("\n{}\n", table.trim_end()));
    }
    if std::env::var_os("VAIR_BLESS").is_some() {
        std::fs::write(&path, &made).unwrap();
    } else if made != readme {
        let at = made.lines().zip(readme.lines()).position(|(made, found)| made != found).unwrap_or_default();
        let (made, found) = (made.lines().nth(at), readme.lines().nth(at));
        panic!("README.md:{} is not what the declarations say; tools/bless writes it\n{made:?}\n{found:?}", at + 1);
    }
}
