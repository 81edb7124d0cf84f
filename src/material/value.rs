//! Values as look files (TOML) and glTF extras (JSON) hold them, before a parameter has judged them.

use toml::de::DeValue;

/// A value of a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// JSON null, or a TOML date: fits no parameter.
    Other(&'static str),
    /// true, false.
    Switch(bool),
    /// Any number.
    Number(f64),
    /// Text.
    Text(String),
    /// `[...]`.
    List(Vec<Value>),
    /// `{...}`, in the order of the file.
    Table(Vec<(String, Value)>),
}

impl Value {
    /// What it is, for messages.
    pub fn kind(&self) -> String {
        match self {
            Self::Other(what) => (*what).to_owned(),
            Self::Switch(value) => value.to_string(),
            Self::Number(value) => value.to_string(),
            Self::Text(text) => format!("{text:?}"),
            Self::List(items) => format!("a list of {}", items.len()),
            Self::Table(_) => "a table".to_owned(),
        }
    }
}

impl From<&serde_json::Value> for Value {
    fn from(value: &serde_json::Value) -> Self {
        use serde_json::Value as Json;
        match value {
            Json::Null => Self::Other("null"),
            Json::Bool(value) => Self::Switch(*value),
            Json::Number(value) => value.as_f64().map_or(Self::Other("a number out of reach"), Self::Number),
            Json::String(text) => Self::Text(text.clone()),
            Json::Array(items) => Self::List(items.iter().map(Self::from).collect()),
            Json::Object(entries) => Self::Table(entries.iter().map(|(key, v)| (key.clone(), v.into())).collect()),
        }
    }
}

impl From<&DeValue<'_>> for Value {
    fn from(value: &DeValue<'_>) -> Self {
        match value {
            DeValue::String(text) => Self::Text(text.to_string()),
            DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix())
                .map_or(Self::Other("a number out of reach"), |number| Self::Number(number as f64)),
            DeValue::Float(number) => {
                number.as_str().parse().map_or(Self::Other("a number out of reach"), Self::Number)
            }
            DeValue::Boolean(value) => Self::Switch(*value),
            DeValue::Datetime(_) => Self::Other("a date"),
            DeValue::Array(items) => Self::List(items.iter().map(|item| item.get_ref().into()).collect()),
            DeValue::Table(entries) => {
                Self::Table(entries.iter().map(|(key, v)| (key.get_ref().to_string(), v.get_ref().into())).collect())
            }
        }
    }
}

/// As a look file writes it.
impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let joined = |items: Vec<String>| items.join(", ");
        match self {
            Self::List(items) => write!(f, "[{}]", joined(items.iter().map(Self::to_string).collect())),
            Self::Table(entries) => {
                write!(f, "{{ {} }}", joined(entries.iter().map(|(key, value)| format!("{key} = {value}")).collect()))
            }
            Self::Other(_) | Self::Switch(_) | Self::Number(_) | Self::Text(_) => f.write_str(&self.kind()),
        }
    }
}

impl From<&Value> for serde_json::Value {
    fn from(value: &Value) -> Self {
        match value {
            Value::Other(_) => Self::Null,
            Value::Switch(value) => (*value).into(),
            Value::Number(value) => (*value).into(),
            Value::Text(text) => text.clone().into(),
            Value::List(items) => items.iter().map(Self::from).collect(),
            Value::Table(entries) => entries.iter().map(|(key, value)| (key.clone(), Self::from(value))).collect(),
        }
    }
}
