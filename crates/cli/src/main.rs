//! The `trimloop` command: CAD files (STEP and IGES) to glTF, what is in them, and how they compare with others.

mod arguments;
mod compare;
mod compare_text;
mod contained;
mod convert;
mod draft;
mod inspect;
mod inspect_text;
mod interrupt;
mod manual;
mod memory;
mod message;
mod outcome;
mod plan;
mod progress;
mod quantity;
mod regress;
mod regress_text;
mod render;
mod report;
mod report_sink;
mod side;
mod summary;
mod tally;
mod threads;
mod view;

use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};
use crate::outcome::Outcome;

fn main() -> ExitCode {
    memory::take_in_bulk();
    let result = match Arguments::parse().command {
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::View(arguments) => view::run(arguments),
        Command::Regress(arguments) => regress::run(&arguments),
        Command::Completions { shell } => manual::completions(shell),
        Command::Man { folder } => manual::pages(folder.as_deref()),
    };
    let outcome = result.unwrap_or_else(|error| {
        eprintln!("error: {}", message::of(&error));
        Outcome::Failed
    });
    ExitCode::from(outcome.code())
}
