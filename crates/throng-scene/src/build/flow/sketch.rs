//! Fields through anchors.

use super::{At, Made, Make};
use crate::build::limits::{Limit, check};
use crate::file::Problem;
use crate::geometry::DVec2;
use crate::scene::flow::{AnchorInSpace, Kernel, Sketch, SketchInSpace, StampKind};
use glam::DVec3;
use std::sync::Arc;
use throng::field::{self, Anchor, Anchors, AnchorsInSpace, Critical, Field, Note, Sampled, erase};

/// Metres beyond the hull at which 1/e is left, where nothing is said.
const FADE: f64 = 10.0;
/// Metres a second along a stroke, where nothing is said: a walk.
pub(super) const SPEED: f64 = 1.3;
/// How much faster than the fastest anchor the field may be, where nothing is said.
const FASTER: f64 = 1.5;
/// Part of the fastest anchor's speed below which a field has faded.
const FADED: f64 = 0.05;
/// By so much, metres, the corners of the grid are beside round coordinates: a standstill at a corner would not be seen.
const ASIDE: f64 = 0.1234;
/// Traps that are told one by one.
const TOLD: usize = 3;

impl Make for Sketch {
    fn make(&self, at: &At) -> Result<Made, Problem> {
        let anchors = self.all(at)?;
        let fastest = anchors.iter().map(|anchor| anchor.velocity.length()).fold(0.0, f64::max);
        let numbers = (&self.kernel, self.smoothing, self.fade, self.max_speed);
        let sketch = sketch(numbers, fastest);
        let made = Anchors::new(&anchors, sketch).map_err(|error| at.refused(&error))?;
        at.note_anchors(made.notes());
        // as far as it says anything
        let reach = match &self.kernel {
            Some(Kernel::Wendland(kernel)) => kernel.reach,
            Some(Kernel::ThinPlate(_)) | None => 3.0 * sketch.fade.unwrap_or(FADE),
        };
        let places = anchors.iter().map(|anchor| anchor.place);
        let [low, high] = crate::geometry::bounds(places).unwrap_or_default();
        let field = at.sampled(&made, [low - reach - ASIDE, high + reach], self.cell)?;
        note_traps(at, &field, fastest);
        Ok(Made { field: Arc::new(field), anchors, cover: None })
    }
}

impl Make for SketchInSpace {
    fn make(&self, at: &At) -> Result<Made, Problem> {
        let one = |(i, anchor): (usize, &AnchorInSpace)| {
            let at = at.key("anchors").index(i);
            let velocity = DVec3::from_array(anchor.velocity.0);
            at.check_velocity(&anchor.velocity.0)?;
            Ok((at.position("at", anchor.at)?.as_dvec3(), velocity))
        };
        let anchors: Vec<_> = self.anchors.iter().enumerate().map(one).collect::<Result<_, Problem>>()?;
        let fastest = anchors.iter().map(|anchor| anchor.1.length()).fold(0.0, f64::max);
        let sketch = sketch((&self.kernel, self.smoothing, self.fade, self.max_speed), fastest);
        let made = AnchorsInSpace::new(&anchors, sketch).map_err(|error| at.refused(&error))?;
        at.note_anchors(made.notes());
        Ok(Made::of(made))
    }
}

/// How a field goes through its anchors: as said, or as is sensible.
fn sketch(
    (kernel, smoothing, fade, max_speed): (&Option<Kernel>, Option<f64>, Option<f64>, Option<f64>),
    fastest: f64,
) -> field::Sketch {
    field::Sketch {
        kernel: match kernel {
            Some(Kernel::Wendland(kernel)) => field::Kernel::Wendland { reach: kernel.reach },
            Some(Kernel::ThinPlate(_)) | None => field::Kernel::ThinPlate,
        },
        smoothing: smoothing.unwrap_or(0.0),
        fade: Some(fade.unwrap_or(FADE)),
        max_speed: max_speed.unwrap_or(if fastest > 0.0 { FASTER * fastest } else { 1.0 }),
    }
}

/// Tells where who follows a field would be trapped.
fn note_traps(at: &At, field: &Sampled, fastest: f64) {
    let points = field.critical_points();
    // far out, where it has faded, nobody comes
    let around = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|way| way * (2.0 * field.cell()));
    let matters = |place: DVec2| {
        let near = around.map(|away| (place + away).as_vec2().extend(0.0));
        near.into_iter().any(|near| f64::from(field.velocity(near, 0.0).length()) > FADED * fastest)
    };
    let traps: Vec<_> = points.iter().filter(|point| point.kind.traps() && matters(point.place)).collect();
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
    fn check_velocity(&self, velocity: &[f64]) -> Result<(), Problem> {
        let path = self.path.key("velocity");
        let each = |(i, x): (usize, &f64)| check(&path.index(i), *x, Limit::Between(-1000.0, 1000.0));
        velocity.iter().enumerate().try_for_each(each)
    }

    /// Notes what is worth knowing of anchors.
    fn note_anchors(&self, notes: &[Note]) {
        for note in notes {
            self.note(match note {
                Note::Empty => "it has no anchors, and says nothing anywhere".to_owned(),
                Note::OnePlace => "all its anchors are in one place: it says the same everywhere round it".to_owned(),
                Note::OnLine => "all its anchors are on one line: it says the same on all sides of it".to_owned(),
                Note::OnPlane => "all its anchors are in one plane: it says the same above and below it".to_owned(),
                Note::Shared(count) => {
                    format!("{count} of its anchors share their place with another: it has their mean there")
                }
                note => format!("{note:?}"),
            });
        }
    }

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
