//! The command line: the only place that prints, and the only one that decides exit statuses.
//!
//! 0 on success, 2 on bad usage, 1 on any other failure with one line on standard error.

mod devices;
mod inspect;
mod json;
mod presets;
mod render;
mod scene;
mod values;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Renders fur and cloth with Vulkan, and says what that cost.
#[derive(Debug, Parser)]
#[command(name = "vair", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Renders a glTF file, or the embedded gallery, to PNG or EXR.
    Render(render::RenderArguments),
    /// Says what a frame will do: passes, pipelines, textures, memory, and what is left out and why.
    Inspect(inspect::InspectArguments),
    /// Lists the Vulkan devices, and why one is refused.
    Devices(devices::DevicesArguments),
    /// Lists the material presets and their parameters.
    Presets(presets::PresetsArguments),
}

/// Parses, runs, and turns the outcome into an exit status.
pub fn run() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Prints help to stdout and mistakes to stderr; a closed pipe is no failure of ours.
            let _ = error.print();
            return if error.use_stderr() { ExitCode::from(2) } else { ExitCode::SUCCESS };
        }
    };
    let outcome = match arguments.command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Devices(arguments) => devices::run(&arguments),
        Command::Presets(arguments) => presets::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // One line, whatever the causes hold.
            let text = format!("{error:#}").split_whitespace().collect::<Vec<_>>().join(" ");
            eprintln!("vair: {text}");
            ExitCode::FAILURE
        }
    }
}
