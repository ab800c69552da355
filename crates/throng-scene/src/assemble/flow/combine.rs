//! Combinations of fields.

use super::{BuildField, BuiltField, FieldContext};
use crate::assemble::limits::{Limit, check};
use crate::file::Problem;
use crate::scene::flow::{AroundWalls, Blend, FlowPart, Keyframes, Sampled, Sum};
use std::sync::Arc;
use throng::space::Walls;
use throng_field::{Anchor, FieldPart};

impl BuildField for Sum {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem> {
        let (parts, anchors) = at.parts(&self.0, Limit::Finite)?;
        let made = throng_field::Sum::new(parts).map_err(|error| at.refused(&error))?;
        Ok(BuiltField { field: Arc::new(made), anchors, cover: None })
    }
}

impl BuildField for Blend {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem> {
        let (parts, anchors) = at.parts(&self.0, Limit::NotNegative)?;
        let made = throng_field::Blend::new(parts).map_err(|error| at.refused(&error))?;
        Ok(BuiltField { field: Arc::new(made), anchors, cover: None })
    }
}

impl FieldContext<'_> {
    /// Returns the parts of a sum or a blend, with weights within a limit, and the anchors of all of them.
    fn parts(&self, parts: &[FlowPart], limit: Limit) -> Result<(Vec<FieldPart>, Vec<Anchor>), Problem> {
        let (mut made, mut anchors) = (vec![], vec![]);
        for (i, part) in parts.iter().enumerate() {
            let at = self.index(i);
            let weight = part.weight.unwrap_or(1.0);
            check(&at.path.key("weight"), weight, limit)?;
            let map = part.map.as_ref().map(|map| at.key("map").map(map)).transpose()?;
            let of = at.key("of").make(&part.of)?;
            anchors.extend(of.anchors);
            made.push(FieldPart { field: of.field, weight: weight as f32, map });
        }
        Ok((made, anchors))
    }
}

impl BuildField for Keyframes {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem> {
        let (mut frames, mut anchors) = (vec![], vec![]);
        for (i, frame) in self.frames.iter().enumerate() {
            let at = at.key("frames").index(i);
            check(&at.path.key("at"), frame.at, Limit::Finite)?;
            let made = at.key("of").make(&frame.of)?;
            anchors.extend(made.anchors);
            frames.push((frame.at, made.field));
        }
        let made = throng_field::Keyframes::new(frames, self.period).map_err(|error| at.refused(&error))?;
        Ok(BuiltField { field: Arc::new(made), anchors, cover: None })
    }
}

impl BuildField for AroundWalls {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem> {
        let made = at.key("of").make(&self.of)?;
        let place = at.flows.place;
        let walls = Walls::new(&place.areas, place.obstacles(), at.flows.origin);
        let field = throng_field::AroundWalls::new(made.field, walls, self.width.unwrap_or(1.0));
        Ok(BuiltField { field: Arc::new(field.map_err(|error| at.refused(&error))?), ..made })
    }
}

impl BuildField for Sampled {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem> {
        let made = at.key("of").make(&self.of)?;
        let [low, high] = at.flows.bounds.map(|corner| corner.to_array());
        let corners = at.corners(self.min.unwrap_or(low), self.max.unwrap_or(high))?;
        let field = at.sampled(&*made.field, corners, self.cell)?;
        Ok(BuiltField { field: Arc::new(field), ..made })
    }
}
