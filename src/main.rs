//! The `vair` program. Everything it can do is in the library; this is its command line.

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
