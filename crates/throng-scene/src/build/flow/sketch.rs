//! Fields through anchors.

use super::{At, Made, Make};
use crate::build::limits::{Limit, check};
use crate::file::Problem;
use crate::geometry::DVec2;
use crate::scene::flow::{Kernel, Sketch, StampKind};
use std::sync::Arc;
use throng::field::{self, Anchor, Anchors, Critical, Field, Note, Sampled, erase};

/// Metres beyond the hull at which 1/e is left, where nothing is said.
const FADE: f64 = 10.0;
/// Metres a second along a stroke, where nothing is said: a walk.
pub(super) const SPEED: f64 = 1.3;
/// How much faster than the fastest anchor the field may be, where nothing is said.
const FASTER: f64 = 1.5;
/// Traps that are told one by one.
const TOLD: usize = 3;

impl Make for Sketch {
    fn make(&self, at: &At) -> Result<Made, Problem> {
        let anchors = self.all(at)?;
        let fastest = anchors.iter().map(|anchor| anchor.velocity.length()).fold(0.0, f64::max);
        let sketch = field::Sketch {
            kernel: match &self.kernel {
                Some(Kernel::Wendland(kernel)) => field::Kernel::Wendland { reach: kernel.reach },
                Some(Kernel::ThinPlate(_)) | None => field::Kernel::ThinPlate,
            },
            smoothing: self.smoothing.unwrap_or(0.0),
            fade: Some(self.fade.unwrap_or(FADE)),
            max_speed: self.max_speed.unwrap_or(if fastest > 0.0 { FASTER * fastest } else { 1.0 }),
        };
        let made = Anchors::new(&anchors, sketch).map_err(|error| at.refused(&error))?;
        for note in made.notes() {
            at.note(match note {
                Note::Empty => "it has no anchors, and says nothing anywhere".to_owned(),
                Note::OnePlace => "all its anchors are in one place: it says the same everywhere round it".to_owned(),
                Note::OnLine => "all its anchors are on one line: it says the same on both sides of it".to_owned(),
                Note::Shared(count) => {
                    format!("{count} of its anchors share their place with another: it has their mean there")
                }
                note => format!("{note:?}"),
            });
        }
        // as far as it says anything
        let reach = match &self.kernel {
            Some(Kernel::Wendland(kernel)) => kernel.reach,
            Some(Kernel::ThinPlate(_)) | None => 3.0 * sketch.fade.unwrap_or(FADE),
        };
        let places = anchors.iter().map(|anchor| anchor.place);
        let [low, high] = crate::geometry::bounds(places).unwrap_or_default();
        let field = at.sampled(&made, [low - reach, high + reach], self.cell)?;
        note_traps(at, &field);
        Ok(Made { field: Arc::new(field), anchors })
    }
}

/// Tells where who follows a field would be trapped.
fn note_traps(at: &At, field: &Sampled) {
    let points = field.critical_points();
    let traps: Vec<_> = points.iter().filter(|point| point.kind.traps()).collect();
    for trap in traps.iter().take(TOLD) {
        let place = trap.place + at.origin;
        let kind = if trap.kind == Critical::Sink { "leads to" } else { "goes round and round" };
        at.note(format_args!("it {kind} ({:.1}, {:.1}): who follows it does not get out", place.x, place.y));
    }
    if traps.len() > TOLD {
        at.note(format_args!("and so it does at {} other places", traps.len() - TOLD));
    }
}

impl Sketch {
    /// What is left of all anchors.
    fn all(&self, at: &At) -> Result<Vec<Anchor>, Problem> {
        let mut all = vec![];
        for (i, anchor) in self.anchors.iter().flatten().enumerate() {
            let at = at.key("anchors").index(i);
            let velocity = anchor.velocity;
            velocity
                .iter()
                .enumerate()
                .try_for_each(|(i, x)| check(&at.path.key("velocity").index(i), *x, Limit::Between(-1000.0, 1000.0)))?;
            let (place, stretch) = (at.place("at", anchor.at)?, anchor.stretch.unwrap_or(1.0));
            check(&at.path.key("stretch"), stretch, Limit::Between(1.0, 100.0))?;
            all.push(Anchor { place, velocity: DVec2::from_array(velocity), stretch });
        }
        for (i, stroke) in self.strokes.iter().flatten().enumerate() {
            let at = at.key("strokes").index(i);
            let speed = stroke.speed.unwrap_or(SPEED);
            check(&at.path.key("speed"), speed, Limit::Between(-1000.0, 1000.0))?;
            let made = field::Stroke {
                points: at.places("points", &stroke.points)?,
                speed,
                spacing: stroke.spacing.unwrap_or(field::Stroke::default().spacing),
                stretch: stroke.stretch.unwrap_or(1.0),
            };
            all.extend(made.anchors().map_err(|error| at.refused(&error))?);
        }
        for (i, stamp) in self.stamps.iter().flatten().enumerate() {
            let at = at.key("stamps").index(i);
            let speed = stamp.speed.unwrap_or(SPEED);
            check(&at.path.key("speed"), speed, Limit::Between(-1000.0, 1000.0))?;
            let kind = match stamp.kind {
                StampKind::Vortex => Critical::Center,
                StampKind::Source => Critical::Source,
                StampKind::Sink => Critical::Sink,
                StampKind::Saddle => Critical::Saddle,
            };
            let made = field::Stamp { place: at.place("at", stamp.at)?, kind, radius: stamp.radius, speed };
            all.extend(made.anchors().map_err(|error| at.refused(&error))?);
        }
        for (i, eraser) in self.erase.iter().flatten().enumerate() {
            let at = at.key("erase").index(i);
            check(&at.path.key("radius"), eraser.radius, Limit::Positive)?;
            let (place, radius) = (at.place("at", eraser.at)?, eraser.radius);
            if erase(&mut all, place, radius) == 0 {
                at.note(format_args!("eraser {} takes out no anchor", i + 1));
            }
        }
        Ok(all)
    }
}

/// Width of the cells of grids where nothing is said, metres, and how many there are at most.
const CELL: f64 = 0.5;
const CELLS: f64 = 4e6;

impl At<'_> {
    /// A field on a grid over a box; as fine as said, or as is enough.
    pub(super) fn sampled(
        &self,
        field: &dyn Field,
        [low, high]: [DVec2; 2],
        cell: Option<f64>,
    ) -> Result<Sampled, Problem> {
        if let Some(cell) = cell {
            check(&self.path.key("cell"), cell, Limit::Positive)?;
        }
        let size = (high - low).max(DVec2::splat(CELL));
        let cell = cell.unwrap_or_else(|| CELL.max((size.x * size.y / CELLS).sqrt()));
        Sampled::of(field, low, low + size, cell, 0.0).map_err(|error| self.refused(&error))
    }
}
