//! Shell completions and manual pages, made from the command line's own definition.

use std::io;
use std::path::Path;

use anyhow::Context;
use clap::CommandFactory;
use clap_complete::Shell;

use crate::arguments::Arguments;
use crate::outcome::Outcome;

/// Prints the completion script for `shell`.
pub fn completions(shell: Shell) -> anyhow::Result<Outcome> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "trimloop", &mut script);
    print(&script)
}

/// Prints the manual page, or writes all of them to `folder`.
pub fn pages(folder: Option<&Path>) -> anyhow::Result<Outcome> {
    let Some(folder) = folder else {
        let mut page = Vec::new();
        clap_mangen::Man::new(Arguments::command()).render(&mut page)?;
        return print(&page);
    };
    let shown = folder.display();
    std::fs::create_dir_all(folder).with_context(|| format!("cannot create the folder `{shown}`"))?;
    clap_mangen::generate_to(Arguments::command(), folder)
        .with_context(|| format!("cannot write to `{shown}`"))?;
    Ok(Outcome::Good)
}

/// Prints, and takes a reader that stopped early (`| head`) for what it is.
pub fn print(text: &[u8]) -> anyhow::Result<Outcome> {
    use std::io::Write;
    let mut out = io::stdout().lock();
    match out.write_all(text).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to standard output")
        }
        _ => Ok(Outcome::Good),
    }
}
