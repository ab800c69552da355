//! The style of pictures from a scene.

use crate::{
    AgentShape, Annotation, Annotations, Color, FlowLayer, FlowStyle, Following, Motion, Projection, Shape, Style, Sun,
    Theme, Viewpoint, WorldBox,
};
use glam::{DVec2, DVec3};
use throng_scene::{Annotate, Camera, CameraKey, Colour, DrawnFields, FieldLayer, Scene};

impl Style {
    /// Returns the style from the scene's `[view]` and its groups, with defaults for the rest.
    pub fn said(scene: &Scene) -> Self {
        Self::themed(scene, Theme::light())
    }

    /// Returns the style from the scene's `[view]` and its groups, with this theme, and defaults for the rest. Colours of
    /// the ground and of obstacles in `[view]` are for a light theme; a dark theme keeps its own. A scene with lamps is at
    /// night: it has the dark theme.
    pub fn themed(scene: &Scene, theme: Theme) -> Self {
        let (view, default) = (&scene.view, Self::default());
        let mut theme = if view.lamps.is_empty() { theme } else { Theme::dark() };
        let is_dark = theme.is_dark();
        for (place, said) in [
            (&mut theme.outside, view.background),
            (&mut theme.ground, view.ground),
            (&mut theme.obstacle, view.obstacles),
        ] {
            *place = said.filter(|_| !is_dark).map_or(*place, color);
        }
        let corners = view.min.zip(view.max).map(|(a, b)| (DVec2::from(a), DVec2::from(b)));
        Self {
            view: corners.map(|(a, b)| WorldBox { min: a.min(b), max: a.max(b) }),
            projection: match view.projection {
                Some(throng_scene::Projection::Plan) => Some(Projection::Plan),
                Some(throng_scene::Projection::Perspective) => Some(Projection::Perspective),
                None => view.camera.as_ref().map(|_| Projection::Perspective),
            },
            viewpoint: viewpoint(view.camera.clone().unwrap_or_default()),
            trails: view.trails.map_or(default.trails, |seconds| seconds as f32),
            groups: scene.groups.iter().map(|group| group.colour.map(color)).collect(),
            forms: scene.groups.iter().map(|group| form(group.mark)).collect(),
            lines: view.lines.iter().map(|line| line.iter().copied().map(DVec2::from).collect()).collect(),
            goals: view.goals.unwrap_or(default.goals),
            people: view.people.unwrap_or(default.people),
            sun: Sun { azimuth: view.sun.azimuth, height: view.sun.height },
            haze: view.haze,
            lamps: view.lamps.iter().copied().map(DVec3::from).collect(),
            flow: flow(&view.field),
            theme,
            ..default
        }
    }
}

impl Annotations {
    /// Returns the annotations of the scene's `[view]`, of all agents.
    pub fn said(scene: &Scene) -> Self {
        let kinds = match &scene.view.annotate {
            Annotate::Kinds(kinds) => kinds.iter().map(|&kind| drawn(kind)).collect(),
            Annotate::All(true) => Annotation::ALL.to_vec(),
            Annotate::All(false) => Vec::new(),
        };
        Self { kinds, agents: None }
    }
}

/// Converts an annotation of a scene to one of the drawing.
fn drawn(kind: throng_scene::Annotation) -> Annotation {
    use throng_scene::Annotation as Named;
    match kind {
        Named::Neighbourhoods => Annotation::Neighbourhoods,
        Named::Trails => Annotation::Trails,
        Named::Paths => Annotation::Paths,
        Named::VelocityObstacles => Annotation::VelocityObstacles,
        Named::Constructions => Annotation::Constructions,
        Named::Feelers => Annotation::Feelers,
        Named::Flow => Annotation::Flow,
        Named::Predictions => Annotation::Predictions,
        Named::Targets => Annotation::Targets,
        Named::Threats => Annotation::Threats,
        Named::Preferred => Annotation::Preferred,
        Named::Velocity => Annotation::Velocity,
        Named::Terms => Annotation::Terms,
        Named::Force => Annotation::Force,
    }
}

fn color(Colour([r, g, b]): Colour) -> Color {
    Color::rgb(u32::from_be_bytes([0, r, g, b]))
}

/// Returns the form of a group.
fn form(said: Option<throng_scene::AgentShape>) -> AgentShape {
    match said {
        Some(throng_scene::AgentShape::Insect) => AgentShape::Insect,
        Some(throng_scene::AgentShape::Bird) => AgentShape::Shaped(Shape::Bird),
        Some(throng_scene::AgentShape::Car) => AgentShape::Shaped(Shape::Car),
        Some(throng_scene::AgentShape::Robot) => AgentShape::Shaped(Shape::Robot),
        Some(throng_scene::AgentShape::Ball) => AgentShape::Ball,
        Some(throng_scene::AgentShape::Person) => AgentShape::Shaped(Shape::Walker),
        Some(throng_scene::AgentShape::Body) | None => AgentShape::Body,
    }
}

/// Returns the style of fields; `None` if they are not drawn.
fn flow(said: &DrawnFields) -> Option<FlowStyle> {
    match said {
        DrawnFields::Usual(drawn) => drawn.then(FlowStyle::default),
        DrawnFields::Layers(layers) => {
            Some(FlowStyle::of(layers.iter().map(|&layer| layer_of(layer)).collect::<Vec<_>>()))
        }
    }
}

fn layer_of(layer: FieldLayer) -> FlowLayer {
    match layer {
        FieldLayer::Speed => FlowLayer::Speed,
        FieldLayer::Lic => FlowLayer::Lic,
        FieldLayer::Streamlines => FlowLayer::Streamlines,
        FieldLayer::Arrows => FlowLayer::Arrows,
        FieldLayer::Anchors => FlowLayer::Anchors,
        FieldLayer::Critical => FlowLayer::Critical,
    }
}

fn viewpoint(camera: Camera) -> Viewpoint {
    let standard = Viewpoint::default();
    let key = |key: CameraKey| crate::CameraKey {
        time: key.time,
        eye: key.eye.into(),
        target: key.target.into(),
        field_of_view: key.field_of_view,
        cut: key.cut,
    };
    let motion = match camera {
        Camera { follow: Some(number), eye: Some(_), target: Some(_), .. } => Motion::Beside(number),
        Camera { follow: Some(number), .. } => Motion::Follow(Following::usual(number)),
        Camera { orbit: Some(rate), .. } => Motion::Orbit(rate),
        Camera { crowd: true, .. } => Motion::Crowd,
        Camera { ref keys, .. } if !keys.is_empty() => Motion::Keys(keys.iter().copied().map(key).collect()),
        _ => standard.motion,
    };
    Viewpoint {
        eye: camera.eye.map(Into::into),
        target: camera.target.map(Into::into),
        field_of_view: camera.field_of_view.unwrap_or(standard.field_of_view),
        motion,
    }
}
