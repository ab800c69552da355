//! Tests that every target keeps its limits on its corpus and on some mutants, and that the driver detects every kind
//! of broken limit.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use throng_fuzz::corpus::{self, Sample};
use throng_fuzz::{TARGETS, Target};

/// Number of mutants per target.
const MUTANTS: &str = "100";

fn fuzz(out: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_throng-fuzz"));
    command.args(words).arg("--out").arg(out).output().expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn all_targets_keep_their_limits() {
    // inputs that break a limit stay in this folder
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    let output = fuzz(&out, &["--count", MUTANTS, "--jobs", "2"]);
    assert!(output.status.success(), "{}{}", text(&output.stdout), text(&output.stderr));
    let lines = text(&output.stdout).lines().count();
    assert_eq!(lines, 1 + TARGETS.len(), "{}", text(&output.stdout));
}

#[test]
fn every_target_reads_whole_files() {
    for target in TARGETS {
        let own = corpus::folder(target);
        let samples = corpus::of(target).unwrap();
        for Sample { name, bytes } in &samples {
            let broken = name.starts_with("found-") || name.starts_with("hostile-");
            // files from elsewhere have their own tests
            if !broken && own.join(name).exists() {
                (target.run)(bytes).unwrap_or_else(|error| panic!("{}/{name}: {error}", target.name));
            }
        }
        let whole = samples.iter().any(|sample| (target.run)(&sample.bytes).is_ok());
        assert!(whole, "{} accepts no file of its corpus", target.name);
    }
}

#[test]
fn the_corpus_is_small() {
    let mut total = 0;
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/corpus")).unwrap() {
        let folder = entry.unwrap().path();
        if !folder.is_dir() {
            continue;
        }
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        assert!(Target::named(&name).is_some(), "corpus/{name} belongs to no target");
        for file in std::fs::read_dir(&folder).unwrap() {
            let file = file.unwrap();
            let size = file.metadata().unwrap().len();
            assert!(size < 50_000, "{} has {size} bytes", file.path().display());
            total += size;
        }
    }
    assert!(total < 1_000_000, "the corpus has {total} bytes");
}

#[test]
fn every_kind_of_broken_limit_is_detected() {
    let folder = tempfile::tempdir().unwrap();
    let run = |what: &str| {
        let input = folder.path().join(what);
        std::fs::write(&input, what).unwrap();
        let words = ["faulty", "--input", input.to_str().unwrap(), "--max-seconds", "1"];
        let output = fuzz(&folder.path().join("out"), &words);
        (output.status.code(), text(&output.stdout))
    };
    for fine in ["go", "refuse"] {
        let (code, said) = run(fine);
        assert_eq!(code, Some(0), "{fine}: {said}");
    }
    for (what, words) in [
        ("panic", "on purpose"),
        ("ramble", "6000 characters"),
        ("abort", "the process ended with signal"),
        ("memory", "memory allocation of 4294967296 bytes failed"),
        ("stack", "has overflowed its stack"),
        ("time", "no end after"),
    ] {
        let (code, said) = run(what);
        assert_eq!(code, Some(1), "{what}: {said}");
        assert!(said.contains(words) && said.contains("1 inputs broke a limit"), "{what}: {said}");
    }
}

#[test]
fn another_worker_continues_after_an_input_that_ended_one() {
    let folder = tempfile::tempdir().unwrap();
    let output = fuzz(folder.path(), &["faulty", "--count", "0"]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    // abort, fine, panic, stack
    assert!(said.contains("3 inputs broke a limit"), "{said}");
    for (number, what) in ["abort", "fine", "panic", "stack"].iter().enumerate() {
        let kept = folder.path().join(format!("faulty-1-{number}.txt"));
        assert_eq!(kept.exists(), *what != "fine", "{what}: {said}");
        assert!(!kept.exists() || std::fs::read_to_string(kept).unwrap() == *what);
    }
}

#[test]
fn unknown_targets_are_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let output = fuzz(folder.path(), &["no-such-target"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("there is no target or group `no-such-target`"), "{}", text(&output.stderr));
}
