//! A moment in perspective: a rendered picture of the place and of the agents, and insects above it.

mod birds;
mod bodies;
mod chase;
mod extent;
mod film_camera;
mod ground;
mod keys;
mod lamps;
mod lens;
mod light;
mod people;
mod rig;
mod solid;
mod viewpoint;

pub(crate) use birds::Birds;
pub use chase::{Chase, Followed, Following, Sight};
pub use film_camera::FilmCamera;
pub use lens::Lens;
pub use light::Sun;
pub(crate) use people::People;
pub use viewpoint::{CameraKey, Motion, Viewpoint};

use crate::insect::{Crowd, Insect};
use crate::look::Coat;
use crate::plan::{SHADOW_OPACITY, stacked};
use crate::primitive::Primitive;
use crate::rounded::Rounded;
use crate::{AgentShape, Color, Image, Painter, Style, WorldBox};
use bodies::{Agents, Stock};
use extent::Extent;
use glam::{DVec2, Vec2};
use ground::Ground;
use light::light;
use rig::Rig;
use solid::{Solid, container};
use throng_record::{Body, Frame, Setting};
use throng_render::{Light, Line, Picture, Scene};

/// The least radius of darts in the middle of the picture, in units of the layout.
const LEAST_DART: f32 = 3.4;
/// The height of walls, metres; where agents fly, the least height.
const WALL: f64 = 1.2;

/// The constant parts of the scene, and the viewpoint.
#[derive(Clone, Debug)]
pub(crate) struct SpaceScene {
    rig: Rig,
    pub lens: Lens,
    ground: Ground,
    solids: Vec<Solid>,
    set: Option<Solid>,
    /// The height of walls, metres.
    height: f64,
    /// The edges of containers.
    edges: Vec<Line>,
    light: Light,
    stock: Stock,
    /// The factor by which darts are enlarged.
    growth: f32,
    /// The radius of the largest body at the first moment, pixels.
    shown: f32,
    size: [u32; 2],
}

impl SpaceScene {
    /// Creates the scene of the ground in `view`, displayed between the pixels of `room`.
    pub(crate) fn new(
        setting: &Setting,
        style: &Style,
        unit: f32,
        view: WorldBox,
        first: &Frame,
        room: (Vec2, Vec2),
    ) -> Self {
        let extent = Extent::of(view, style.view.is_some(), setting, first);
        let mut rig = Rig::new(&style.viewpoint, &extent, style.height, room);
        let lens = rig.turn(first);
        let theme = &style.theme;
        // People can look over walls, and so can viewpoints.
        let height = if setting.in_space { extent.height.max(WALL) } else { WALL };
        let edge = |shell| container(shell, setting.origin, 0.9 * unit, theme.edge);
        let shown = |radii: &mut dyn Iterator<Item = f32>| radii.fold(0.0, f32::max) * lens.scale(rig.middle()) as f32;
        let darts = shown(&mut first.bodies.iter().filter(|body| body.basis.is_some()).map(|body| body.radius));
        let out = lens.eye - rig.middle();
        Self {
            lens,
            ground: Ground::new(setting, style, &extent, first, unit),
            solids: solids(setting, theme.obstacle, height),
            set: setting.set.as_ref().map(|set| Solid::set(set, setting.origin)),
            height,
            edges: setting.shells.iter().flat_map(edge).collect(),
            light: light(style, out, out.length() + extent.reach(), setting.in_space),
            stock: Stock::new(style.headings),
            growth: growth(LEAST_DART * unit, darts),
            shown: shown(&mut first.bodies.iter().map(|body| body.radius)),
            size: [style.width, style.height],
            rig,
        }
    }

    /// Takes the present obstacles.
    pub(crate) fn build(&mut self, setting: &Setting, style: &Style) {
        self.solids = solids(setting, style.theme.obstacle, self.height);
    }

    /// Returns the factor by which insects are enlarged.
    fn insects(&self, crowd: Crowd) -> f32 {
        growth(crowd.least, self.shown)
    }

    /// Moves the viewpoint to its place at a moment.
    pub(crate) fn turn(&mut self, frame: &Frame) {
        self.lens = self.rig.turn(frame);
    }

    /// Returns pixels per metre in the middle of the picture.
    pub(crate) fn scale(&self) -> f64 {
        self.lens.scale(self.rig.middle())
    }

    /// Returns the width of the grid's cells, metres; `None` without a grid.
    pub(crate) fn cell(&self) -> Option<f64> {
        self.ground.cell
    }
}

/// Returns what stands: obstacles, holes in the ground and surfaces; nothing if a set stands in their place.
fn solids(setting: &Setting, color: Color, height: f64) -> Vec<Solid> {
    if setting.is_replaced() {
        return Vec::new();
    }
    let holes = setting.walkable.iter().flat_map(|area| &area.holes);
    let obstacles = setting.obstacles.iter().flat_map(|obstacle| Solid::obstacle(obstacle, height, color));
    let holes = holes.map(|hole| Solid::prism(hole, [0.0, height], color));
    let shells = setting.shells.iter().filter_map(|shell| Solid::shell(shell, setting.origin, color));
    obstacles.chain(holes).chain(shells).collect()
}

/// Returns the factor by which something is enlarged that needs `least` pixels and has `shown`.
fn growth(least: f32, shown: f32) -> f32 {
    if shown > 0.0 { (least / shown).max(1.0) } else { 1.0 }
}

impl Painter {
    /// Returns the rendered picture, and the glow of lamps and the insects that it does not hide.
    pub(crate) fn scene(&self, stage: &SpaceScene, frame: &Frame) -> Vec<(&'static str, Vec<Primitive>)> {
        let mut bodies = stacked(frame);
        bodies.retain(|body| stage.lens.pixel(body.center()).is_some_and(|pixel| pixel.is_finite()));
        let (insects, others): (Vec<&Body>, Vec<&Body>) =
            bodies.into_iter().partition(|body| self.look.form(body) == AgentShape::Insect);
        let agents = Agents::new(others.into_iter(), stage, self, frame.time);
        let trails = self.trail_lines(&stage.lens, frame.time);
        let scene = Scene {
            ground: stage.ground.plane,
            areas: stage.ground.areas.clone(),
            bodies: stage
                .solids
                .iter()
                .chain(&stage.set)
                .map(Solid::body)
                .chain(agents.placed(stage, &self.look))
                .collect(),
            lines: stage
                .ground
                .lines(&stage.lens)
                .into_iter()
                .chain(stage.edges.iter().cloned())
                .chain(trails)
                .collect(),
            light: stage.light,
        };
        let picture = Picture::render(&scene, &stage.lens.view(), stage.size).expect("the size was checked");
        let crowd = self.crowd(frame);
        let mut lit = lamps::glows(&self.style.lamps, &stage.lens, &picture);
        lit.extend(self.swarm(stage, &insects, &picture, (frame, crowd)));
        let [width, height] = stage.size;
        let pixels = Primitive::Pixels(Image::of(width, height, picture.into_bytes()));
        vec![("scene", vec![pixels]), ("insects", lit)]
    }

    /// Returns shadows, streaks and bodies of insects, far to near.
    fn swarm(
        &self,
        stage: &SpaceScene,
        insects: &[&Body],
        picture: &Picture,
        (frame, crowd): (&Frame, Crowd),
    ) -> Vec<Primitive> {
        let lens = &stage.lens;
        let mut seen: Vec<&Body> = insects.iter().copied().filter(|body| !picture.hides(body.center())).collect();
        seen.sort_by(|a, b| lens.depth(b.center()).total_cmp(&lens.depth(a.center())));
        let shadows = insects.iter().filter_map(|body| self.shadow(body, stage, picture, crowd));
        let streaks = self.streaks(seen.iter().copied(), frame.time, crowd);
        let figure = |body: &&Body| {
            let (coat, haze) = (self.look.coat(body), lens.haze(body.center()));
            let coat = Coat { fill: coat.fill.mix(self.base(), haze), rim: coat.rim.mix(self.base(), haze) };
            Insect::of(body, stage.insects(crowd), coat, &self.projector(), frame.time).map(Primitive::Insect)
        };
        let figures = seen.iter().filter_map(figure);
        shadows.chain((!streaks.is_empty()).then_some(Primitive::Streaks(streaks))).chain(figures).collect()
    }

    /// Returns the shadow of an insect on the ground straight below it; `None` if something hides it.
    fn shadow(&self, body: &Body, stage: &SpaceScene, picture: &Picture, crowd: Crowd) -> Option<Primitive> {
        let (lens, ground) = (&stage.lens, body.center().with_z(0.0));
        if stage.ground.plane.is_none() || picture.hides(ground) {
            return None;
        }
        let opacity = SHADOW_OPACITY * (1.0 - lens.haze(ground)) * crowd.left;
        let radius = body.radius * stage.insects(crowd) * lens.scale(ground) as f32;
        Some(Primitive::Agent(Rounded::spot(lens.pixel(ground)?, 0.6 * radius, Color::rgb(0).alpha(opacity))))
    }

    /// Returns the trails at a time as lines.
    fn trail_lines(&self, lens: &Lens, now: f64) -> Vec<Line> {
        let seconds = f64::from(self.style.trails);
        let tracks = self.trails.tracks.values();
        tracks.map(|track| ground::trail(track, self.style.theme.goal, lens, (now, seconds))).collect()
    }
}

/// Returns the outline of a body on the ground.
fn footprint(body: &Body) -> Vec<DVec2> {
    /// The number of corners of a quarter circle.
    const QUARTER: usize = 5;
    let (core, radius) = (body.core.as_dvec2(), f64::from(body.radius));
    let ahead = DVec2::from_angle(f64::from(body.heading));
    let corner = |k: usize| {
        let out = DVec2::from_angle(
            (k / QUARTER) as f64 * std::f64::consts::FRAC_PI_2
                + (k % QUARTER) as f64 * std::f64::consts::FRAC_PI_2 / (QUARTER - 1) as f64,
        );
        let side = DVec2::from([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)][k / QUARTER]);
        body.position + ahead.rotate(core * side + out * radius)
    };
    (0..4 * QUARTER).map(corner).collect()
}
