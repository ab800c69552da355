//! The shapes that agents are drawn as.

use throng_draw::{AgentShape, Shape};
use throng_record::Body;

/// The shapes that agents are drawn as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Marks {
    /// As the scene says. Otherwise discs in a plan; in space, flying agents as darts and walking agents as people, or as
    /// walkers of flat faces where [people](crate::view::Layers::people) are not drawn.
    #[default]
    Fitting,
    /// Discs for all agents.
    Discs,
    /// One shape for all agents.
    All(Shape),
}

impl Marks {
    /// All choices.
    pub const ALL: [Self; 9] = [
        Self::Fitting,
        Self::Discs,
        Self::All(Shape::Arrow),
        Self::All(Shape::Vehicle),
        Self::All(Shape::Bird),
        Self::All(Shape::Insect),
        Self::All(Shape::Walker),
        Self::All(Shape::Car),
        Self::All(Shape::Robot),
    ];

    /// Returns the label.
    pub fn label(self) -> &'static str {
        match self {
            Self::Fitting => "fitting",
            Self::Discs => "discs",
            Self::All(shape) => shape.label(),
        }
    }

    /// Returns the shape of an agent, `None` for a disc.
    pub fn shape(self, body: &Body, form: AgentShape, plan: bool) -> Option<Shape> {
        match (self, form) {
            (Self::Discs, _) | (Self::Fitting, AgentShape::Ball) => None,
            (Self::All(shape), _) | (Self::Fitting, AgentShape::Shaped(shape)) => Some(shape),
            (Self::Fitting, AgentShape::Insect) => Some(Shape::Insect),
            (Self::Fitting, _) if body.basis.is_some() => Some(Shape::Vehicle),
            (Self::Fitting, _) if plan || body.radius > TALL || body.core != glam::Vec2::ZERO => None,
            (Self::Fitting, _) => Some(Shape::Walker),
        }
    }

    /// Returns the form in pictures of an agent with the form `own`.
    pub fn form(self, body: &Body, own: AgentShape, plan: bool) -> AgentShape {
        match self.shape(body, own, plan) {
            None if own == AgentShape::Ball => AgentShape::Ball,
            None => AgentShape::Body,
            Some(Shape::Insect) => AgentShape::Insect,
            // pictures draw a flying agent as a dart already
            Some(Shape::Vehicle) if body.basis.is_some() => AgentShape::Body,
            Some(shape) => AgentShape::Shaped(shape),
        }
    }
}

/// The largest radius of an agent that is drawn as a walking figure, metres.
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
        assert_eq!(Marks::Fitting.form(&body, AgentShape::Body, false), AgentShape::Shaped(Shape::Walker));
        assert_eq!(Marks::Fitting.form(&body, AgentShape::Body, true), AgentShape::Body);
        assert_eq!(Marks::Fitting.form(&body, AgentShape::Insect, true), AgentShape::Insect);
        assert_eq!(Marks::Discs.form(&body, AgentShape::Insect, false), AgentShape::Body);
        let wide = Body { radius: 2.0, ..body };
        assert_eq!(Marks::Fitting.form(&wide, AgentShape::Body, false), AgentShape::Body);
        assert_eq!(Marks::All(Shape::Bird).form(&wide, AgentShape::Body, true), AgentShape::Shaped(Shape::Bird));
    }
}
