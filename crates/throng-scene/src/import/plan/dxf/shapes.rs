//! The entities of a drawing as shapes.

use super::super::curve::{TOLERANCE, arc, bulge};
use super::super::drawing::{Drawing, Form, Place};
use super::{Entity, Pairs};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use glam::{DAffine2, DMat2};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Blocks may insert each other this deep.
const DEEPEST: usize = 16;
/// The most entities that inserted blocks may come to.
const MOST: usize = 500_000;

/// What reads the entities of a drawing.
pub(super) struct Shapes<'p, 't> {
    entities: Vec<Entity<'p, 't>>,
    blocks: BTreeMap<&'t str, Block<'p, 't>>,
    tolerance: f64,
    /// How many entities inserted blocks have come to.
    inserted: usize,
}

/// A block: where it is held by, and what is in it.
struct Block<'p, 't> {
    base: DVec2,
    entities: Vec<Entity<'p, 't>>,
}

/// Where entities are drawn: the layer that stands for `0`, how they are moved, how deep in blocks.
#[derive(Clone, Copy)]
struct Frame<'t> {
    layer: Option<&'t str>,
    to: DAffine2,
    depth: usize,
}

impl<'p, 't> Shapes<'p, 't> {
    /// With the length of the drawing's unit, metres.
    pub fn new(pairs: &'p Pairs<'t>, unit: f64) -> Self {
        let mut blocks = BTreeMap::new();
        let mut open: Option<(&str, Block)> = None;
        for entity in pairs.entities("BLOCKS") {
            match (entity.kind, &mut open) {
                ("BLOCK", _) => {
                    let base = point(&entity, 10).unwrap_or_default();
                    open = entity.text(2).map(|name| (name, Block { base, entities: vec![] }));
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
            // what follows a polyline are its vertices, up to the end of their sequence
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
        // on paper, not in the model; or not shown
        if entity.flags(67) == 1 || entity.flags(60) == 1 {
            return Ok(());
        }
        let layer = entity.text(8).unwrap_or("0");
        let layer = if layer == "0" { frame.layer.unwrap_or(layer) } else { layer };
        // coordinates of what is drawn from below are mirrored
        let below = entity.number(230, 1.0)? < 0.0;
        let to = if below { frame.to * DAffine2::from_scale(DVec2::new(-1.0, 1.0)) } else { frame.to };
        let here = Frame { to, layer: Some(layer), ..frame };
        let tolerance = self.tolerance / to.matrix2.x_axis.length().max(to.matrix2.y_axis.length()).max(1e-9);
        let mut form = match entity.kind {
            "LINE" => Form::Line(vec![point(entity, 10)?, point(entity, 11)?]),
            "LWPOLYLINE" => polyline(corners(entity.pairs)?, entity.flags(70) & 1 == 1, tolerance),
            // meshes are no outlines
            "POLYLINE" if entity.flags(70) & (16 | 64) == 0 => {
                let mut corners = vec![];
                for vertex in vertices {
                    corners.push((point(vertex, 10)?, vertex.number(42, 0.0)?));
                }
                polyline(corners, entity.flags(70) & 1 == 1, tolerance)
            }
            "CIRCLE" if conformal(to) => Form::Disc(point(entity, 10)?, entity.number(40, 0.0)?.max(0.0)),
            "CIRCLE" | "ARC" | "ELLIPSE" => curve(entity, tolerance)?,
            "SOLID" | "TRACE" | "3DFACE" => {
                let mut corners = vec![point(entity, 10)?, point(entity, 11)?, point(entity, 13)?, point(entity, 12)?];
                if entity.kind == "3DFACE" {
                    corners.swap(2, 3);
                }
                Form::Area(corners, vec![])
            }
            "POINT" => Form::Point(point(entity, 10)?),
            "INSERT" => return self.insert(entity, here, drawing),
            "TEXT" | "MTEXT" => {
                let said = entity.pairs.iter().filter(|pair| matches!(pair.code, 1 | 3)).map(|pair| pair.value);
                drawing.labels.push((to.transform_point2(point(entity, 10)?), said.collect()));
                return Ok(());
            }
            "SEQEND" | "VERTEX" | "VIEWPORT" | "ATTDEF" | "ATTRIB" | "DIMENSION" | "LEADER" | "IMAGE" => return Ok(()),
            kind => {
                let shown = short(kind);
                drawing.notes.about(&shown, "shapes of this kind are left out");
                return Ok(());
            }
        };
        form.each(|p| to.transform_point2(p));
        drawing.add(layer, form, Place::Line(entity.line));
        Ok(())
    }

    /// What is in a block, where it is inserted, in rows and columns.
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
        let at = point(entity, 10)?;
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

/// A circle, or a part of one, or of an ellipse.
fn curve(entity: &Entity, tolerance: f64) -> Result<Form, Error> {
    let center = point(entity, 10)?;
    let (axes, from, to) = if entity.kind == "ELLIPSE" {
        let a = point(entity, 11)?;
        ([a, a.perp() * entity.number(40, 1.0)?], entity.number(41, 0.0)?, entity.number(42, TAU)?)
    } else {
        let radius = entity.number(40, 0.0)?.max(0.0);
        let (from, to) = (entity.number(50, 0.0)?.to_radians(), entity.number(51, 360.0)?.to_radians());
        ([DVec2::X * radius, DVec2::Y * radius], from, to)
    };
    // counter-clockwise, once round at most
    let turn = (to - from).rem_euclid(TAU);
    let turn = if turn < 1e-9 { TAU } else { turn };
    Ok(Form::of_line(arc(center, axes, [from, from + turn], tolerance), false))
}

/// Whether circles stay circles.
fn conformal(to: DAffine2) -> bool {
    let (x, y) = (to.matrix2.x_axis, to.matrix2.y_axis);
    (x.length() - y.length()).abs() <= 1e-9 * x.length() && x.dot(y).abs() <= 1e-9 * x.length_squared()
}

/// The point whose x has this code: y has ten more.
fn point(entity: &Entity, code: i32) -> Result<DVec2, Error> {
    Ok(DVec2::new(entity.number(code, 0.0)?, entity.number(code + 10, 0.0)?))
}

/// The corners of a light polyline, with how much the line after each bulges.
fn corners(pairs: &[super::pairs::Pair]) -> Result<Vec<(DVec2, f64)>, Error> {
    let mut corners: Vec<(DVec2, f64)> = vec![];
    for pair in pairs {
        match (pair.code, corners.last_mut()) {
            (10, _) => corners.push((DVec2::new(pair.number()?, 0.0), 0.0)),
            (20, Some((at, _))) => at.y = pair.number()?,
            (42, Some((_, bulge))) => *bulge = pair.number()?,
            _ => {}
        }
    }
    Ok(corners)
}

fn polyline(corners: Vec<(DVec2, f64)>, closed: bool, tolerance: f64) -> Form {
    let mut points: Vec<DVec2> = corners.first().map(|(at, _)| *at).into_iter().collect();
    let next = corners.iter().skip(1).chain(corners.first().filter(|_| closed));
    for ((from, bent), (to, _)) in corners.iter().zip(next) {
        points.extend(bulge(*from, *to, *bent, tolerance));
    }
    if closed && points.len() > 1 {
        points.pop();
    }
    Form::of_line(points, closed)
}
