//! Draws fields and prints the time of each layer: `cargo run --release --example fields -- [FOLDER [WIDTHxHEIGHT]]`.

#[path = "shared/clock.rs"]
mod clock;

use clock::{now, report};
use glam::{DVec2, Vec3};
use std::path::PathBuf;
use std::sync::Arc;
use throng::field::Field;
use throng::{Goal, Obstacle, Walkable};
use throng_draw::{FlowLayer, FlowStyle, Painter, Style, Theme, WorldBox, sink::write_png};
use throng_field::{Anchor, Anchors, Critical, Sampled, Sketch, Stamp, Stroke};
use throng_record::{Flow, Frame, Setting};

type Fallible<T> = Result<T, Box<dyn std::error::Error>>;

fn main() -> Fallible<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".into()));
    let size = std::env::args().nth(2).unwrap_or_else(|| "1280x720".into());
    let (width, height) = size.split_once('x').ok_or("write WIDTHxHEIGHT")?;
    let base = Style { width: width.parse()?, height: height.parse()?, trails: 0.0, ..Style::default() };
    std::fs::create_dir_all(&folder)?;
    use FlowLayer::{Anchors, Arrows, Critical, Lic, Speed, Streamlines};
    let layers: [(&str, Vec<FlowLayer>); 7] = [
        ("texture", vec![Lic]),
        ("default", FlowStyle::default().layers),
        ("arrows", vec![Arrows, Anchors, Critical]),
        ("speed", vec![Speed, Streamlines]),
        ("speed-lic", vec![Speed, Lic, Critical]),
        ("speed-arrows", vec![Speed, Arrows]),
        ("streamlines", vec![Streamlines]),
    ];
    for (name, setting, view) in [vortex()?, street()?, valley()?, two()?] {
        for (kind, layers) in &layers {
            let flow = Some(FlowStyle::of(layers.clone()));
            let style = Style { view: Some(view), flow, ..base.clone() };
            write(&folder, &format!("{name}-{kind}"), &setting, &style)?;
        }
        let style = Style { view: Some(view), flow: Some(FlowStyle::default()), theme: Theme::dark(), ..base.clone() };
        write(&folder, &format!("{name}-dark"), &setting, &style)?;
    }
    Ok(())
}

fn write(folder: &std::path::Path, name: &str, setting: &Setting, style: &Style) -> Fallible<()> {
    let mut painter = Painter::new(setting, style, &Frame::default())?;
    let start = now();
    let image = painter.paint(&Frame::default()).clone();
    report(name, 1, start);
    Ok(write_png(folder.join(format!("{name}.png")), &image)?)
}

fn around(half: DVec2) -> WorldBox {
    WorldBox { min: -half, max: half }
}

fn still(field: impl Field + 'static, anchors: Vec<Anchor>) -> Vec<Flow> {
    vec![Flow { still: true, anchors, ..Flow::of(Arc::new(field)) }]
}

/// Returns a vortex around a pond: the speed has its maximum 5 m from the centre.
fn vortex() -> Fallible<(&'static str, Setting, WorldBox)> {
    let whirl = |place: Vec3, _: f64| {
        let distance = place.truncate().length();
        Vec3::Z.cross(place).normalize_or_zero() * 1.4 * (-((distance - 5.0) / 5.0).powi(2)).exp()
    };
    let obstacles = vec![Obstacle::Circle { center: DVec2::ZERO, radius: 2.0 }];
    let setting = Setting { title: "Vortex".into(), flows: still(whirl, Vec::new()), obstacles, ..Setting::default() };
    Ok(("vortex", setting, around(DVec2::new(16.0, 9.0))))
}

/// Returns the street of docs/fields.md, between houses.
fn street() -> Fallible<(&'static str, Setting, WorldBox)> {
    let points = vec![DVec2::ZERO, DVec2::new(0.0, 20.0), DVec2::new(20.0, 20.0)];
    let anchors = Stroke { points, ..Stroke::default() }.anchors()?;
    let field = Anchors::new(&anchors, Sketch { fade: Some(6.0), max_speed: 1.5, ..Sketch::default() })?;
    let field = Sampled::of(&field, DVec2::splat(-10.0), DVec2::splat(30.0), 0.5, 0.0)?;
    let corner = |x: f64, y: f64| DVec2::new(x, y);
    let outer = vec![corner(-8.0, -4.0), corner(28.0, -4.0), corner(28.0, 28.0), corner(-8.0, 28.0)];
    let holes = vec![vec![corner(8.0, -4.0), corner(8.0, 13.0), corner(24.0, 13.0), corner(24.0, -4.0)]];
    let setting = Setting {
        title: "Strokes round a corner".into(),
        walkable: vec![Walkable { outer, holes }],
        goals: vec![Goal::Point { at: corner(22.0, 20.0), tolerance: 1.0 }],
        flows: still(field, anchors),
        ..Setting::default()
    };
    Ok(("street", setting, WorldBox { min: corner(-17.0, -5.0), max: corner(37.0, 29.0) }))
}

/// Returns all kinds of critical points between two walls.
fn valley() -> Fallible<(&'static str, Setting, WorldBox)> {
    let stamp =
        |x: f64, y: f64, kind: Critical, speed: f64| Stamp { place: DVec2::new(x, y), kind, radius: 3.0, speed };
    let stamps = [
        stamp(-10.0, 4.0, Critical::Center, 1.2),
        stamp(0.0, -1.0, Critical::Saddle, 1.0),
        stamp(10.0, 4.0, Critical::Sink, 1.2),
        stamp(-9.0, -5.0, Critical::Source, 1.0),
    ];
    let mut anchors = Vec::new();
    for stamp in stamps {
        anchors.extend(stamp.anchors()?);
    }
    let drain = DVec2::new(10.0, -5.0);
    let spiral = |index: usize| {
        let out = DVec2::from_angle(index as f64 * std::f64::consts::FRAC_PI_4);
        Anchor::new(drain + out * 3.0, out.perp() * 1.1 - out * 0.5)
    };
    anchors.extend((0..8).map(spiral));
    let field = Anchors::new(&anchors, Sketch { fade: Some(5.0), max_speed: 2.0, ..Sketch::default() })?;
    let wall = |points: &[(f64, f64)]| Obstacle::Wall { points: points.iter().map(|&p| p.into()).collect() };
    let obstacles = vec![
        wall(&[(-4.0, 8.0), (-4.0, 3.0)]),
        Obstacle::Polygon { corners: vec![DVec2::new(4.0, -7.5), DVec2::new(5.5, -7.5), DVec2::new(5.0, -3.0)] },
    ];
    let setting =
        Setting { title: "Saddle, sink, centre".into(), obstacles, flows: still(field, anchors), ..Setting::default() };
    Ok(("valley", setting, around(DVec2::new(16.0, 9.0))))
}

/// Returns two crossing groups, each with its own field.
fn two() -> Fallible<(&'static str, Setting, WorldBox)> {
    let east =
        |place: Vec3, _: f64| Vec3::new(1.2, 0.5 * (0.3 * place.x).sin(), 0.0) * (-(place.y / 4.0).powi(2)).exp();
    let north = |place: Vec3, _: f64| Vec3::new(0.3, 1.0, 0.0) * (-((place.x - 0.2 * place.y) / 4.0).powi(2)).exp();
    let mut flows = still(east, Vec::new());
    flows.extend(still(north, Vec::new()));
    flows[1].groups = vec![1];
    flows[0].groups = vec![0];
    let groups = vec!["eastwards".into(), "northwards".into()];
    let setting = Setting { title: "Two fields".into(), groups, flows, ..Setting::default() };
    Ok(("two", setting, around(DVec2::new(16.0, 9.0))))
}
