//! Hashes of the choices of each model in random situations, and of its reasons.

use crate::avoid::common::other;
use crate::avoid::repulsion::edges_of;
use crate::draw::Draw;
use crate::results::Results;
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::Obstacle;
use throng::avoid::{
    AnticipationVelocity, Avo, AvoidanceInput, AvoidanceNeighbour, BuiltFrom, ClearPath, CollisionFreeSpeed, Hrvo,
    LocalModel, Moussaid2009, NearDisc, NearEdge, NoAvoidance, Orca, Orca3d, Outline, PowerLaw, Rng, Rvo, RvoLab,
    SocialForce, Vo, Workspace,
};
use throng::space::{Core, Disc};

fn models() -> Vec<(&'static str, Arc<dyn LocalModel>)> {
    let kinodynamic = Rvo { kinodynamic: true, weight: 2.0, responsibility: 0.7, ..Rvo::default() };
    let lab_rvo = Rvo { candidates: 60, braking: true, ..Rvo::default() };
    let long = Orca { time_horizon: 4.0, time_horizon_obstacles: 3.0, ..Orca::default() };
    vec![
        ("anticipation velocity", Arc::new(AnticipationVelocity::default())),
        ("avo", Arc::new(Avo::default())),
        ("avo, slow", Arc::new(Avo { delay: 1.1, time_horizon: 4.0, ..Avo::default() })),
        ("clearpath", Arc::new(ClearPath::default())),
        ("collision-free speed", Arc::new(CollisionFreeSpeed::default())),
        ("hrvo", Arc::new(Hrvo::default())),
        ("moussaid", Arc::new(Moussaid2009::default())),
        ("orca", Arc::new(Orca::default())),
        ("orca, turning", Arc::new(Orca { turning_bias: 3.0, ..Orca::default() })),
        ("orca, from preferred", Arc::new(Orca { built_from: BuiltFrom::Preferred, ..long })),
        ("orca, from zero", Arc::new(Orca { built_from: BuiltFrom::Zero, ..long })),
        ("orca in space", Arc::new(Orca3d::default())),
        ("orca in space, flat", Arc::new(Orca3d { vertical_scale: 2.5, ..Orca3d::default() })),
        ("power law", Arc::new(PowerLaw::default())),
        ("rvo", Arc::new(Rvo::default())),
        ("rvo, kinodynamic", Arc::new(kinodynamic)),
        ("rvo, random", Arc::new(lab_rvo)),
        ("rvo of the lab", Arc::new(RvoLab)),
        ("social force", Arc::new(SocialForce::default())),
        ("vo", Arc::new(Vo::default())),
        ("none", Arc::new(NoAvoidance)),
    ]
}

/// An agent, other agents, walls and pillars.
struct Situation {
    view: AvoidanceInput<'static>,
    neighbours: Vec<AvoidanceNeighbour>,
    edges: Vec<NearEdge>,
    discs: Vec<NearDisc>,
}

fn number(draw: &mut Draw, low: f64, high: f64) -> f32 {
    draw.between(low, high) as f32
}

fn vector(draw: &mut Draw, range: f64) -> Vec2 {
    draw.point(DVec2::splat(-range), DVec2::splat(range)).as_vec2()
}

fn core(draw: &mut Draw) -> Core {
    let half = [Vec2::ZERO, Vec2::new(0.0, 0.15), Vec2::new(0.6, 0.2)][draw.index(3)];
    Core::new(DVec2::ZERO, number(draw, -3.0, 3.0), half)
}

fn neighbour(draw: &mut Draw, own: &Core, reach: f64) -> AvoidanceNeighbour {
    let outline = if draw.index(3) == 0 { Outline::between(own, &core(draw)) } else { Outline::POINT };
    let (offset, velocity) = (vector(draw, reach), vector(draw, 1.2));
    // a tenth of the neighbours is at exactly the same place, or stands
    let (offset, velocity) = match draw.index(20) {
        0 => (Vec2::ZERO, velocity),
        1 => (offset, Vec2::ZERO),
        _ => (offset, velocity),
    };
    let share = draw.one_of(&[0.0, 0.5, 1.0, 0.3]);
    AvoidanceNeighbour {
        above: draw.one_of(&[0.0, 0.3, -1.0]),
        vertical_velocity: number(draw, -0.3, 0.3),
        preferred: vector(draw, 1.2),
        outline,
        aside: vector(draw, 1.0).normalize(),
        ..other(offset, velocity, number(draw, 0.2, 0.9), share)
    }
}

fn situation(draw: &mut Draw) -> Situation {
    let own = core(draw);
    // from sparse to packed
    let reach = draw.one_of(&[0.8, 2.0, 5.0]);
    let count = draw.index(8);
    let mut neighbours: Vec<_> = (0..count).map(|_| neighbour(draw, &own, reach)).collect();
    neighbours.sort_by(|a, b| a.offset.length().total_cmp(&b.offset.length()));
    let place = DVec2::new(draw.between(-2.0, 2.0), draw.between(-2.0, 2.0));
    let obstacle = match draw.index(6) {
        0 => Some(Obstacle::Wall { points: (0..3).map(|_| place + vector(draw, 4.0).as_dvec2()).collect() }),
        1 => Some(Obstacle::rectangle(place, DVec2::new(1.5, 0.5), draw.between(0.0, 3.0))),
        2 => Some(Obstacle::Wall { points: vec![place, place] }),
        _ => None,
    };
    let mut edges = obstacle.map_or(vec![], |obstacle| edges_of(&obstacle, DVec2::ZERO));
    edges.sort_by(|a, b| a.edge.nearest(DVec2::ZERO).length().total_cmp(&b.edge.nearest(DVec2::ZERO).length()));
    let pillars = if draw.index(4) == 0 { 1 + draw.index(2) } else { 0 };
    let discs = (0..pillars).map(|_| {
        let (center, radius) = (vector(draw, 2.5), draw.between(0.0, 0.7));
        let outline =
            if own.half == DVec2::ZERO { Outline::POINT } else { Outline::between(&own, &Core::point(DVec2::ZERO)) };
        NearDisc { offset: center, disc: Disc { center: center.as_dvec2(), radius }, outline }
    });
    let discs = discs.collect();
    let preferred = vector(draw, 1.3);
    let view = AvoidanceInput {
        velocity: if draw.index(5) == 0 { Vec2::ZERO } else { vector(draw, 1.3) },
        heading: number(draw, -3.0, 3.0),
        preferred: if draw.index(8) == 0 { Vec2::ZERO } else { preferred },
        vertical_velocity: number(draw, -0.3, 0.3),
        preferred_vertical_velocity: number(draw, -0.3, 0.3),
        radius: number(draw, 0.1, 0.5),
        max_speed: number(draw, 1.0, 2.0),
        max_acceleration: draw.one_of(&[f32::INFINITY, 5.0, 1.0]),
        tracking_error: draw.one_of(&[0.0, 0.0, 0.1]),
        max_turn_rate: draw.one_of(&[f32::INFINITY, 1.0]),
        margin: draw.one_of(&[1.0, 1.03]),
        step: number(draw, 0.02, 0.2),
        rng: Rng { seed: draw.bits(), number: draw.index(9) as u32, step: draw.bits() },
        ..AvoidanceInput::default()
    };
    Situation { view, neighbours, edges, discs }
}

#[test]
fn choices_and_explanations_are_as_kept() {
    let mut results = Results::default();
    for (name, model) in models() {
        let (mut draw, mut workspace) = (Draw::new(5), Workspace::default());
        for _ in 0..400 {
            let situation = situation(&mut draw);
            let Situation { neighbours, edges, discs, .. } = &situation;
            let view = AvoidanceInput { neighbours, edges, discs, ..situation.view };
            results.add(name, &model.velocity(&view, &mut workspace));
            results.add(name, &model.velocity_in_space(&view, &mut workspace));
            results.add(name, &model.explain(&view, &mut workspace));
            results.add(name, &model.wall_range(view.radius, view.max_speed));
        }
        results.add(
            name,
            &(model.looks_in_space(), model.avoids(), model.relaxes(), model.parts_bodies(), model.is_random()),
        );
    }
    results.assert_kept("all/avoid/kept.txt");
}
