//! A moment in perspective: objects in order from far to near, over ground with a grid.

mod chase;
mod dart;
mod ground;
mod lens;
mod shell;
mod solid;
mod viewpoint;

pub use chase::{Chase, Followed, Following, Sight};
pub use lens::Lens;
pub use viewpoint::Viewpoint;

use crate::insect::{Crowd, Insect};
use crate::look::Coat;
use crate::plan::{LEAST_RADIUS, SHADOW_OPACITY, middle, stacked};
use crate::primitive::Primitive;
use crate::rounded::{NOTCH_LEAST_RADIUS, Rounded};
use crate::trail::Trail;
use crate::{AgentShape, Color, Painter, Style, WorldBox, shape};
use dart::Dart;
use glam::{DVec2, Vec2};
use ground::Ground;
use shell::Hull;
use solid::{Face, Solid, Tone};
use throng_record::{Body, Frame, Setting};
use viewpoint::{Extent, Orbit};

/// The least radius of darts in the middle of the picture, in units of the layout.
const LEAST_DART: f32 = 3.4;
/// The least height of obstacles, metres; people can look over them.
const LEAST_HEIGHT: f64 = 1.2;
/// The length of pieces of faces, relative to the reach of the scene.
const PIECE: f64 = 0.08;

/// The constant parts of the scene, and the viewpoint.
#[derive(Clone, Debug)]
pub(crate) struct SpaceScene {
    orbit: Orbit,
    pub lens: Lens,
    ground: Ground,
    solids: Vec<Solid>,
    hulls: Vec<Hull>,
    tone: Tone,
    /// The length of pieces of faces, metres.
    piece: f64,
    /// The factor by which darts are enlarged.
    growth: f32,
    /// The radius of the largest body at the first moment, pixels.
    shown: f32,
    unit: f32,
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
        let extent = Extent::of(view, setting, first);
        let mut orbit = Orbit::new(&style.viewpoint, &extent, style.height, room);
        let lens = orbit.turn(first);
        let theme = &style.theme;
        let height = extent.height.max(LEAST_HEIGHT);
        let holes = setting.walkable.iter().flat_map(|area| &area.holes);
        let solids = setting.obstacles.iter().map(|obstacle| Solid::obstacle(obstacle, height));
        let solids = solids.chain(holes.map(|hole| Solid::prism(hole.clone(), 0.0, height))).collect();
        let shown = |radii: &mut dyn Iterator<Item = f32>| radii.fold(0.0, f32::max) * lens.scale(orbit.target) as f32;
        let darts = shown(&mut first.bodies.iter().filter(|body| body.basis.is_some()).map(|body| body.radius));
        let air = if setting.walkable.is_empty() { theme.ground } else { theme.outside };
        Self {
            orbit,
            lens,
            ground: Ground::new(setting, style, &extent, first),
            solids,
            hulls: setting.shells.iter().map(|shell| Hull::new(shell, setting.origin)).collect(),
            tone: Tone { fill: theme.obstacle, edge: theme.edge, dark: Color::rgb(0x1c2026), air },
            piece: PIECE * extent.reach(),
            growth: growth(LEAST_DART * unit, darts),
            shown: shown(&mut first.bodies.iter().map(|body| body.radius)),
            unit,
        }
    }

    /// Returns the factor by which insects are enlarged.
    fn insects(&self, crowd: Crowd) -> f32 {
        growth(crowd.least, self.shown)
    }

    /// Moves the viewpoint to its place at a moment.
    pub(crate) fn turn(&mut self, frame: &Frame) {
        self.lens = self.orbit.turn(frame);
    }

    /// Returns pixels per metre in the middle of the picture.
    pub(crate) fn scale(&self) -> f64 {
        self.lens.scale(self.orbit.middle())
    }

    /// Returns the width of the grid's cells, metres.
    pub(crate) fn cell(&self) -> f64 {
        self.ground.cell
    }

    /// Returns the ground if the viewpoint is fixed, because it is constant then; else nothing.
    pub(crate) fn ground(&self) -> Vec<Primitive> {
        if self.orbit.moves() { Vec::new() } else { self.ground.marks(&self.lens, self.unit) }
    }
}

/// Returns the factor by which something is enlarged that needs `least` pixels and has `shown`.
fn growth(least: f32, shown: f32) -> f32 {
    if shown > 0.0 { (least / shown).max(1.0) } else { 1.0 }
}

impl Painter {
    /// Returns the ground if the viewpoint moves; shadows; and everything above the ground, far to near.
    pub(crate) fn scene(&self, stage: &SpaceScene, frame: &Frame) -> Vec<(&'static str, Vec<Primitive>)> {
        let lens = &stage.lens;
        let ground = if stage.orbit.moves() { stage.ground.marks(lens, stage.unit) } else { Vec::new() };
        let mut bodies = stacked(frame);
        bodies.retain(|body| lens.pixel(body.center()).is_some_and(|pixel| pixel.is_finite()));
        let crowd = self.crowd(frame);
        let shadows = bodies.iter().map(|body| self.shadow(body, stage, crowd)).collect();
        let mut faces: Vec<Face> = Vec::new();
        stage.solids.iter().for_each(|solid| solid.faces(stage.tone, lens, stage.piece, stage.unit, &mut faces));
        stage.hulls.iter().for_each(|hull| hull.faces(stage.tone, lens, stage.piece, stage.unit, &mut faces));
        let figure = |body: &&Body| (lens.away(body.center()), self.figure(body, stage, (frame.time, crowd)));
        let bodies = bodies.iter().map(figure).collect();
        let streaks = if self.look.has(AgentShape::Insect) { self.streaks(frame, crowd) } else { Vec::new() };
        let scene = layered([self.trails(frame.time), streaks], faces, bodies);
        vec![("ground", ground), ("shadows", shadows), ("scene", scene)]
    }

    /// Returns the shadow of a body on the ground straight below it.
    fn shadow(&self, body: &Body, stage: &SpaceScene, crowd: Crowd) -> Primitive {
        let (center, lens) = (body.center(), &stage.lens);
        let ground = center.with_z(0.0);
        let fill = Color::rgb(0).alpha(SHADOW_OPACITY * (1.0 - lens.haze(ground)));
        if self.look.form(body) == AgentShape::Insect {
            let radius = body.radius * stage.insects(crowd) * lens.scale(ground) as f32;
            let (center, fill) =
                (lens.pixel(ground).unwrap_or(Vec2::NAN), fill.alpha(f32::from(fill.a) / 255.0 * crowd.left));
            return Primitive::Agent(Rounded::spot(center, 0.6 * radius, fill));
        }
        if let Some(basis) = body.basis.filter(|_| self.look.shape(body).is_none()) {
            return Dart::new(center, basis, body.radius * stage.growth).shadow(fill, lens);
        }
        let least = f64::from(LEAST_RADIUS) / lens.scale(ground);
        let ring = footprint(body, least).into_iter().map(|corner| corner.extend(0.0));
        Primitive::Area { rings: vec![lens.area(ring)], fill }
    }

    /// Returns a body as a dart, a ball, or a low block if it is oblong.
    fn figure(&self, body: &Body, stage: &SpaceScene, (time, crowd): (f64, Crowd)) -> Vec<Primitive> {
        let (lens, unit) = (&stage.lens, stage.unit);
        let (coat, haze) = (self.look.coat(body), lens.haze(body.center()));
        let coat = Coat { fill: coat.fill.mix(stage.tone.air, haze), rim: coat.rim.mix(stage.tone.air, haze) };
        if self.look.form(body) == AgentShape::Insect {
            let insect = Insect::of(body, stage.insects(crowd), coat, &self.projector(), time);
            return insect.map(Primitive::Insect).into_iter().collect();
        }
        if let Some(shape) = self.look.shape(body) {
            return shape::marks(shape, body, (&self.strides, time), coat, &self.projector());
        }
        let mut marks = Vec::new();
        if let Some(basis) = body.basis {
            Dart::new(body.center(), basis, body.radius * stage.growth).marks(&coat, lens, unit, &mut marks);
        } else if body.core == Vec2::ZERO {
            marks.push(Primitive::Agent(self.ball(body, coat, stage)));
        } else {
            let low = f64::from(body.altitude);
            let block = Solid::prism(footprint(body, 0.0), low, low + 2.0 * f64::from(body.shape().clearance_radius()));
            let tone = Tone { fill: coat.fill, edge: coat.rim, dark: stage.tone.dark, air: coat.fill };
            let mut faces = Vec::new();
            block.faces(tone, lens, f64::INFINITY, unit, &mut faces);
            faces.sort_by(|a, b| b.0.total_cmp(&a.0));
            marks.extend(faces.into_iter().flat_map(|(_, marks)| marks));
        }
        marks
    }

    /// Returns a body as a ball.
    fn ball(&self, body: &Body, coat: Coat, stage: &SpaceScene) -> Rounded {
        let (lens, center) = (&stage.lens, middle(body));
        let radius = ((f64::from(body.radius) * lens.scale(center)) as f32).max(LEAST_RADIUS);
        let ahead = DVec2::from_angle(f64::from(body.heading)).extend(0.0);
        let along = lens.direction(center, ahead).filter(|_| self.style.headings && radius >= NOTCH_LEAST_RADIUS);
        Rounded {
            center: lens.pixel(center).unwrap_or(Vec2::NAN),
            core: Vec2::ZERO,
            along: along.unwrap_or(Vec2::X),
            radius,
            fill: coat.fill,
            rim: coat.rim,
            rim_width: (0.13 * radius).clamp(0.6, 3.0 * stage.unit),
            notch: along.map(|_| self.style.theme.notch.alpha(0.92)),
        }
    }
}

/// Sorts everything from far to near. Between two faces, trails and then streaks are below bodies.
fn layered(trails: [Vec<Trail>; 2], mut faces: Vec<Face>, mut bodies: Vec<Face>) -> Vec<Primitive> {
    // The sort is stable: of two bodies at the same horizontal distance, the lower one is drawn first.
    faces.sort_by(|a, b| b.0.total_cmp(&a.0));
    bodies.sort_by(|a, b| b.0.total_cmp(&a.0));
    let [mut trails, mut streaks] =
        trails.map(|all| if faces.is_empty() { all } else { pieces(all) }.into_iter().peekable());
    let mut bodies = bodies.into_iter().peekable();
    let mut marks = Vec::new();
    let mut between = |far: f64, marks: &mut Vec<Primitive>| {
        for (all, mark) in [(&mut trails, Primitive::Trails as fn(_) -> _), (&mut streaks, Primitive::Streaks)] {
            let behind: Vec<Trail> = std::iter::from_fn(|| all.next_if(|trail| trail.ends[0].away > far)).collect();
            if !behind.is_empty() {
                marks.push(mark(behind));
            }
        }
        marks.extend(std::iter::from_fn(|| bodies.next_if(|body| body.0 > far)).flat_map(|body| body.1));
    };
    for (away, face) in faces {
        between(away, &mut marks);
        marks.extend(face);
    }
    between(f64::NEG_INFINITY, &mut marks);
    marks
}

/// Splits trails into segments, sorted from far to near.
fn pieces(trails: Vec<Trail>) -> Vec<Trail> {
    let each = |trail: &Trail| -> Vec<Trail> {
        trail.ends.windows(2).map(|ends| Trail { ends: ends.to_vec(), color: trail.color }).collect()
    };
    let mut pieces: Vec<Trail> = trails.iter().flat_map(each).collect();
    pieces.sort_by(|a, b| b.ends[0].away.total_cmp(&a.ends[0].away));
    pieces
}

/// Returns the outline of a body on the ground, with a radius of at least `least`.
fn footprint(body: &Body, least: f64) -> Vec<DVec2> {
    /// The number of corners of a quarter circle.
    const QUARTER: usize = 5;
    let (core, radius) = (body.core.as_dvec2(), f64::from(body.radius).max(least));
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
