//! The command line with examples in its helps.

use clap::{Command, CommandFactory};

use super::Cli;

/// What a program's end says of it: the code, what it means, what to do about it.
pub(super) const EXIT_CODES: [(u8, &str, &str); 7] = [
    (0, "done", ""),
    (
        2,
        "bad input: the command line, the case, a directory or a checkpoint that cannot be used",
        "the message names the key and the remedy",
    ),
    (
        3,
        "numerical failure: a state that is not physical, a time step that collapsed",
        "look at the last snapshot, try a smaller `time.cfl`",
    ),
    (
        4,
        "coupling failure: the peer was lost, did not come, has another case, sent what makes no sense",
        "the message and the `log` name the cause",
    ),
    (
        5,
        "output or a checkpoint could not be written, or a grid has grown beyond the memory that is left",
        "free some space or memory, `--resume`",
    ),
    (130, "interrupted (SIGINT, Ctrl-C)", "`--resume`"),
    (143, "terminated (SIGTERM)", "`--resume`"),
];

/// Commands, what is typed after the program's name, and what it does. A command of a command is joined by a space.
pub(super) const EXAMPLES: [(&str, &str, &str); 28] = [
    ("run", "run cases/collapse.toml", "the first case, ten seconds"),
    (
        "run",
        "run cases/collapse.toml --set fluid.region.0.radius=2e-3 --out runs/larger",
        "with another radius",
    ),
    ("run", "run cases/collapse.toml --refine 3", "on three grids: how sure are its numbers?"),
    ("run", "run --resume runs/collapse", "go on after Ctrl-C, a crash or a full disk"),
    (
        "new",
        "new collapse --radius 1mm --pressure 10bar --stand-off 1.2 --wall steel > mine.toml",
        "a case of your own",
    ),
    (
        "new collapse",
        "new collapse --stand-off 1.1 --wall copper > mine.toml",
        "then: check mine.toml, run mine.toml",
    ),
    ("new free", "new free --radius 0.5mm > mine.toml", "then: check mine.toml, run mine.toml"),
    ("new laser", "new laser > mine.toml", "then: check mine.toml, run mine.toml"),
    ("new shock", "new shock --amplitude 50MPa > mine.toml", "then: check mine.toml, run mine.toml"),
    (
        "new load",
        "new load --amplitude 2GPa --wall steel > mine.toml",
        "then: check mine.toml, run mine.toml",
    ),
    ("check", "check cases/collapse.toml", "what it is and costs"),
    ("check", "check cases/collapse.toml --set fluid.levels=6 --png start.png", "with finer cells, drawn"),
    ("keys", "keys", "all keys, one line each"),
    ("keys", "keys fluid.boundary", "one table in full"),
    ("keys", "keys epsilon", "every key of that name"),
    ("fluid", "fluid cases/dickopp2012-coarse.toml --run demo", "in the first terminal"),
    ("fluid", "solid cases/dickopp2012-coarse.toml --run demo", "in the second"),
    ("solid", "fluid cases/dickopp2012-coarse.toml --run demo", "in the first terminal"),
    ("solid", "solid cases/dickopp2012-coarse.toml --run demo", "in the second"),
    ("materials", "materials", "all materials with their sources"),
    ("list", "list runs", "all runs below a folder"),
    ("watch", "watch runs/collapse", "a run that is under way, or has ended"),
    ("completions", "completions bash ~/.local/share/bash-completion/completions", "for every new bash"),
    ("completions", "completions zsh > _PROGRAM", "a file for a directory of zsh's fpath"),
    ("completions", "completions fish ~/.config/fish/completions", "for every new fish"),
    ("man", "man ~/.local/share/man/man1", "then: man PROGRAM-run"),
    ("", "run cases/collapse.toml", "a bubble collapses above aluminium: ten seconds"),
    ("", "run --help", "the options of a command"),
];

/// The command line of a program of this name, with examples, and with the commands that somebody else does for it.
pub(super) fn command(name: &str, others: &[(String, String)]) -> Command {
    let mut command = Cli::command().name(name.to_owned()).bin_name(name);
    let mut codes = vec!["Exit codes:".to_owned()];
    codes.extend(EXIT_CODES.iter().map(|(code, meaning, _)| format!("  {code:<4} {meaning}")));
    let own = examples(name, "").unwrap_or_default();
    command = command.after_help(format!("{own}\n\n{}", codes.join("\n")));
    for (other, about) in others {
        command = command.subcommand(Command::new(other.clone()).about(about.clone()));
    }
    with_examples(command, name, "")
}

/// A command with examples to all commands within it.
fn with_examples(mut command: Command, program: &str, path: &str) -> Command {
    let names: Vec<String> = command.get_subcommands().map(|within| within.get_name().to_owned()).collect();
    for name in names {
        let path = format!("{path} {name}").trim_start().to_owned();
        command = command.mut_subcommand(name, |within| {
            let within = match examples(program, &path) {
                Some(examples) => within.after_help(examples),
                None => within,
            };
            with_examples(within, program, &path)
        });
    }
    command
}

/// The examples of a command as its help has them.
fn examples(program: &str, path: &str) -> Option<String> {
    let lines: Vec<String> = (EXAMPLES.iter().filter(|(of, _, _)| *of == path))
        .map(|(_, typed, what)| {
            format!(
                "  {program} {}\n      {}",
                typed.replace("PROGRAM", program),
                what.replace("PROGRAM", program)
            )
        })
        .collect();
    let head = if lines.len() > 1 { "Examples:" } else { "Example:" };
    (!lines.is_empty()).then(|| format!("{head}\n{}", lines.join("\n")))
}

#[cfg(test)]
mod tests {
    use clap::FromArgMatches;

    use super::*;

    /// All commands with their paths.
    fn all(command: &Command, path: &str, found: &mut Vec<(String, Command)>) {
        for within in command.get_subcommands() {
            let path = format!("{path} {}", within.get_name()).trim_start().to_owned();
            found.push((path.clone(), within.clone()));
            all(within, &path, found);
        }
    }

    #[test]
    fn every_command_has_an_example_that_is_understood() {
        let command = command("cav", &[]);
        command.clone().debug_assert();
        let mut commands = Vec::new();
        all(&command, "", &mut commands);
        assert!(commands.len() > 10);
        for (path, command) in &commands {
            let help = command.clone().render_help().to_string();
            assert!(help.contains("Example"), "cav {path} --help has no example");
            for argument in command.get_arguments() {
                assert!(argument.get_help().is_some(), "cav {path}: {} says nothing", argument.get_id());
            }
        }
        for (path, typed, _) in EXAMPLES {
            let is_there = commands.iter().any(|(known, _)| known == path) || path.is_empty();
            // Up to what the shell does with the output.
            let words = typed.split(" > ").next().unwrap_or("").split_whitespace();
            let matched = command.clone().try_get_matches_from(std::iter::once("cav").chain(words));
            let is_understood = matched.is_ok_and(|matches| Cli::from_arg_matches(&matches).is_ok());
            assert!(!is_there || is_understood || typed.ends_with("--help"), "cav {typed}");
        }
    }

    #[test]
    fn the_name_of_the_program_and_its_own_commands_are_in_the_help() {
        let others = [("report".to_owned(), "Write a page".to_owned())];
        let mut command = command("pycav", &others);
        let help = command.render_help().to_string();
        for part in
            ["Usage: pycav", "report", "Write a page", "pycav run cases/collapse.toml", "Exit codes:", "143"]
        {
            assert!(help.contains(part), "no `{part}` in {help}");
        }
        // Pages of the manual are called by it.
        assert_eq!(command.get_name(), "pycav");
        let run = command.find_subcommand_mut("run").expect("run").render_help().to_string();
        assert!(run.contains("pycav run --resume") && !run.contains("Exit codes"), "{run}");
    }
}
