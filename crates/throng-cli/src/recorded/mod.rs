//! `throng convert` and `throng render`: write recorded trajectories in other formats, or draw them.

pub mod args;
mod recording;

use crate::failure::Failure;
use crate::files;
use crate::interrupt;
use crate::out::{Out, complain, note};
use crate::progress::Progress;
use crate::tracks::limit;
use args::{ConvertArgs, RenderArgs};
use recording::Recording;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use throng_draw::record::Plan;
use throng_draw::{Projection, Still, Style, WorldBox};
use throng_record::people::Walks;
use throng_record::{Choice, Format};

/// Converts trajectories to other files.
///
/// # Errors
/// The trajectories cannot be read, a file cannot be written, or a chosen agent, group or column does not exist.
pub fn convert(args: &ConvertArgs, out: &mut Out) -> Result<(), Failure> {
    if let Some(path) = args.output.iter().find(|path| Format::of(path).is_none_or(|format| !format.is_written())) {
        let text = format!("{}: cannot tell from this name which trajectories to write", path.display());
        let hint = format!("end it in {}; `throng render` draws pictures and video", files::trajectories());
        return Err(Failure::hint(text, hint));
    }
    let recording = Recording::open(&args.recorded, args.quiet)?;
    if !args.quiet {
        note(&recording.notes);
    }
    let (choice, style) = (args.choice.choice(), Style::default());
    let setting = &recording.moments.setting;
    let from = recording.start(&choice);
    let plan = Plan {
        setting,
        sheet: None,
        style: &style,
        rate: 25.0,
        speed_up: 1.0,
        still: Still::Last,
        from,
        choice: &choice,
        stop: interrupt::asked,
    };
    write(&recording, &args.output, &plan, args.quiet, out)
}

/// Draws trajectories.
///
/// # Errors
/// The trajectories cannot be read, a file cannot be written, or a chosen agent or group does not exist.
pub fn render(args: &RenderArgs, out: &mut Out) -> Result<(), Failure> {
    let mut recording = Recording::open(&args.recorded, args.quiet)?;
    if !args.quiet {
        note(&recording.notes);
    }
    let choice = args.choice.choice();
    let [min, max] = recording.bounds();
    let mut style = args.film.style(&recording.scene, [min, max])?;
    if style.projection(&recording.moments.setting) == Projection::Perspective && style.people {
        recording.moments.setting.walks = Walks::of(&recording.moments).map(Arc::new);
    }
    // The view holds all positions of the recording from the first picture on.
    style.view.get_or_insert(WorldBox { min, max });
    let plan = Plan {
        setting: &recording.moments.setting,
        sheet: None,
        style: &style,
        rate: args.film.rate(&recording.scene),
        speed_up: args.film.speed_up,
        still: args.film.still(),
        from: recording.start(&choice),
        choice: &choice,
        stop: interrupt::asked,
    };
    let own = [PathBuf::from(format!("{}.mp4", recording.name))];
    let paths = if args.output.is_empty() { &own[..] } else { &args.output };
    write(&recording, paths, &plan, args.quiet, out)
}

/// Writes the moments of a recording.
fn write(recording: &Recording, paths: &[PathBuf], plan: &Plan, quiet: bool, out: &mut Out) -> Result<(), Failure> {
    recording.spans(plan.choice)?;
    if paths.iter().any(|path| Format::of(path).is_none()) {
        recording.lasts(plan)?;
    }
    if let Some(path) = paths.iter().find(|path| recording.is(path)) {
        let text = format!("{} is the file that is read", path.display());
        return Err(Failure::hint(text, "write under another name"));
    }
    interrupt::watch();
    let mut files = files::create(paths, plan)?;
    let progress = Progress::new(quiet);
    let moments = &recording.moments;
    let mut last = 0;
    for k in 0..moments.count() {
        if interrupt::asked() {
            break;
        }
        let time = moments.time(k);
        let step = if k + 1 < moments.count() { moments.time(k + 1) - time } else { moments.period() };
        files.push(time, step, |frame| moments.capture(k, frame))?;
        last = k;
        progress.show(k as f64 / moments.count() as f64, || format!("{time:.1} s"));
    }
    progress.done();
    files.finish(moments.time(last), |frame| moments.capture(last, frame))?;
    if !quiet {
        paths.iter().try_for_each(|path| out.line(format_args!("wrote {}", path.display())))?;
    }
    if interrupt::asked() {
        complain(&format!("interrupted at {:.2} s; the files cover the time until then", moments.time(last)));
        return Err(Failure::Interrupted);
    }
    Ok(())
}

impl Recording {
    /// Returns the time of the first picture, seconds.
    fn start(&self, choice: &Choice) -> f64 {
        choice.from.max(self.moments.time(0))
    }

    /// Checks that the choice overlaps the recording and does not have too many moments.
    fn spans(&self, choice: &Choice) -> Result<(), Failure> {
        let (first, last) = (self.moments.time(0), self.moments.time(self.moments.count()));
        if choice.from > last || choice.to < first || choice.from > choice.to {
            let text = format!("the recording has no moment from {:.2} to {:.2} s", choice.from.max(0.0), choice.to);
            return Err(Failure::hint(text, format!("it covers {first:.2} to {last:.2} s")));
        }
        let within = [choice.from.max(first), choice.to.min(last)];
        let count = choice.rate.unwrap_or_default() * (within[1] - within[0]);
        limit(
            &self.path,
            "moments of --rate",
            count,
            within,
            "write a lower rate, or choose a part with --from and --to",
        )
    }

    /// Checks that the number of pictures is within the limit.
    fn lasts(&self, plan: &Plan) -> Result<(), Failure> {
        let within = [plan.from, self.moments.time(self.moments.count()).min(plan.choice.to)];
        let count = (within[1] - within[0]) * plan.rate / plan.speed_up;
        let hint = "choose a part with --from and --to, a lower --fps or a higher --speed-up";
        limit(&self.path, "pictures", count, within, hint)
    }

    /// Whether the recording was read from this file.
    fn is(&self, path: &Path) -> bool {
        path.canonicalize().is_ok_and(|path| self.path.canonicalize().is_ok_and(|own| own == path))
    }
}
