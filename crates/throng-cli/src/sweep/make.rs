//! Makes the runs that are not finished yet.

use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;
use crate::threads::Workers;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use throng_record::OutputError;
use throng_record::sweep::{FileFingerprints, Fingerprint, Plan, Row, RunFolder, run_one};

/// The number of missing runs that a message names.
const NAMED: usize = 8;

/// What a sweep works with.
pub struct SweepWork<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The folder of finished runs.
    pub folder: &'a RunFolder,
    /// The threads.
    pub workers: &'a Workers,
    /// Whether no progress is shown.
    pub quiet: bool,
}

/// The rows of finished runs.
pub struct Made {
    /// The rows, in the order of the chosen numbers.
    pub rows: Vec<Row>,
    /// The number of runs made now.
    pub made: usize,
    /// The number of runs that were kept before.
    pub kept: usize,
}

/// What became of a run.
enum Ended {
    Made(Row),
    Kept(Row),
    /// The program was interrupted, or another run's result could not be written.
    Missing,
}

impl SweepWork<'_> {
    /// Makes the chosen runs that are not kept, and keeps each as soon as it is finished.
    ///
    /// # Errors
    /// The result of a run cannot be written.
    pub fn make(&self, chosen: &[usize]) -> Result<Made, Failure> {
        let files = FileFingerprints::default();
        let (count, done, broken) = (chosen.len(), AtomicUsize::new(0), AtomicBool::new(false));
        let progress = Progress::new(self.quiet);
        let show = || {
            let done = done.load(Ordering::Relaxed);
            progress.show(done as f64 / count as f64, || format!("{done} of {count} runs"));
        };
        show();
        let goes_on = || !interrupt::asked() && !broken.load(Ordering::Relaxed);
        let work = |index: usize| -> Result<Ended, OutputError> {
            let Some(run) = self.plan.run(index).filter(|_| goes_on()) else { return Ok(Ended::Missing) };
            let fingerprint = Fingerprint::of(&run, &files);
            let ended = match self.folder.row(&run, fingerprint) {
                Some(row) => Ended::Kept(row),
                None => match run_one(&run, goes_on) {
                    Some(row) => {
                        self.folder.keep(&row, fingerprint).inspect_err(|_| broken.store(true, Ordering::Relaxed))?;
                        Ended::Made(row)
                    }
                    None => return Ok(Ended::Missing),
                },
            };
            done.fetch_add(1, Ordering::Relaxed);
            show();
            Ok(ended)
        };
        let ended = self.workers.map(chosen.to_vec(), work);
        progress.done();
        let mut all = Made { rows: Vec::new(), made: 0, kept: 0 };
        for ended in ended {
            match ended? {
                Ended::Made(row) => {
                    all.rows.push(row);
                    all.made += 1;
                }
                Ended::Kept(row) => {
                    all.rows.push(row);
                    all.kept += 1;
                }
                Ended::Missing => {}
            }
        }
        Ok(all)
    }

    /// Reads the chosen runs, all of which must be kept.
    ///
    /// # Errors
    /// A run is not kept.
    pub fn collect(&self, chosen: &[usize]) -> Result<Made, Failure> {
        let found = self.kept(chosen);
        let missing: Vec<usize> =
            chosen.iter().zip(&found).filter(|(_, row)| row.is_none()).map(|(index, _)| *index).collect();
        if missing.is_empty() {
            let rows: Vec<Row> = found.into_iter().flatten().collect();
            return Ok(Made { made: 0, kept: rows.len(), rows });
        }
        let some: Vec<String> = missing.iter().take(NAMED).map(usize::to_string).collect();
        let (some, more) = (some.join(","), if missing.len() > NAMED { " and more" } else { "" });
        let (count, all, folder) = (missing.len(), chosen.len(), self.folder.path().display());
        let text = format!("{count} of {all} runs are not in {folder}: {some}{more}");
        Err(Failure::hint(text, format!("leave out --collect to make all of them, or make some with --index {some}")))
    }

    /// Returns the rows of the chosen runs that are kept.
    pub fn kept(&self, chosen: &[usize]) -> Vec<Option<Row>> {
        let files = FileFingerprints::default();
        let row = |index: usize| {
            let run = self.plan.run(index)?;
            self.folder.row(&run, Fingerprint::of(&run, &files))
        };
        self.workers.map(chosen.to_vec(), row)
    }
}
