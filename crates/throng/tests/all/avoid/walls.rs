//! The range of walls in models: walls beyond it change nothing, walls within it do.

use crate::avoid::repulsion::{edges_of, models};
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::Obstacle;
use throng::avoid::{Avo, AvoidanceInput, ClearPath, Hrvo, LocalModel, Orca, Orca3d, Vo, Workspace};

/// The chosen velocity of an agent with a radius of 0.2 m that walks at 1.5 m/s along x towards a wall across its way,
/// with that velocity preferred.
fn chosen(model: &dyn LocalModel, distance: f64) -> Vec2 {
    let points = vec![DVec2::new(distance, -40.0), DVec2::new(distance, 40.0)];
    let edges = edges_of(&Obstacle::Wall { points }, DVec2::ZERO);
    let velocity = Vec2::new(1.5, 0.0);
    let view = AvoidanceInput {
        velocity,
        preferred: velocity,
        radius: 0.2,
        max_speed: 1.5,
        edges: &edges,
        ..AvoidanceInput::default()
    };
    model.velocity(&view, &mut Workspace::default())
}

/// The world leaves out walls beyond [`LocalModel::wall_range`]. `nearer` is a part of that range within which a wall
/// has an effect: repulsion that falls off exponentially has an effect only much nearer. The lab's model weighs all
/// walls that it gets.
#[test]
fn walls_count_up_to_the_range_of_the_model_and_no_farther() {
    let horizons: [Arc<dyn LocalModel>; 6] = [
        Arc::new(Vo::default()),
        Arc::new(Hrvo::default()),
        Arc::new(ClearPath::default()),
        Arc::new(Orca::default()),
        Arc::new(Orca3d::default()),
        Arc::new(Avo::default()),
    ];
    let horizons = horizons.into_iter().map(|model| (model, 0.9));
    for (model, nearer) in horizons.chain(models().map(|model| (model, 0.3))) {
        let range = f64::from(model.wall_range(0.2, 1.5));
        let free = chosen(&*model, 1e4);
        let [beyond, within] = [1.01 * range, nearer * range].map(|distance| chosen(&*model, distance).distance(free));
        assert!(beyond < 2e-3, "{model:?}: {beyond} m/s by a wall beyond {range} m");
        assert!(within > 1e-4, "{model:?}: {within} m/s by a wall within {range} m");
    }
}
