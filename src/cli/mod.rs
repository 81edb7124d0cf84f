//! The command line: the only place that prints, and the only one that decides exit statuses.
//!
//! 0 on success, 2 on a command line that cannot be right, 1 on any other failure. A failure is one line on standard
//! error. A reader that closes standard output early ends the program without a complaint.

mod cache;
mod device;
mod devices;
mod families;
mod inspect;
mod output;
mod presets;
mod profile;
mod quality;
mod render;
mod report;
mod scene;
mod sequence;
mod values;
mod verify;

use clap::{CommandFactory, Parser, Subcommand};
use std::panic::{self, AssertUnwindSafe};
use std::process::ExitCode;

/// Exit status of a command line that cannot be right.
const USAGE: u8 = 2;

/// Renders fur and cloth with Vulkan, and says what that cost.
#[derive(Debug, Parser)]
#[command(name = "vair", version, propagate_version = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Renders a glTF file, or the embedded gallery, to PNG or EXR.
    Render(Box<render::RenderArguments>),
    /// Says what a frame will do: passes, pipelines, textures, memory, and what is left out and why.
    Inspect(Box<inspect::InspectArguments>),
    /// Measures error against run time, and writes tables, plots and one page.
    Report(report::ReportArguments),
    /// Evaluates every shader function on the device and compares it with its double-precision twin.
    Verify(verify::VerifyArguments),
    /// Measures a frame: times, fragments and memory.
    Profile(Box<profile::ProfileArguments>),
    /// Lists the Vulkan devices, and why one is refused.
    Devices(devices::DevicesArguments),
    /// Lists the material presets and their parameters.
    Presets(presets::PresetsArguments),
}

/// Options that each make sense and together do not.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct UsageError(&'static str);

/// Parses, runs, and turns the outcome into an exit status.
pub fn run() -> ExitCode {
    // A panic is a defect of ours; whoever meets it still gets one line and status 1.
    panic::set_hook(Box::new(|panic| output::complain(&format!("internal error, please report it: {panic}"))));
    panic::catch_unwind(AssertUnwindSafe(parse_and_run)).unwrap_or(ExitCode::FAILURE)
}

fn parse_and_run() -> ExitCode {
    let outcome = match Arguments::try_parse() {
        Ok(Arguments { command: None }) => output::print(&Arguments::command().render_help().to_string()),
        Ok(Arguments { command: Some(command) }) => match command {
            Command::Render(arguments) => render::run(&arguments),
            Command::Inspect(arguments) => inspect::run(&arguments),
            Command::Report(arguments) => report::run(&arguments),
            Command::Verify(arguments) => verify::run(&arguments),
            Command::Profile(arguments) => profile::run(&arguments),
            Command::Devices(arguments) => devices::run(&arguments),
            Command::Presets(arguments) => presets::run(&arguments),
        },
        Err(error) if error.use_stderr() => {
            output::complain(&usage_in_one_line(&error.render().to_string()));
            return ExitCode::from(USAGE);
        }
        Err(help) => output::print(&help.render().to_string()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            output::complain(&in_one_line(&error));
            ExitCode::from(if error.is::<UsageError>() { USAGE } else { 1 })
        }
    }
}

/// The error and its causes. Many messages hold their cause's already: it is not said twice.
fn in_one_line(error: &anyhow::Error) -> String {
    error.chain().map(ToString::to_string).fold(String::new(), |line, cause| match line {
        line if line.contains(&cause) => line,
        line if line.is_empty() => cause,
        line => format!("{line}: {cause}"),
    })
}

/// The parser's paragraphs as one line, without the parts that repeat `--help`.
fn usage_in_one_line(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines = lines.take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more"));
    // Nobody who mistypes an option means a file of that name.
    let kept: Vec<_> = lines.filter(|line| !line.starts_with("tip: to pass")).collect();
    format!("{}; see --help", kept.join(" ").trim_start_matches("error: "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_declaration_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn usage_errors_are_one_line() {
        let error = Arguments::try_parse_from(["vair", "render", "--msaa", "3"]).unwrap_err();
        let line = usage_in_one_line(&error.render().to_string());
        assert_eq!(line, "invalid value '3' for '--msaa <1/4>' [possible values: 1, 4]; see --help");
    }
}
