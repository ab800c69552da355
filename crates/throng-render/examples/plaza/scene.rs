//! A plaza with walls, glass, benches and walking people.

use glam::{DVec2, DVec3, Mat3, Vec2, Vec3};
use throng_figure::{Level, Look, Mesh as Figure, Person, Sample, Skeleton, Walk};
use throng_render::{Area, Body, Line, LineEnd, Material, Mesh, Scene, View, linear};

/// The size of the picture, pixels.
pub const SIZE: [u32; 2] = [1280, 720];

/// Returns the view.
pub fn view() -> View {
    View::look(DVec3::new(-17.0, -21.0, 6.5), DVec3::new(-1.0, -1.0, 0.5), 0.6, SIZE)
}

/// The meshes of the plaza.
pub struct Plaza {
    people: Vec<(Mesh<'static>, DVec3)>,
    walls: Vec<(Mesh<'static>, Material)>,
}

fn rectangle(x: f32, y: f32, wide: f32, deep: f32) -> Vec<Vec2> {
    vec![Vec2::new(x, y), Vec2::new(x + wide, y), Vec2::new(x + wide, y + deep), Vec2::new(x, y + deep)]
}

impl Plaza {
    /// Creates a plaza with this many people.
    pub fn new(count: u64) -> Self {
        let prism = |x: f32, y: f32, wide: f32, deep: f32, low: f32, high: f32| {
            Mesh::prism(&[rectangle(x, y, wide, deep)], low, high)
        };
        let walls = vec![
            (prism(-24.0, 14.0, 18.0, 0.4, 0.0, 4.2), Material::plaster()),
            (prism(-3.0, 14.0, 27.0, 0.4, 0.0, 4.2), Material::plaster()),
            (prism(-6.0, 14.0, 3.0, 0.4, 2.6, 4.2), Material::plaster()),
            (prism(-24.0, 14.0, 48.0, 9.0, 4.2, 4.6), Material::concrete()),
            (prism(-11.0, -9.0, 5.0, 0.06, 0.0, 2.4), Material::glass()),
            (prism(-14.0, -11.0, 2.4, 0.5, 0.0, 0.45), Material::wood()),
            (prism(-9.0, -11.5, 2.4, 0.5, 0.0, 0.45), Material::wood()),
            (prism(12.0, 2.0, 0.6, 0.6, 0.0, 4.0), Material::concrete()),
            (prism(12.0, -6.0, 0.6, 0.6, 0.0, 4.0), Material::concrete()),
        ];
        Self { people: people(&view(), count), walls }
    }

    /// Returns the scene.
    pub fn scene(&self) -> Scene<'_> {
        let mut bodies: Vec<Body<'_>> =
            self.walls.iter().map(|(mesh, material)| Body::standing(mesh, DVec3::ZERO, 0.0, *material)).collect();
        bodies.extend(self.people.iter().map(|(mesh, place)| Body {
            mesh,
            place: *place,
            turn: Mat3::IDENTITY,
            material: Material::plain(Vec3::ONE),
            thin: false,
        }));
        let end = |x: f64| LineEnd {
            at: DVec3::new(x, -9.0 + 0.4 * x.sin(), 0.0),
            width: 3.0,
            opacity: ((x + 20.0) / 30.0) as f32,
        };
        let lawn = rectangle(-14.0, -9.0, 6.0, 4.0).iter().map(|corner| corner.as_dvec2()).collect();
        let line = (0..60).map(|k| end(-20.0 + 0.5 * f64::from(k))).collect();
        Scene {
            ground: Some(Material::paving()),
            areas: vec![Area::new(&[lawn], Material::plain(linear(0x9fb58c)))],
            bodies,
            lines: vec![Line { ends: line, color: linear(0x3060c0), flat: true }],
            ..Scene::default()
        }
    }
}

/// Returns the meshes of walking people, with their places.
fn people(view: &View, count: u64) -> Vec<(Mesh<'static>, DVec3)> {
    let figure = |number: u64| {
        let person = Person::new(3, number);
        let along = (number % 20) as f64 * 2.1 - 20.0 + (number as f64 * 1.7).sin();
        let across = (number / 20) as f64 * 1.9 - 7.0 + (number as f64 * 2.9).cos() * 0.6;
        let (side, speed) = if number.is_multiple_of(2) { (1.0, 1.3) } else { (-1.0, 1.1) };
        let sample = |moment: u32| {
            let time = f64::from(moment) / 10.0;
            let position = DVec2::new(along + side * speed * (time - 2.0), across + 0.2 * (time + number as f64).sin());
            Sample { time, position, heading: if side > 0.0 { 0.0 } else { std::f64::consts::PI } }
        };
        let samples: Vec<Sample> = (0..40).map(sample).collect();
        let walk = Walk::recorded(&person, &samples).expect("the samples are finite");
        let pose = walk.pose(2.0);
        let skeleton = Skeleton::new(&person);
        let place = DVec3::new(pose.hips.x, pose.hips.y, 0.0);
        let height = f64::from(view.focal) * person.height / view.eye.distance(place);
        let level = Level::for_height(height);
        let figure = Figure::new(person.build, level);
        let (positions, normals) = figure.skinned(&skeleton, person.height, &skeleton.world(&pose), place);
        let color = |[r, g, b]: [u8; 3]| linear(u32::from_be_bytes([0, r, g, b]));
        let look = Look::new(person.look);
        let colors: Vec<Vec3> = figure.colours(&look).into_iter().map(color).collect();
        (Mesh::new(positions, normals, colors, figure.triangles_of(&look)).expect("figures are whole"), place)
    };
    (0..count).map(figure).collect()
}
