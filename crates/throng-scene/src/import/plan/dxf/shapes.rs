//! Converts the entities of a drawing to shapes.

use super::super::curve::{TOLERANCE, arc, bulged};
use super::super::drawing::{Drawing, FilePosition, PlanShape};
use super::{Entity, Pairs, hatch, spline};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use glam::{DAffine2, DMat2};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Maximum nesting depth of inserted blocks.
const DEEPEST: usize = 16;
/// Maximum number of entities of inserted blocks.
const MOST: usize = 500_000;

/// Kinds with world coordinates, whatever their extrusion direction.
const IN_SPACE: [&str; 6] = ["LINE", "POINT", "3DFACE", "ELLIPSE", "SPLINE", "MTEXT"];

/// Reads the entities of a drawing.
pub(super) struct Shapes<'p, 't> {
    entities: Vec<Entity<'p, 't>>,
    blocks: BTreeMap<&'t str, DxfBlock<'p, 't>>,
    tolerance: f64,
    /// The number of entities of inserted blocks so far.
    inserted: usize,
}

/// A block: its base point and its entities.
struct DxfBlock<'p, 't> {
    base: DVec2,
    entities: Vec<Entity<'p, 't>>,
}

/// The context of entities: the layer that replaces `0`, their transform, the nesting depth.
#[derive(Clone, Copy)]
struct Frame<'t> {
    layer: Option<&'t str>,
    to: DAffine2,
    depth: usize,
}

impl<'p, 't> Shapes<'p, 't> {
    /// Makes a reader; `unit` is the length of the drawing's unit, metres.
    pub fn new(pairs: &'p Pairs<'t>, unit: f64) -> Self {
        let mut blocks = BTreeMap::new();
        let mut open: Option<(&str, DxfBlock)> = None;
        for entity in pairs.entities("BLOCKS") {
            match (entity.kind, &mut open) {
                ("BLOCK", _) => {
                    let base = entity.point(10).unwrap_or_default();
                    open = entity.text(2).map(|name| (name, DxfBlock { base, entities: vec![] }));
                }
                ("ENDBLK", _) => blocks.extend(open.take()),
                (_, Some((_, block))) => block.entities.push(entity),
                _ => {}
            }
        }
        Self { entities: pairs.entities("ENTITIES"), blocks, tolerance: TOLERANCE / unit, inserted: 0 }
    }

    /// Adds the shapes of the drawing, in its unit.
    pub fn read(&mut self, drawing: &mut Drawing) -> Result<(), Error> {
        let entities = self.entities.clone();
        self.all(&entities, Frame { layer: None, to: DAffine2::IDENTITY, depth: 0 }, drawing)
    }

    fn all(&mut self, entities: &[Entity<'p, 't>], frame: Frame<'t>, drawing: &mut Drawing) -> Result<(), Error> {
        let mut k = 0;
        while let Some(entity) = entities.get(k) {
            k += 1;
            // a polyline is followed by its vertices, up to the end of their sequence
            let parts = &entities[k..];
            let vertices = if entity.kind == "POLYLINE" {
                parts.iter().take_while(|part| part.kind == "VERTEX").count()
            } else {
                0
            };
            self.one(entity, &parts[..vertices], frame, drawing)?;
            k += vertices;
        }
        Ok(())
    }

    fn one(
        &mut self,
        entity: &Entity<'p, 't>,
        vertices: &[Entity<'p, 't>],
        frame: Frame<'t>,
        drawing: &mut Drawing,
    ) -> Result<(), Error> {
        // in paper space, or invisible
        if entity.flags(67) == 1 || entity.flags(60) == 1 {
            return Ok(());
        }
        let layer = entity.text(8).unwrap_or("0");
        let layer = if layer == "0" { frame.layer.unwrap_or(layer) } else { layer };
        // coordinates of entities with an extrusion direction downwards are mirrored
        let below = !IN_SPACE.contains(&entity.kind) && entity.number(230, 1.0)? < 0.0;
        let to = if below { frame.to * DAffine2::from_scale(DVec2::new(-1.0, 1.0)) } else { frame.to };
        let here = Frame { to, layer: Some(layer), ..frame };
        let tolerance = self.tolerance / to.matrix2.x_axis.length().max(to.matrix2.y_axis.length()).max(1e-9);
        let mut forms = match entity.kind {
            "LINE" => vec![PlanShape::Line(vec![entity.point(10)?, entity.point(11)?])],
            "LWPOLYLINE" => vec![polyline(&entity.corners()?, entity.flags(70) & 1 == 1, tolerance)],
            // meshes are not outlines
            "POLYLINE" if entity.flags(70) & (16 | 64) == 0 => {
                let mut corners = vec![];
                for vertex in vertices {
                    corners.push((vertex.point(10)?, vertex.number(42, 0.0)?));
                }
                vec![polyline(&corners, entity.flags(70) & 1 == 1, tolerance)]
            }
            "CIRCLE" if conformal(to) => vec![PlanShape::Disc(entity.point(10)?, entity.number(40, 0.0)?.max(0.0))],
            "CIRCLE" | "ARC" | "ELLIPSE" => vec![curve(entity, tolerance)?],
            "SPLINE" => {
                let points = spline::lines(entity, 71, 41, tolerance)?;
                vec![PlanShape::of_line(points, entity.flags(70) & 1 == 1)]
            }
            "HATCH" => hatch::forms(entity, tolerance)?,
            "SOLID" | "TRACE" | "3DFACE" => {
                let mut corners = vec![entity.point(10)?, entity.point(11)?, entity.point(13)?, entity.point(12)?];
                if entity.kind == "3DFACE" {
                    corners.swap(2, 3);
                }
                vec![PlanShape::Area(corners, vec![])]
            }
            "POINT" => vec![PlanShape::Point(entity.point(10)?)],
            "INSERT" => return self.insert(entity, here, drawing),
            "TEXT" | "MTEXT" => {
                let said = entity.pairs.iter().filter(|pair| matches!(pair.code, 1 | 3)).map(|pair| pair.value);
                drawing.labels.push((to.transform_point2(entity.point(10)?), said.collect()));
                return Ok(());
            }
            "SEQEND" | "VERTEX" | "VIEWPORT" | "ATTDEF" | "ATTRIB" | "DIMENSION" | "LEADER" | "IMAGE" => return Ok(()),
            kind => {
                let shown = short(kind);
                drawing.notes.about(&shown, "shapes of this kind are left out");
                return Ok(());
            }
        };
        for form in &mut forms {
            form.each(|p| to.transform_point2(p));
        }
        forms.into_iter().for_each(|form| drawing.add(layer, form, FilePosition::Line(entity.line)));
        Ok(())
    }

    /// Adds the entities of a block where it is inserted, in rows and columns.
    fn insert(&mut self, entity: &Entity<'p, 't>, frame: Frame<'t>, drawing: &mut Drawing) -> Result<(), Error> {
        let wrong = |message: String| {
            let mut error = Error::new(Kind::Geometry, message);
            error.at = Some((entity.line, 1));
            error.hint("explode the blocks before the export")
        };
        let name = entity.text(2).unwrap_or_default();
        let Some(block) = self.blocks.get(name) else { return Ok(()) };
        let (base, entities) = (block.base, block.entities.clone());
        if frame.depth >= DEEPEST {
            return Err(wrong(format!("blocks insert each other more than {DEEPEST} deep")));
        }
        let scale = DVec2::new(entity.number(41, 1.0)?, entity.number(42, 1.0)?);
        let (sin, cos) = libm::sincos(entity.number(50, 0.0)?.to_radians());
        let turn = DAffine2::from_mat2(DMat2::from_cols(DVec2::new(cos, sin), DVec2::new(-sin, cos)));
        let apart = DVec2::new(entity.number(44, 0.0)?, entity.number(45, 0.0)?);
        let count = |code: i32| entity.number(code, 1.0).map(|count| count.clamp(1.0, 1e6) as usize);
        let (columns, rows) = (count(70)?, count(71)?);
        let at = entity.point(10)?;
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            self.inserted += entities.len() + 1;
            if self.inserted > MOST {
                return Err(wrong(format!("inserted blocks come to more than {MOST} shapes")));
            }
            let shift = DVec2::new(column as f64, row as f64) * apart;
            let to =
                DAffine2::from_translation(at) * turn * DAffine2::from_translation(shift) * DAffine2::from_scale(scale);
            let to = frame.to * to * DAffine2::from_translation(-base);
            self.all(&entities, Frame { to, depth: frame.depth + 1, ..frame }, drawing)?;
        }
        Ok(())
    }
}

/// Returns a circle, an arc, or an ellipse.
fn curve(entity: &Entity, tolerance: f64) -> Result<PlanShape, Error> {
    let center = entity.point(10)?;
    let (axes, from, to) = if entity.kind == "ELLIPSE" {
        let a = entity.point(11)?;
        // with an extrusion direction downwards the ellipse runs the other way round
        let below = if entity.number(230, 1.0)? < 0.0 { -1.0 } else { 1.0 };
        ([a, a.perp() * below * entity.number(40, 1.0)?], entity.number(41, 0.0)?, entity.number(42, TAU)?)
    } else {
        let radius = entity.number(40, 0.0)?.max(0.0);
        let (from, to) = (entity.number(50, 0.0)?.to_radians(), entity.number(51, 360.0)?.to_radians());
        ([DVec2::X * radius, DVec2::Y * radius], from, to)
    };
    // counter-clockwise, at most one turn
    let turn = (to - from).rem_euclid(TAU);
    let turn = if turn < 1e-9 { TAU } else { turn };
    Ok(PlanShape::of_line(arc(center, axes, [from, from + turn], tolerance), false))
}

/// Whether a transform keeps circles round.
fn conformal(to: DAffine2) -> bool {
    let (x, y) = (to.matrix2.x_axis, to.matrix2.y_axis);
    (x.length() - y.length()).abs() <= 1e-9 * x.length() && x.dot(y).abs() <= 1e-9 * x.length_squared()
}

fn polyline(corners: &[(DVec2, f64)], closed: bool, tolerance: f64) -> PlanShape {
    PlanShape::of_line(bulged(corners, closed, tolerance), closed)
}
