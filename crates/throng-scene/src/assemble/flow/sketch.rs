//! Fields through anchors.

use crate::assemble::limits::{Limit, check, check_some};
use crate::error::Kind;
use crate::file::Problem;
use crate::geometry::DVec2;
use crate::registry::{BuildField, FieldContext};
use crate::scene::flow::{AnchorInSpace, Kernel, Sketch, SketchInSpace, StampKind};
use glam::DVec3;
use std::sync::Arc;
use throng::field::Field;
use throng_field::{Anchor, Anchors, AnchorsInSpace, Critical, Note, Sampled, erase};

/// Default distance beyond the hull over which the field falls to 1/e, metres.
const FADE: f64 = 10.0;
/// Default speed along a stroke, m/s: walking speed.
pub(super) const SPEED: f64 = 1.3;
/// Default ratio of the field's greatest speed to that of the fastest anchor.
const FASTER: f64 = 1.5;
/// Part of the fastest anchor's speed below which a field has faded.
const FADED: f64 = 0.05;
/// Offset of the grid's corners from round coordinates, metres: a standstill exactly at a corner would not be found.
const ASIDE: f64 = 0.1234;
/// Maximum number of traps with a note of their own.
const MOST_NOTES: usize = 3;

impl BuildField for Sketch {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        let anchors = self.all(at)?;
        let fastest = anchors.iter().map(|anchor| anchor.velocity.length()).fold(0.0, f64::max);
        let numbers = (&self.kernel, self.smoothing, self.fade, self.max_speed);
        let sketch = sketch(numbers, fastest);
        let made = Anchors::new(&anchors, sketch).map_err(|error| at.refused(&error))?;
        at.note_anchors(made.notes());
        // the grid reaches as far as the field
        let reach = match &self.kernel {
            Some(Kernel::Wendland(kernel)) => kernel.reach,
            Some(Kernel::ThinPlate(_)) | None => 3.0 * sketch.fade.unwrap_or(FADE),
        };
        let places = anchors.iter().map(|anchor| anchor.place);
        let [low, high] = crate::geometry::bounds(places).unwrap_or_default();
        let corners = [low - reach - ASIDE, high + reach];
        check_some(&at.path.key("cell"), self.cell, Limit::Positive)?;
        let cell = self.cell.unwrap_or_else(|| width(corners, CELLS.min(TERMS / anchors.len().max(1) as f64)));
        let terms = (corners[1] - corners[0]).element_product() / (cell * cell) * anchors.len() as f64;
        if terms > MOST_TERMS {
            let least = cell * (terms / MOST_TERMS).sqrt();
            let message = format!("{cell} is so narrow that sampling {} anchors takes minutes", anchors.len());
            let hint = format!("make it {least:.1} or wider, or take fewer anchors");
            return Err(Problem::new(&at.path.key("cell"), Kind::OutOfRange, message).hint(hint));
        }
        let field = at.sampled(&made, corners, Some(cell))?;
        note_traps(at, &field, fastest);
        at.scene.add_anchors(&anchors);
        Ok(Arc::new(field))
    }
}

impl BuildField for SketchInSpace {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
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
        Ok(Arc::new(made))
    }
}

/// Returns the parameters of a sketch: the given ones, or defaults.
fn sketch(
    (kernel, smoothing, fade, max_speed): (&Option<Kernel>, Option<f64>, Option<f64>, Option<f64>),
    fastest: f64,
) -> throng_field::Sketch {
    throng_field::Sketch {
        kernel: match kernel {
            Some(Kernel::Wendland(kernel)) => throng_field::Kernel::Wendland { reach: kernel.reach },
            Some(Kernel::ThinPlate(_)) | None => throng_field::Kernel::ThinPlate,
        },
        smoothing: smoothing.unwrap_or(0.0),
        fade: Some(fade.unwrap_or(FADE)),
        max_speed: max_speed.unwrap_or(if fastest > 0.0 { FASTER * fastest } else { 1.0 }),
    }
}

/// Adds notes about places where a field would trap agents.
fn note_traps(at: &FieldContext, field: &Sampled, fastest: f64) {
    let points = field.critical_points();
    // agents do not get far out, where the field has faded
    let around = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|way| way * (2.0 * field.cell()));
    let matters = |place: DVec2| {
        let near = around.map(|away| (place + away).as_vec2().extend(0.0));
        near.into_iter().any(|near| f64::from(field.velocity(near, 0.0).length()) > FADED * fastest)
    };
    let traps: Vec<_> = points.iter().filter(|point| point.kind.traps() && matters(point.place)).collect();
    for trap in traps.iter().take(MOST_NOTES) {
        let place = trap.place + at.scene.origin();
        let kind = if trap.kind == Critical::Sink { "leads to" } else { "goes round and round" };
        at.note(format_args!("it {kind} ({:.1}, {:.1}): agents that follow it do not get out", place.x, place.y));
    }
    if traps.len() > MOST_NOTES {
        at.note(format_args!("and it traps agents at {} other places", traps.len() - MOST_NOTES));
    }
}

impl Sketch {
    /// Returns all anchors that are not erased.
    fn all(&self, at: &FieldContext) -> Result<Vec<Anchor>, Problem> {
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
            let made = throng_field::Stroke {
                points: at.places("points", &stroke.points)?,
                speed,
                spacing: stroke.spacing.unwrap_or(throng_field::Stroke::default().spacing),
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
            let made = throng_field::Stamp { place: at.place("at", stamp.at)?, kind, radius: stamp.radius, speed };
            all.extend(made.anchors().map_err(|error| at.refused(&error))?);
        }
        for (i, eraser) in self.erase.iter().flatten().enumerate() {
            let at = at.key("erase").index(i);
            check(&at.path.key("radius"), eraser.radius, Limit::Positive)?;
            let (place, radius) = (at.place("at", eraser.at)?, eraser.radius);
            if erase(&mut all, place, radius) == 0 {
                at.note(format_args!("eraser {} removes no anchor", i + 1));
            }
        }
        Ok(all)
    }
}

/// Default width of the cells of grids, metres.
pub(super) const CELL: f64 = 0.5;
/// Maximum number of cells of grids without a given width.
pub(super) const CELLS: f64 = 4e6;
/// Maximum of cells times anchors without a given width: takes a second or two, if the anchors need double precision.
const TERMS: f64 = 4e7;
/// Maximum of cells times anchors with a given width.
const MOST_TERMS: f64 = 4e9;

/// Returns the width of cells, at least `CELL`, at which a box has at most `most` cells.
pub(super) fn width([low, high]: [DVec2; 2], most: f64) -> f64 {
    let size = (high - low).max(DVec2::splat(CELL));
    CELL.max((size.element_product() / most).sqrt())
}

impl FieldContext<'_> {
    fn check_velocity(&self, velocity: &[f64]) -> Result<(), Problem> {
        let path = self.path.key("velocity");
        let each = |(i, x): (usize, &f64)| check(&path.index(i), *x, Limit::Between(-1000.0, 1000.0));
        velocity.iter().enumerate().try_for_each(each)
    }

    /// Adds notes about the anchors.
    fn note_anchors(&self, notes: &[Note]) {
        for note in notes {
            self.note(match note {
                Note::Empty => "it has no anchors, and is zero everywhere".to_owned(),
                Note::OnePlace => "all its anchors are in one place: it is the same all around it".to_owned(),
                Note::OnLine => "all its anchors are on one line: it does not vary across the line".to_owned(),
                Note::OnPlane => "all its anchors are in one plane: it does not vary across the plane".to_owned(),
                Note::Shared(count) => {
                    format!("{count} of its anchors share their place with another: it has their mean there")
                }
                note => format!("{note:?}"),
            });
        }
    }
}
