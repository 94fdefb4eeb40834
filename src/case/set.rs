//! `--set KEY=VALUE`: changes to a case's text before it is read.

use toml_edit::{DocumentMut, InlineTable, Item, TableLike, Value};

use super::error::CaseError;

/// The text with every change made to it, in order.
pub(super) fn apply(text: &str, sets: &[String]) -> Result<String, Vec<CaseError>> {
    let mut document: DocumentMut = text
        .parse()
        .map_err(|error: toml_edit::TomlError| vec![fault("", format!("not TOML: {error}"), "")])?;
    let mut faults = Vec::new();
    for set in sets {
        if let Err(error) = apply_one(document.as_table_mut(), set) {
            faults.push(error);
        }
    }
    if faults.is_empty() { Ok(document.to_string()) } else { Err(faults) }
}

fn fault(path: &str, message: String, help: &str) -> CaseError {
    CaseError { path: path.to_owned(), message, help: Some(help.to_owned()), span: None }
}

fn apply_one(root: &mut dyn TableLike, set: &str) -> Result<(), CaseError> {
    let Some((path, value)) = set.split_once('=') else {
        let message = format!("`--set {set}` has no `=`");
        return Err(fault("", message, "write --set KEY=VALUE, for instance --set time.cfl=0.4"));
    };
    let path = path.trim();
    let keys: Vec<&str> = path.split('.').map(str::trim).collect();
    if keys.iter().any(|key| key.is_empty()) {
        let message = format!("`--set {set}` has an empty key");
        return Err(fault(path, message, "write the key with dots, for instance fluid.region.0.radius"));
    }
    let value = parse(path, value.trim())?;
    in_table(root, &keys, 0, value)
}

/// A TOML value; what is none is a string, so that names need no quotes.
fn parse(path: &str, text: &str) -> Result<Value, CaseError> {
    match text.parse::<Value>() {
        Ok(value) => Ok(value),
        Err(_) if text.starts_with(['[', '{', '"', '\'']) => {
            let message = format!("--set: `{text}` is no TOML value");
            Err(fault(
                path,
                message,
                "close the brackets and quotes, and mind those that the shell takes away",
            ))
        }
        Err(_) => Ok(Value::from(text)),
    }
}

/// The path down to and with `keys[depth]`.
fn path_to(keys: &[&str], depth: usize) -> String {
    keys[..=depth.min(keys.len() - 1)].join(".")
}

fn in_table(table: &mut dyn TableLike, keys: &[&str], depth: usize, value: Value) -> Result<(), CaseError> {
    let key = keys[depth];
    if depth + 1 == keys.len() {
        table.insert(key, Item::Value(value));
        return Ok(());
    }
    if table.get(key).is_none() {
        if keys[depth + 1].parse::<usize>().is_ok() {
            let message = format!("--set: there is no array `{}`", path_to(keys, depth));
            return Err(fault(&keys.join("."), message, "write the element in the case file"));
        }
        table.insert(key, Item::Value(Value::InlineTable(InlineTable::new())));
    }
    match table.get_mut(key) {
        Some(item) => in_item(item, keys, depth + 1, value),
        None => Ok(()),
    }
}

fn in_item(item: &mut Item, keys: &[&str], depth: usize, value: Value) -> Result<(), CaseError> {
    match item {
        Item::ArrayOfTables(array) => {
            let index = element(keys, depth, array.len())?;
            if depth + 1 == keys.len() {
                let help = format!("set a key of it: {}.KEY=VALUE", keys.join("."));
                return Err(fault(&keys.join("."), "--set: this is a whole table".to_owned(), &help));
            }
            match array.get_mut(index) {
                Some(table) => in_table(table, keys, depth + 1, value),
                None => Ok(()),
            }
        }
        Item::Value(inner) => in_value(inner, keys, depth, value),
        Item::Table(table) => in_table(table, keys, depth, value),
        Item::None => Ok(()),
    }
}

fn in_value(inner: &mut Value, keys: &[&str], depth: usize, value: Value) -> Result<(), CaseError> {
    match inner {
        Value::InlineTable(table) => in_table(table, keys, depth, value),
        Value::Array(array) => {
            let index = element(keys, depth, array.len())?;
            if depth + 1 == keys.len() {
                array.replace(index, value);
                return Ok(());
            }
            match array.get_mut(index) {
                Some(inner) => in_value(inner, keys, depth + 1, value),
                None => Ok(()),
            }
        }
        scalar => {
            let above = path_to(keys, depth - 1);
            let message = format!("--set: `{above}` is {} and has no keys", scalar.to_string().trim());
            let help = format!("set the whole of it: --set '{above}=...', a table as {{ key = value, ... }}");
            Err(fault(&keys.join("."), message, &help))
        }
    }
}

/// The number of an array's element.
fn element(keys: &[&str], depth: usize, len: usize) -> Result<usize, CaseError> {
    let index = keys[depth].parse::<usize>().ok().filter(|index| *index < len);
    index.ok_or_else(|| {
        let above = path_to(keys, depth - 1);
        let message = format!("--set: `{above}` has no element `{}`", keys[depth]);
        let help = match len {
            0 => "it is empty".to_owned(),
            1 => "it has one element, number 0".to_owned(),
            _ => format!("it has {len} elements, numbers 0 to {}", len - 1),
        };
        fault(&keys.join("."), message, &help)
    })
}
