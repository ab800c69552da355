//! The files that a run writes.

use crate::failure::Failure;
use std::path::{Path, PathBuf};
use throng_draw::record::{Files, Plan, Recorder};
use throng_draw::sink::Kind;
use throng_draw::{Film, Sheet, Style};
use throng_record::formats::FORMATS;
use throng_record::{Format, Output};

/// Creates the files of a run.
///
/// # Errors
/// The kind of a file does not follow from its name, a name is given twice, a chosen agent, group or column does not
/// exist, or a file cannot be created.
pub fn create(paths: &[PathBuf], plan: &Plan) -> Result<Files, Failure> {
    distinct(paths)?;
    paths.iter().for_each(Output::remove_leftovers);
    let kinds = paths.iter().filter(|path| !path.is_dir()).filter_map(Format::of);
    plan.choice.check(plan.setting, kinds)?;
    let begin = |path: &PathBuf| {
        if path.is_dir() || Format::of(path).is_none() {
            named(path, &written())?;
        }
        Ok::<_, Failure>(Recorder::create(path, plan)?)
    };
    Ok(Files::new(paths.iter().map(begin).collect::<Result<_, _>>()?, plan.pace(), plan.choice).stopped_by(plan.stop))
}

/// Returns the file-name endings of the trajectory formats that can be written.
pub fn written() -> Vec<&'static str> {
    FORMATS.iter().filter(|format| format.is_written()).map(|format| format.ending).collect()
}

/// Returns these endings as a phrase.
pub fn trajectories() -> String {
    let all: Vec<String> = written().iter().map(|ending| format!(".{ending}")).collect();
    let (last, others) = all.split_last().expect("at least one format is written");
    format!("{} or {last}", others.join(", "))
}

/// Checks that no file is named twice.
///
/// # Errors
/// A file is named twice.
pub fn distinct(paths: &[PathBuf]) -> Result<(), Failure> {
    for (index, path) in paths.iter().enumerate() {
        if paths[..index].contains(path) {
            return Err(Failure::hint(format!("{} is given twice", path.display()), "leave one of the two out"));
        }
    }
    Ok(())
}

/// Returns the title of a file: its name without its folders.
pub fn title(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

/// Whether a path has this ending and is not a folder.
pub fn is(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ending)) && !path.is_dir()
}

/// Checks that a name ends like a picture or video; `others` are the other endings the command accepts, for the
/// message.
///
/// # Errors
/// The name has another ending, or names an existing folder without a trailing slash.
fn named(path: &Path, others: &[&str]) -> Result<(), Failure> {
    let slash = path.as_os_str().as_encoded_bytes().last().is_some_and(|&byte| std::path::is_separator(byte.into()));
    if path.is_dir() && !slash {
        let text = format!("cannot write {}: it is a folder", path.display());
        return Err(Failure::hint(text, "end the name in / to write a PNG file for each picture into it"));
    }
    if let Err(throng_draw::Error::Extension { .. }) = Kind::of(path) {
        let text = format!("{}: cannot tell what to write from this name", path.display());
        let (last, others) = others.split_last().unwrap_or((&"csv", &[]));
        let others: String = others.iter().map(|other| format!(", .{other}")).collect();
        return Err(Failure::hint(
            text,
            format!(
                "end it in .mp4, .gif, .png, .svg{others} or .{last}, in another video's ending such as .avi, .mkv or \
                 .webm, or in / for a folder of PNG files"
            ),
        ));
    }
    Ok(())
}

/// Creates a picture or a video; `others` are the other endings the command accepts, for the message.
///
/// # Errors
/// The kind of picture does not follow from the name, or the file cannot be created.
pub fn film(path: &Path, sheet: impl Into<Sheet>, style: &Style, rate: f64, others: &[&str]) -> Result<Film, Failure> {
    named(path, others)?;
    Ok(Film::create(path, sheet, style, rate)?)
}

/// Checks that a path names a single picture, the only output of `command`.
///
/// # Errors
/// The path names something else.
pub fn one_picture(path: &Path, command: &str) -> Result<(), Failure> {
    if matches!(Kind::of(path), Ok(Kind::Png | Kind::Svg)) {
        return Ok(());
    }
    let text = format!("{}: `{command}` draws one picture", path.display());
    Err(Failure::hint(text, "end the name in .png or .svg; `throng run` writes everything else"))
}
