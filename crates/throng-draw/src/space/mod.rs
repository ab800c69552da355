//! A moment in perspective: everything far to near, over a ground with a grid.

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
use crate::mark::Mark;
use crate::plan::{LEAST_RADIUS, SHADOW_OPACITY, middle, stacked};
use crate::rounded::{NOTCH_LEAST_RADIUS, Rounded};
use crate::trail::Trail;
use crate::{Color, Form, Painter, Style, WorldBox, shape};
use dart::Dart;
use glam::{DVec2, Vec2};
use ground::Ground;
use shell::Hull;
use solid::{Face, Solid, Tone};
use throng_record::{Body, Frame, Setting};
use viewpoint::{Extent, Orbit};

/// The least radius, in the middle of the picture, that darts are drawn with, in units of the layout.
const LEAST_DART: f32 = 3.4;
/// Obstacles are at least this high, metres: people look over them.
const LEAST_HEIGHT: f64 = 1.2;
/// Pieces of faces over how far everything reaches.
const PIECE: f64 = 0.08;

/// What stays the same from moment to moment, and where the eye is.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    orbit: Orbit,
    pub lens: Lens,
    ground: Ground,
    solids: Vec<Solid>,
    hulls: Vec<Hull>,
    tone: Tone,
    /// Length of the pieces that faces are drawn in, metres.
    piece: f64,
    /// How much larger than they are darts are drawn.
    growth: f32,
    /// The radius of the largest body at first, pixels.
    shown: f32,
    unit: f32,
}

impl Stage {
    /// What `view` of the ground holds, shown between two pixels.
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

    /// How much larger than they are insects are drawn.
    fn insects(&self, crowd: Crowd) -> f32 {
        growth(crowd.least, self.shown)
    }

    /// Takes the eye to where it is at a moment.
    pub(crate) fn turn(&mut self, frame: &Frame) {
        self.lens = self.orbit.turn(frame);
    }

    /// Pixels a metre in the middle of the picture.
    pub(crate) fn scale(&self) -> f64 {
        self.lens.scale(self.orbit.middle())
    }

    /// The width of the cells of the grid, metres.
    pub(crate) fn cell(&self) -> f64 {
        self.ground.cell
    }

    /// The ground, if the eye stays where it is: it never changes.
    pub(crate) fn ground(&self) -> Vec<Mark> {
        if self.orbit.moves() { Vec::new() } else { self.ground.marks(&self.lens, self.unit) }
    }
}

/// How much larger something is drawn that is to be seen at so many pixels, and is shown at so many.
fn growth(least: f32, shown: f32) -> f32 {
    if shown > 0.0 { (least / shown).max(1.0) } else { 1.0 }
}

impl Painter {
    /// The ground, if it seems to move; shadows; and everything that stands or flies, far to near.
    pub(crate) fn scene(&self, stage: &Stage, frame: &Frame) -> Vec<(&'static str, Vec<Mark>)> {
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
        let streaks = if self.look.has(Form::Insect) { self.streaks(frame, crowd) } else { Vec::new() };
        let scene = layered([self.trails(frame.time), streaks], faces, bodies);
        vec![("ground", ground), ("shadows", shadows), ("scene", scene)]
    }

    /// The shadow of a body, straight below it on the ground.
    fn shadow(&self, body: &Body, stage: &Stage, crowd: Crowd) -> Mark {
        let (center, lens) = (body.center(), &stage.lens);
        let ground = center.with_z(0.0);
        let fill = Color::rgb(0).alpha(SHADOW_OPACITY * (1.0 - lens.haze(ground)));
        if self.look.form(body) == Form::Insect {
            let radius = body.radius * stage.insects(crowd) * lens.scale(ground) as f32;
            let (center, fill) =
                (lens.pixel(ground).unwrap_or(Vec2::NAN), fill.alpha(f32::from(fill.a) / 255.0 * crowd.left));
            return Mark::Agent(Rounded::spot(center, 0.6 * radius, fill));
        }
        if let Some(basis) = body.basis.filter(|_| self.look.shape(body).is_none()) {
            return Dart::new(center, basis, body.radius * stage.growth).shadow(fill, lens);
        }
        let least = f64::from(LEAST_RADIUS) / lens.scale(ground);
        let ring = footprint(body, least).into_iter().map(|corner| corner.extend(0.0));
        Mark::Area { rings: vec![lens.area(ring)], fill }
    }

    /// A body: a dart, a ball, or a low block where it is oblong.
    fn figure(&self, body: &Body, stage: &Stage, (time, crowd): (f64, Crowd)) -> Vec<Mark> {
        let (lens, unit) = (&stage.lens, stage.unit);
        let (coat, haze) = (self.look.coat(body), lens.haze(body.center()));
        let coat = Coat { fill: coat.fill.mix(stage.tone.air, haze), rim: coat.rim.mix(stage.tone.air, haze) };
        if self.look.form(body) == Form::Insect {
            let insect = Insect::of(body, stage.insects(crowd), coat, &self.projector(), time);
            return insect.map(Mark::Insect).into_iter().collect();
        }
        if let Some(shape) = self.look.shape(body) {
            return shape::marks(shape, body, (&self.strides, time), coat, &self.projector());
        }
        let mut marks = Vec::new();
        if let Some(basis) = body.basis {
            Dart::new(body.center(), basis, body.radius * stage.growth).marks(&coat, lens, unit, &mut marks);
        } else if body.core == Vec2::ZERO {
            marks.push(Mark::Agent(self.ball(body, coat, stage)));
        } else {
            let low = f64::from(body.altitude);
            let block = Solid::prism(footprint(body, 0.0), low, low + 2.0 * f64::from(body.shape().girth()));
            let tone = Tone { fill: coat.fill, edge: coat.rim, dark: stage.tone.dark, air: coat.fill };
            let mut faces = Vec::new();
            block.faces(tone, lens, f64::INFINITY, unit, &mut faces);
            faces.sort_by(|a, b| b.0.total_cmp(&a.0));
            marks.extend(faces.into_iter().flat_map(|(_, marks)| marks));
        }
        marks
    }

    /// A ball.
    fn ball(&self, body: &Body, coat: Coat, stage: &Stage) -> Rounded {
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

/// Everything far to near. Between two faces, trails and then streaks lie below bodies.
fn layered(trails: [Vec<Trail>; 2], mut faces: Vec<Face>, mut bodies: Vec<Face>) -> Vec<Mark> {
    // a sort that keeps the order of equals: of two on one vertical, who comes first is the lower
    faces.sort_by(|a, b| b.0.total_cmp(&a.0));
    bodies.sort_by(|a, b| b.0.total_cmp(&a.0));
    let [mut trails, mut streaks] =
        trails.map(|all| if faces.is_empty() { all } else { pieces(all) }.into_iter().peekable());
    let mut bodies = bodies.into_iter().peekable();
    let mut marks = Vec::new();
    let mut between = |far: f64, marks: &mut Vec<Mark>| {
        for (all, mark) in [(&mut trails, Mark::Trails as fn(_) -> _), (&mut streaks, Mark::Streaks)] {
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

/// Each piece on its own, far to near.
fn pieces(trails: Vec<Trail>) -> Vec<Trail> {
    let each = |trail: &Trail| -> Vec<Trail> {
        trail.ends.windows(2).map(|ends| Trail { ends: ends.to_vec(), color: trail.color }).collect()
    };
    let mut pieces: Vec<Trail> = trails.iter().flat_map(each).collect();
    pieces.sort_by(|a, b| b.ends[0].away.total_cmp(&a.ends[0].away));
    pieces
}

/// The outline of a body on the ground, at least so large.
fn footprint(body: &Body, least: f64) -> Vec<DVec2> {
    /// Corners of a quarter of a circle.
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
