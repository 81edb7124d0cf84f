//! The JSON schema of look files, made from the declarations of the parameters: editors complete and check with it.

use super::kind::Form;
use super::parameter::{Parameter, ParameterSet};
use super::{KINDS, Standard, presets, procedural};
use crate::asset::MAX_UV_SETS;
use serde_json::{Map, Value, json};

/// The JSON schema (draft 2020-12) of a look file, read as the JSON that its TOML stands for. The keys of one material
/// are also those of `extras.vair` and `extensions.VAIR_material` in glTF.
pub fn look_schema() -> Value {
    let surface = properties(Standard::PARAMETERS);
    // A key that several kinds have means the material's own.
    let mut meanings: Map<String, Value> = Map::new();
    for (name, meaning) in KINDS.iter().flat_map(|(_, list)| properties(list)) {
        let known = meanings.entry(name).or_insert_with(|| json!([]));
        if let Some(known) = known.as_array_mut().filter(|known| !known.contains(&meaning)) {
            known.push(meaning);
        }
    }
    let one_or_any = |(name, meanings): (String, Value)| match meanings.as_array().map(Vec::as_slice) {
        Some([one]) => (name, one.clone()),
        _ => (name, json!({ "anyOf": meanings })),
    };
    let mut keys: Map<String, Value> = meanings.into_iter().map(one_or_any).collect();
    keys.insert("preset".to_owned(), json!({ "enum": preset_names(), "description": "Where the other keys start." }));
    keys.insert("kind".to_owned(), json!({ "enum": KINDS.iter().map(|(kind, _)| *kind).collect::<Vec<_>>() }));
    let surface_text = "Keys of the surface under fur.";
    keys.insert(
        "surface".to_owned(),
        json!({ "type": "object", "properties": surface, "additionalProperties": false, "description": surface_text }),
    );
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "vair look",
        "description": "Materials by glTF material name; \"*\" is every material, and is applied first.",
        "type": "object",
        "properties": { "material": { "type": "object", "additionalProperties": { "$ref": "#/$defs/material" } } },
        "additionalProperties": false,
        "$defs": {
            "material": { "type": "object", "properties": keys, "additionalProperties": false },
            "texture": texture(),
        },
    })
}

/// As they are listed, and as a command line would rather have them.
fn preset_names() -> Vec<String> {
    let mut names: Vec<String> = presets().iter().flat_map(|p| [p.name.clone(), p.hyphenated()]).collect();
    names.dedup();
    names
}

fn properties(parameters: &[Parameter]) -> Map<String, Value> {
    parameters.iter().map(|parameter| (parameter.name.to_owned(), property(parameter))).collect()
}

fn property(parameter: &Parameter) -> Value {
    let number = |kind: &str| {
        let mut number = json!({ "type": kind });
        for (key, bound) in [("minimum", parameter.range.0), ("maximum", parameter.range.1)] {
            if bound.is_finite() {
                number[key] = if bound.fract() == 0.0 { json!(bound as i64) } else { json!(bound) };
            }
        }
        number
    };
    let list = |least: usize, most: usize| json!({ "type": "array", "items": number("number"), "minItems": least, "maxItems": most });
    let hexadecimal = |pattern: &str| json!({ "type": "string", "pattern": pattern });
    let mut property = match parameter.form {
        Form::Number => number("number"),
        Form::Count => number("integer"),
        Form::Switch => json!({ "type": "boolean" }),
        Form::Vector(length) => list(length, length),
        Form::Rgb => json!({ "anyOf": [list(3, 3), hexadecimal("^#[0-9a-fA-F]{6}$")] }),
        Form::Rgba => json!({ "anyOf": [list(3, 4), hexadecimal("^#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?$")] }),
        Form::Distance => json!({ "anyOf": [number("number"), { "type": "string", "pattern": "%\\s*$" }] }),
        Form::Map => json!({ "$ref": "#/$defs/texture" }),
        Form::Choice => json!({ "enum": parameter.choices }),
    };
    let unit = if parameter.unit.is_empty() { String::new() } else { format!(" Unit: {}.", parameter.unit) };
    property["description"] = format!("{}{unit} Default: {}.", parameter.help, (parameter.default)()).into();
    property
}

fn texture() -> Value {
    let pair = json!({
        "anyOf": [
            { "type": "number" },
            { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 },
        ],
    });
    json!({
        "anyOf": [
            { "type": "string", "description": "A PNG or JPEG file in the folder of the look or scene." },
            {
                "type": "object",
                "properties": {
                    "file": { "type": "string" },
                    "procedural": { "enum": procedural::names().collect::<Vec<_>>() },
                    "tiling": pair,
                    "offset": pair,
                    "rotation": { "type": "number", "description": "Degrees." },
                    "uv_set": { "type": "integer", "minimum": 0, "maximum": MAX_UV_SETS - 1 },
                },
                "additionalProperties": false,
            },
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_has_its_place() {
        let schema = look_schema();
        let keys = &schema["$defs"]["material"]["properties"];
        for parameter in KINDS.iter().flat_map(|(_, list)| *list) {
            assert!(keys[parameter.name].is_object(), "{}", parameter.name);
        }
        for parameter in Standard::PARAMETERS {
            assert!(keys["surface"]["properties"][parameter.name].is_object(), "{}", parameter.name);
        }
        assert_eq!(keys["layers"]["minimum"], 1);
        assert_eq!(keys["layers"]["maximum"], 256);
        assert_eq!(keys["layers"]["type"], "integer");
        assert_eq!(keys["distribution_map"]["$ref"], "#/$defs/texture");
        assert_eq!(keys["shape"]["enum"], json!(["cone", "paraboloid"]));
    }
}
