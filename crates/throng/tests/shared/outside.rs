//! Tests that need a program or data from outside the repository: a target with `harness = false` lists them.
//!
//! A test that lacks a program, data or a setting is reported as ignored, with what it needs as its kind: `[needs
//! valgrind]`. Where the environment variable `CI` is set, a test that lacks a program or a setting fails instead: a check that CI does not make
//! is an error. Data beside the repository cannot be installed: where the folder `shared/data` does not exist, tests that
//! need it stay ignored.

use libtest_mimic::{Arguments, Trial};
use std::path::{Path, PathBuf};

/// What a test needs.
#[derive(Clone, Copy, Debug)]
pub enum Need {
    /// A program in one of the folders of `PATH`.
    Program(&'static str),
    /// A file or folder of real inputs, relative to `shared/data`.
    Data(&'static str),
    /// A setting of the build, with its name.
    Build(bool, &'static str),
}

impl Need {
    fn is_met(self) -> bool {
        match self {
            Self::Program(name) => program(name).is_some(),
            Self::Data(name) => found(name).is_some(),
            Self::Build(is_set, _) => is_set,
        }
    }

    fn label(self) -> String {
        match self {
            Self::Program(name) | Self::Build(_, name) => name.to_owned(),
            Self::Data(name) => format!("shared/data/{name}"),
        }
    }
}

/// Returns a test that runs if all its needs are met.
pub fn test(name: &str, needed: &[Need], body: fn()) -> Trial {
    let missing: Vec<String> = needed.iter().filter(|need| !need.is_met()).map(|need| need.label()).collect();
    if missing.is_empty() {
        return Trial::test(name, move || {
            body();
            Ok(())
        });
    }
    let needs = format!("needs {}", missing.join(", "));
    let reason = format!("{needs}, which is missing");
    let can_be_had = |need: &Need| !matches!(need, Need::Data(_)) || found("").is_some();
    let fails = is_ci() && needed.iter().filter(|need| !need.is_met()).any(can_be_had);
    Trial::test(name, move || Err(reason.into())).with_kind(needs).with_ignored_flag(!fails)
}

/// Runs the tests that the arguments of the program select, and exits.
pub fn run(mut tests: Vec<Trial>) -> ! {
    let (filters, rest) = arguments(std::env::args());
    let mut arguments = Arguments::from_iter(rest);
    // the library takes one filter, libtest any number of them
    match &filters[..] {
        [] => {}
        [filter] => arguments.filter = Some(filter.clone()),
        several => tests.retain(|test| {
            several.iter().any(|filter| {
                if arguments.exact { test.name() == filter.as_str() } else { test.name().contains(filter.as_str()) }
            })
        }),
    }
    libtest_mimic::run(&arguments, tests).exit()
}

/// Separates filters from the other arguments, the program's name included.
fn arguments(all: impl IntoIterator<Item = String>) -> (Vec<String>, Vec<String>) {
    const WITH_VALUE: [&str; 6] = ["--test-threads", "--logfile", "--skip", "--color", "--format", "-Z"];
    let mut all = all.into_iter();
    let (mut filters, mut rest) = (vec![], Vec::from_iter(all.next()));
    while let Some(argument) = all.next() {
        if WITH_VALUE.contains(&argument.as_str()) {
            rest.push(argument);
            rest.extend(all.next());
        } else if argument == "--no-capture" {
            rest.push("--nocapture".to_owned());
        } else if argument.starts_with('-') {
            rest.push(argument);
        } else {
            filters.push(argument);
        }
    }
    (filters, rest)
}

/// Whether the tests run in CI, where nothing may be missing.
fn is_ci() -> bool {
    std::env::var_os("CI").is_some_and(|value| !value.is_empty() && value != "false")
}

/// Returns the path of a program in the folders of `PATH`.
pub fn program(name: &str) -> Option<PathBuf> {
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    std::env::split_paths(&std::env::var_os("PATH")?).map(|folder| folder.join(&file)).find(|path| path.is_file())
}

fn found(name: &str) -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().map(|up| up.join("shared/data").join(name)).find(|path| path.exists())
}

/// Returns the path of a file or folder of real inputs.
///
/// # Panics
/// It is missing.
pub fn data(name: &str) -> PathBuf {
    found(name).unwrap_or_else(|| panic!("no shared/data/{name} above {}", env!("CARGO_MANIFEST_DIR")))
}
