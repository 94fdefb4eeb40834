//! The parts of `docs/reference/command-line.md` that the program writes.

use std::fmt::Write as _;

use clap::{Arg, ArgAction, Command};

use super::help::{EXAMPLES, EXIT_CODES, command};

/// The parts by name, in Markdown.
///
/// - `commands`: all commands with their options and examples; `exit codes`: their table.
#[must_use]
pub fn reference() -> [(&'static str, String); 2] {
    let mut whole = command("cav", &[]);
    whole.build();
    let mut commands = String::new();
    for within in whole.get_subcommands().filter(|within| within.get_name() != "help") {
        written(&mut commands, within, within.get_name());
    }
    [("commands", commands.trim().to_owned()), ("exit codes", exit_codes())]
}

/// One command, and those within it.
fn written(text: &mut String, command: &Command, path: &str) {
    let about = command.get_long_about().or(command.get_about());
    let about = about.map(|about| marked(&about.to_string())).unwrap_or_default();
    let mut command = command.clone();
    let usage = command.render_usage().to_string().replacen("Usage: ", "", 1);
    let usage: Vec<&str> = usage.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let _ =
        write!(text, "### `cav {path}`\n\n{}\n\n```text\n{}\n```\n\n", ended(about.trim()), usage.join("\n"));
    let arguments: Vec<&Arg> = command
        .get_arguments()
        .filter(|argument| !argument.is_hide_set() && argument.get_id() != "help")
        .collect();
    if !arguments.is_empty() {
        *text += "| argument | does | default |\n|---|---|---|\n";
        for argument in arguments {
            let help = argument.get_help().map(|help| marked(&help.to_string())).unwrap_or_default();
            let _ = writeln!(
                text,
                "| {} | {} | {} |",
                named(argument),
                help.replace('|', "\\|"),
                default(argument)
            );
        }
        text.push('\n');
    }
    let examples: Vec<String> = (EXAMPLES.iter().filter(|(of, _, _)| *of == path))
        .map(|(_, typed, what)| {
            format!("cav {}\n    {}", typed.replace("PROGRAM", "cav"), what.replace("PROGRAM", "cav"))
        })
        .collect();
    if !examples.is_empty() {
        let _ = write!(text, "```text\n{}\n```\n\n", examples.join("\n"));
    }
    let within: Vec<Command> =
        command.get_subcommands().filter(|c| c.get_name() != "help").cloned().collect();
    for command in within {
        let path = format!("{path} {}", command.get_name());
        written(text, &command, &path);
    }
}

/// How an argument is typed.
fn named(argument: &Arg) -> String {
    let value =
        argument.get_value_names().and_then(<[_]>::first).map(ToString::to_string).unwrap_or_default();
    let takes_value = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    match (argument.get_long(), argument.get_short()) {
        (Some(long), _) if takes_value => format!("`--{long} {value}`"),
        (Some(long), Some(short)) => format!("`-{short}`, `--{long}`"),
        (Some(long), None) => format!("`--{long}`"),
        _ => format!("`{value}`"),
    }
}

fn default(argument: &Arg) -> String {
    let takes_value = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    let values = argument.get_default_values();
    if !takes_value || values.is_empty() {
        return if argument.is_required_set() { "required".to_owned() } else { String::new() };
    }
    let values: Vec<String> = values.iter().map(|value| format!("`{}`", value.to_string_lossy())).collect();
    values.join(", ")
}

/// A text with options, keys and names in capitals as code.
fn marked(text: &str) -> String {
    text.lines()
        .map(|line| line.split(' ').map(word).collect::<Vec<_>>().join(" "))
        .collect::<Vec<_>>()
        .join("\n")
}

fn word(word: &str) -> String {
    let bare = word.trim_end_matches(['.', ',', ';', ':', ')']).trim_start_matches('(');
    let is_option = bare.len() > 2 && bare.starts_with("--");
    let is_key = (bare.contains('.') || bare.contains('=') || bare.contains('_'))
        && bare.chars().all(|c| c.is_ascii_alphanumeric() || "._=/-".contains(c))
        && bare.chars().filter(|c| c.is_ascii_lowercase()).count() > 3;
    if !(is_option || is_key) || word.contains('`') {
        return word.replace('<', "&lt;");
    }
    word.replacen(bare, &format!("`{bare}`"), 1)
}

/// A text that ends with a full stop, which helps leave out.
fn ended(text: &str) -> String {
    if text.is_empty() || text.ends_with('.') { text.to_owned() } else { format!("{text}.") }
}

fn exit_codes() -> String {
    let mut text = "| code | meaning | what to do |\n|---|---|---|\n".to_owned();
    for (code, meaning, remedy) in EXIT_CODES {
        let _ = writeln!(text, "| {code} | {meaning} | {remedy} |");
    }
    text.trim_end().to_owned()
}
