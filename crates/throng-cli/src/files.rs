//! The files a run writes.

use crate::failure::Failure;
use std::path::{Path, PathBuf};
use throng_draw::record::{Files, Plan, Recorder};
use throng_draw::sink::Kind;
use throng_draw::{Film, Sheet, Style};
use throng_record::formats::FORMATS;
use throng_record::{Format, Output};

/// Begins the files of a run.
///
/// # Errors
/// A name does not say what to write or comes twice, what is chosen is not there, or a file cannot be begun.
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

/// How the names of trajectories end that are written.
pub fn written() -> Vec<&'static str> {
    FORMATS.iter().filter(|format| format.is_written()).map(|format| format.ending).collect()
}

/// The same in words.
pub fn trajectories() -> String {
    let all: Vec<String> = written().iter().map(|ending| format!(".{ending}")).collect();
    let (last, others) = all.split_last().expect("some are written");
    format!("{} or {last}", others.join(", "))
}

/// That no file is named twice.
///
/// # Errors
/// One is.
pub fn distinct(paths: &[PathBuf]) -> Result<(), Failure> {
    for (index, path) in paths.iter().enumerate() {
        if paths[..index].contains(path) {
            return Err(Failure::hint(format!("{} is given twice", path.display()), "leave one of the two out"));
        }
    }
    Ok(())
}

/// What a file is called in titles: its name, without the folders it is in.
pub fn title(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

/// Whether a name has this ending, which files have and folders do not.
pub fn is(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ending)) && !path.is_dir()
}

/// That a name says which picture or video to write; `others` are the endings of what else could have been written.
///
/// # Errors
/// It does not, or names a folder without saying so.
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

/// Begins a picture or a video; `others` are the endings of what else could have been written.
///
/// # Errors
/// The name does not say what to write, or the file cannot be begun.
pub fn film(path: &Path, sheet: impl Into<Sheet>, style: &Style, rate: f64, others: &[&str]) -> Result<Film, Failure> {
    named(path, others)?;
    Ok(Film::create(path, sheet, style, rate)?)
}

/// That a path names a single picture, which is all that `command` writes.
///
/// # Errors
/// It names something else.
pub fn one_picture(path: &Path, command: &str) -> Result<(), Failure> {
    if matches!(Kind::of(path), Ok(Kind::Png | Kind::Svg)) {
        return Ok(());
    }
    let text = format!("{}: `{command}` draws one picture", path.display());
    Err(Failure::hint(text, "end the name in .png or .svg; `throng run` writes everything else"))
}
