//! `throng sheet`: a contact sheet with a still of each of many scenes.

pub mod args;
pub mod pick;
mod still;

use crate::failure::Failure;
use crate::files::one_picture;
use crate::interrupt;
use crate::out::{Out, note};
use crate::progress::Progress;
use crate::threads::Workers;
use args::SheetArgs;
use std::sync::atomic::{AtomicUsize, Ordering};
use still::{Look, still};
use throng_draw::Contact;

/// Runs the scenes to their moments and draws the contact sheet.
///
/// # Errors
/// A scene does not exist or cannot be built, the picture cannot be written, or the program was interrupted.
pub fn sheet(args: &SheetArgs, out: &mut Out) -> Result<(), Failure> {
    one_picture(&args.output, "sheet")?;
    let (sections, scenes) = pick::pick(&args.scenes)?;
    if !args.quiet {
        note(scenes.iter().flat_map(|loaded| &loaded.notes));
    }
    let widest = sections.iter().map(|section| section.names.len()).max().unwrap_or(1);
    let contact = Contact::create(&args.output, &sections, args.width, usize::from(args.columns).min(widest))?;
    let look = Look {
        panel: contact.panel(),
        at: args.at,
        trails: args.trails,
        projection: args.projection,
        field: args.field.clone(),
    };
    interrupt::watch();
    let (count, done, progress) = (scenes.len(), AtomicUsize::new(0), Progress::new(args.quiet));
    let work = |loaded| {
        let still = still(&loaded, &look);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress.show(done as f64 / count as f64, || format!("{done} of {count} scenes"));
        still
    };
    let stills = Workers::new(args.threads.count(), count)?.map(scenes, work);
    progress.done();
    contact.finish(stills.into_iter().collect::<Result<_, Failure>>()?)?;
    out.line(format_args!("wrote {}", args.output.display()))
}
