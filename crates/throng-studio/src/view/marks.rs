//! What agents are drawn as.

use throng_draw::{Form, Shape};
use throng_record::Body;

/// What agents are drawn as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Marks {
    /// As the scene says; else discs on a plan, and in space walkers as figures, who flies as a dart.
    #[default]
    Fitting,
    /// All as discs.
    Discs,
    /// All as one shape.
    All(Shape),
}

impl Marks {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Fitting,
        Self::Discs,
        Self::All(Shape::Arrow),
        Self::All(Shape::Vehicle),
        Self::All(Shape::Bird),
        Self::All(Shape::Insect),
        Self::All(Shape::Walker),
    ];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Fitting => "fitting",
            Self::Discs => "discs",
            Self::All(shape) => shape.label(),
        }
    }

    /// The shape of an agent; `None` for a disc.
    pub fn shape(self, body: &Body, form: Form, plan: bool) -> Option<Shape> {
        match self {
            Self::Discs => None,
            Self::All(shape) => Some(shape),
            Self::Fitting if form == Form::Insect => Some(Shape::Insect),
            Self::Fitting if body.basis.is_some() => Some(Shape::Vehicle),
            Self::Fitting if plan || body.radius > TALL || body.core != glam::Vec2::ZERO => None,
            Self::Fitting => Some(Shape::Walker),
        }
    }

    /// What pictures draw an agent as, whose own form is this one.
    pub fn form(self, body: &Body, own: Form, plan: bool) -> Form {
        match self.shape(body, own, plan) {
            None => Form::Body,
            Some(Shape::Insect) => Form::Insect,
            // the same, drawn as who flies
            Some(Shape::Vehicle) if body.basis.is_some() => Form::Body,
            Some(shape) => Form::Shaped(shape),
        }
    }
}

/// People are no wider than this, metres.
const TALL: f32 = 0.6;

#[cfg(test)]
mod tests {
    use super::*;
    use throng_record::{Frame, moment};

    #[test]
    fn people_are_figures_in_space_only() {
        let (world, _) = throng_scene::gallery::scene("circle").unwrap().build().unwrap();
        let mut frame = Frame::default();
        moment::capture(&world, &mut frame);
        let body = frame.bodies[0];
        assert_eq!(Marks::Fitting.form(&body, Form::Body, false), Form::Shaped(Shape::Walker));
        assert_eq!(Marks::Fitting.form(&body, Form::Body, true), Form::Body);
        assert_eq!(Marks::Fitting.form(&body, Form::Insect, true), Form::Insect);
        assert_eq!(Marks::Discs.form(&body, Form::Insect, false), Form::Body);
        let wide = Body { radius: 2.0, ..body };
        assert_eq!(Marks::Fitting.form(&wide, Form::Body, false), Form::Body);
        assert_eq!(Marks::All(Shape::Bird).form(&wide, Form::Body, true), Form::Shaped(Shape::Bird));
    }
}
