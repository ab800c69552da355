//! The time of a picture of 1280 by 720 pixels with shadows, by the number of people.

#[path = "../examples/plaza/scene.rs"]
mod scene;

use scene::{Plaza, SIZE, view};
use throng_render::Picture;

fn main() {
    divan::main();
}

#[divan::bench(args = [0, 20, 200, 1000])]
fn people(bencher: divan::Bencher, count: u64) {
    let plaza = Plaza::new(count);
    let (scene, view) = (plaza.scene(), view());
    bencher.bench_local(|| Picture::render(divan::black_box(&scene), &view, SIZE));
}
