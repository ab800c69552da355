//! The reference work with every local model. An item is a move of an agent by a step.

use divan::Bencher;
use divan::counter::ItemsCount;
use std::sync::Arc;
use throng::Group;
use throng::avoid::{
    AnticipationVelocity, Avo, ClearPath, CollisionFreeSpeed, Hrvo, LocalModel, Moussaid2009, NoAvoidance, Orca,
    Orca3d, PowerLaw, Rvo, RvoLab, SocialForce, Vo,
};
use throng_bench::{Crowd, lap, work};

fn main() {
    divan::main();
}

const MODELS: [&str; 15] = [
    "none",
    "orca",
    "orca_3d",
    "avo",
    "hrvo",
    "clearpath",
    "vo",
    "rvo",
    "rvo, 250 drawn",
    "rvo_lab",
    "collision_free_speed",
    "anticipation_velocity",
    "social_force",
    "moussaid_2009",
    "power_law",
];

#[divan::bench(args = MODELS, sample_count = 10, sample_size = 1)]
fn crossing_of_10000(bencher: Bencher, name: &str) {
    let model: Arc<dyn LocalModel> = match name {
        "orca" => Arc::new(Orca::default()),
        "orca_3d" => Arc::new(Orca3d::default()),
        "avo" => Arc::new(Avo::default()),
        "hrvo" => Arc::new(Hrvo::default()),
        "clearpath" => Arc::new(ClearPath::default()),
        "vo" => Arc::new(Vo::default()),
        "rvo" => Arc::new(Rvo::default()),
        "rvo, 250 drawn" => Arc::new(Rvo { candidates: 250, ..Rvo::default() }),
        "rvo_lab" => Arc::new(RvoLab),
        "collision_free_speed" => Arc::new(CollisionFreeSpeed::default()),
        "anticipation_velocity" => Arc::new(AnticipationVelocity::default()),
        "social_force" => Arc::new(SocialForce::default()),
        "moussaid_2009" => Arc::new(Moussaid2009::default()),
        "power_law" => Arc::new(PowerLaw::default()),
        _ => Arc::new(NoAvoidance),
    };
    let crowd = work("crossing").expect("a work").crowd(10_000).expect("a work of pedestrians");
    let mut world = crowd.world(Group { model, ..Crowd::interaction() }, 5.0).expect("the parameters are valid");
    lap(&mut world, 20, || true);
    bencher.counter(ItemsCount::new(crowd.people.len())).bench_local(|| world.step());
}
