//! Fields on the ground.

use super::common::{elements, moment, setting, style};
use glam::{DVec2, Vec2, Vec3};
use std::f32::consts::{PI, TAU};
use std::sync::Arc;
use throng::Walkable;
use throng::field::{Adaptive, Field};
use throng_draw::{Color, FlowLayer, FlowStyle, Image, Painter, Projection, Style};
use throng_field::Anchor;
use throng_record::{AdaptedField, Flow, Frame, Setting};

fn place(field: impl Field + 'static) -> Setting {
    let flows = vec![Flow { still: true, ..Flow::of(Arc::new(field)) }];
    Setting { flows, goals: Vec::new(), ..setting() }
}

fn drawing(layers: &[FlowLayer]) -> Style {
    Style { flow: Some(FlowStyle::of(layers)), ..style() }
}

fn picture(setting: &Setting, style: &Style) -> Image {
    Painter::new(setting, style, &Frame::default()).unwrap().paint(&Frame::default()).clone()
}

/// Returns a picture of the same place without fields.
fn bare(setting: &Setting, style: &Style) -> Image {
    picture(&Setting { flows: Vec::new(), ..setting.clone() }, style)
}

/// Returns the darkness of a pixel, 0 to 765.
fn dark(image: &Image, x: u32, y: u32) -> f32 {
    let Color { r, g, b, .. } = image.pixel(x, y);
    765.0 - f32::from(r) - f32::from(g) - f32::from(b)
}

/// Returns the pixels in which two pictures differ.
fn differ(a: &Image, b: &Image) -> Vec<Vec2> {
    let all = (0..a.height()).flat_map(|y| (0..a.width()).map(move |x| (x, y)));
    all.filter(|&(x, y)| a.pixel(x, y) != b.pixel(x, y)).map(|(x, y)| Vec2::new(x as f32, y as f32) + 0.5).collect()
}

#[test]
fn an_arrow_points_along_the_field() {
    for turn in 0..12 {
        let angle = TAU * (turn as f32 + 0.3) / 12.0;
        // The field is limited to the right of the middle, so that only one of two arrows is drawn.
        let east = move |at: Vec3, _: f64| if at.x > 0.5 { Vec2::from_angle(angle).extend(0.0) } else { Vec3::ZERO };
        let setting = Setting { obstacles: Vec::new(), ..place(east) };
        let style = Style { flow: Some(FlowStyle { spacing: 4.0, ..FlowStyle::of([FlowLayer::Arrows]) }), ..style() };
        let (with, without) = (picture(&setting, &style), bare(&setting, &style));
        let ink: Vec<(Vec2, f32)> = differ(&with, &without)
            .into_iter()
            .map(|at| (at, dark(&with, at.x as u32, at.y as u32) - dark(&without, at.x as u32, at.y as u32)))
            .collect();
        let total: f32 = ink.iter().map(|ink| ink.1).sum();
        let middle = ink.iter().map(|(at, ink)| *at * *ink).sum::<Vec2>() / total;
        let moment = |f: fn(Vec2) -> f32| ink.iter().map(|(at, ink)| f(*at - middle) * ink).sum::<f32>() / total;
        let (xx, xy, yy) = (moment(|d| d.x * d.x), moment(|d| d.x * d.y), moment(|d| d.y * d.y));
        let axis = Vec2::from_angle(0.5 * (2.0 * xy).atan2(xx - yy));
        let want = Vec2::new(angle.cos(), -angle.sin());
        assert!(axis.perp_dot(want).abs() < 2f32.to_radians().sin(), "{angle}: along {axis}, not {want}");
        // The head has most of the ink: from the centroid, the ink reaches farther back than forward.
        let (ahead, behind) = ink.iter().fold((0f32, 0f32), |(ahead, behind), (at, _)| {
            let along = (*at - middle).dot(want);
            (ahead.max(along), behind.min(along))
        });
        assert!(ahead + 2.0 < -behind, "{angle}: {ahead} ahead, {behind} behind");
    }
}

#[test]
fn nothing_is_drawn_where_a_field_is_zero() {
    let half = |at: Vec3, _: f64| if at.x > 0.0 { Vec3::new(1.0, 0.3 * at.y, 0.0) } else { Vec3::ZERO };
    for layer in FlowLayer::ALL {
        let style = drawing(&[layer]);
        let (with, without) = (picture(&place(half), &style), bare(&place(half), &style));
        let ink = differ(&with, &without);
        let some = matches!(layer, FlowLayer::Anchors | FlowLayer::Critical) || ink.len() > 100;
        assert!(some && ink.iter().all(|at| at.x > 77.0), "{layer:?}");
    }
}

#[test]
fn fields_are_under_obstacles_and_only_on_ground() {
    let whirl = |at: Vec3, _: f64| Vec3::Z.cross(at) + Vec3::X * 3.0;
    let outer = [(-5.0, -4.0), (6.0, -4.0), (6.0, 5.5), (-5.0, 5.5)].map(DVec2::from).to_vec();
    let hole = [(1.0, -3.0), (4.0, -3.0), (4.0, -1.0), (1.0, -1.0)].map(DVec2::from).to_vec();
    let setting = Setting { walkable: vec![Walkable { outer, holes: vec![hole] }], ..place(whirl) };
    for layer in [FlowLayer::Speed, FlowLayer::Lic, FlowLayer::Streamlines, FlowLayer::Arrows] {
        let style = drawing(&[layer]);
        let ink = differ(&picture(&setting, &style), &bare(&setting, &style));
        let metres = |at: &Vec2| Vec2::new((at.x - 80.0) / 10.0, (60.0 - at.y) / 10.0);
        let rim = match layer {
            // Arrows that begin on the ground can end on a rim.
            FlowLayer::Arrows => 1.4,
            _ => 0.3,
        };
        for at in ink.iter().map(metres) {
            assert!(at.distance(Vec2::new(0.0, 4.0)) > 1.0 - 0.2, "{layer:?} at {at}, on the obstacle");
            let (low, high) = (Vec2::new(-5.0, -4.0) - rim, Vec2::new(6.0, 5.5) + rim);
            assert!(at.cmpge(low).all() && at.cmple(high).all(), "{layer:?} at {at}, outside");
            let inside = at.cmpgt(Vec2::new(1.0, -3.0) + rim).all() && at.cmplt(Vec2::new(4.0, -1.0) - rim).all();
            assert!(!inside, "{layer:?} at {at}, in the hole");
        }
        assert!(ink.len() > 200, "{layer:?}");
    }
}

/// Returns the direction of least change of a texture around a pixel (structure tensor), radians from +x, rows going
/// down. Slopes are derivatives of a Gaussian, because differences of adjacent pixels are dominated by the grains.
fn grain(image: &Image, center: Vec2, reach: i32) -> f32 {
    const WIDE: i32 = 4;
    let bell = |k: i32| (-0.5 * (k as f32 / 1.4).powi(2)).exp();
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for y in center.y as i32 - reach..=center.y as i32 + reach {
        for x in center.x as i32 - reach..=center.x as i32 + reach {
            let (mut dx, mut dy) = (0.0, 0.0);
            for (j, i) in (-WIDE..=WIDE).flat_map(|j| (-WIDE..=WIDE).map(move |i| (j, i))) {
                let weighted = bell(i) * bell(j) * dark(image, (x + i) as u32, (y + j) as u32);
                (dx, dy) = (dx + i as f32 * weighted, dy + j as f32 * weighted);
            }
            (xx, xy, yy) = (xx + dx * dx, xy + dx * dy, yy + dy * dy);
        }
    }
    0.5 * (2.0 * xy).atan2(xx - yy) + PI / 2.0
}

/// Returns the angle between two lines.
fn between(a: f32, b: f32) -> f32 {
    let turn = (a - b).rem_euclid(PI);
    turn.min(PI - turn)
}

#[test]
fn the_texture_lies_along_the_field() {
    let style = Style { width: 320, height: 240, flow: Some(FlowStyle::of([FlowLayer::Lic])), ..style() };
    for turn in 0..12 {
        let angle = TAU * (turn as f32 + 0.15) / 12.0;
        let even = move |_: Vec3, _: f64| Vec2::from_angle(angle).extend(0.0);
        let image = picture(&Setting { obstacles: Vec::new(), ..place(even) }, &style);
        let off = between(grain(&image, Vec2::new(160.0, 120.0), 60), -angle).to_degrees();
        assert!(off < 3.0, "{off}° off at {angle}");
    }
    let whirl = |at: Vec3, _: f64| Vec3::Z.cross(at).normalize_or_zero();
    let image = picture(&Setting { obstacles: Vec::new(), ..place(whirl) }, &style);
    for turn in 0..12 {
        let out = Vec2::from_angle(TAU * turn as f32 / 12.0);
        let at = Vec2::new(160.0, 120.0) + out * 70.0;
        let off = between(grain(&image, at, 12), out.perp().to_angle()).to_degrees();
        assert!(off < 8.0, "{off}° off at {at}");
    }
}

#[test]
fn a_texture_is_the_same_every_time_and_no_two_fields_have_the_same() {
    let style = drawing(&[FlowLayer::Lic]);
    let east = |_: Vec3, _: f64| Vec3::X;
    let image = picture(&place(east), &style);
    assert_eq!(image, picture(&place(east), &style));
    let mut two = place(east);
    two.flows.extend(place(east).flows);
    assert_ne!(image, picture(&two, &style));
}

#[test]
fn only_changing_fields_are_redrawn() {
    let turning = |_: Vec3, time: f64| if time < 1.0 { Vec3::X } else { Vec3::Y };
    for still in [false, true] {
        let mut setting = place(turning);
        setting.flows[0].still = still;
        let style = drawing(&[FlowLayer::Streamlines]);
        let at = |time: f64| Frame { time, ..Frame::default() };
        let mut painter = Painter::new(&setting, &style, &at(0.0)).unwrap();
        let images = [0.0, 0.5, 2.0, 0.9].map(|time| painter.paint(&at(time)).clone());
        assert_eq!(images[0], images[1]);
        assert_eq!(images[0] == images[2], still);
        assert_eq!(images[0], images[3]);
    }
}

#[test]
fn a_trap_is_drawn_in_a_warning_tone_and_a_source_is_not() {
    let red = |image: &Image| {
        let all = (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (x, y)));
        let is_red = |&(x, y): &(u32, u32)| {
            let Color { r, g, b, .. } = image.pixel(x, y);
            r > 150 && g < 110 && b < 110
        };
        all.filter(is_red).map(|(x, y)| Vec2::new(x as f32, y as f32)).collect::<Vec<Vec2>>()
    };
    let style = drawing(&[FlowLayer::Critical]);
    let sink = Vec3::new(2.03, -1.07, 0.0);
    let sinks: [fn(Vec3) -> Vec3; 3] = [|d| -d, |d| Vec3::Z.cross(d), |d| Vec3::Z.cross(d) - 0.5 * d];
    for way in sinks {
        let image = picture(&place(move |at: Vec3, _: f64| way(at - sink)), &style);
        let found = red(&image);
        let middle = found.iter().sum::<Vec2>() / found.len() as f32;
        assert!(found.len() > 8 && middle.distance(Vec2::new(100.3, 70.7)) < 2.0, "{found:?}");
    }
    let others: [fn(Vec3) -> Vec3; 3] = [|d| d, |d| Vec3::new(d.x, -d.y, 0.0), |d| Vec3::Z.cross(d) + 0.5 * d];
    for way in others {
        let setting = place(move |at: Vec3, _: f64| way(at - sink));
        let image = picture(&setting, &style);
        assert!(red(&image).is_empty() && differ(&image, &bare(&setting, &style)).len() > 20);
    }
}

#[test]
fn anchors_are_where_they_are_relative_to_the_origin() {
    let anchors = vec![Anchor::new(DVec2::new(2.0, 1.0), DVec2::ZERO)];
    let flows = vec![Flow { anchors, ..Flow::of(Arc::new(|_: Vec3, _: f64| Vec3::X)) }];
    let setting = Setting { flows, origin: DVec2::new(-5.0, 1.0), goals: Vec::new(), ..setting() };
    let style = drawing(&[FlowLayer::Anchors]);
    let ink = differ(&picture(&setting, &style), &bare(&setting, &style));
    let middle = ink.iter().sum::<Vec2>() / ink.len() as f32;
    assert!(middle.distance(Vec2::new(80.0 - 30.0, 60.0 - 20.0)) < 0.5, "{middle}");
}

#[test]
fn invalid_and_extreme_fields_do_not_panic() {
    let everything = drawing(&FlowLayer::ALL);
    let drawn = |field: Arc<dyn Field>, style: &Style| {
        let setting = Setting { flows: vec![Flow::of(field)], goals: Vec::new(), ..setting() };
        differ(&picture(&setting, style), &bare(&setting, style)).len()
    };
    for nothing in [Vec3::NAN, Vec3::INFINITY, Vec3::ZERO] {
        assert_eq!(drawn(Arc::new(move |_: Vec3, _: f64| nothing), &everything), 0, "{nothing}");
    }
    for speed in [1e-30_f32, 1e-6, 1e6, 1e38, f32::MAX] {
        assert!(drawn(Arc::new(move |_: Vec3, _: f64| Vec3::X * speed), &everything) > 1000, "{speed}");
    }
    let half = |at: Vec3, _: f64| if at.x > 0.0 { Vec3::NAN } else { Vec3::Y * 1e20 };
    assert!(drawn(Arc::new(half), &everything) > 1000);
    let flow = FlowStyle { spacing: f32::NAN, strength: f32::NAN, max_speed: Some(f32::NAN), ..FlowStyle::default() };
    for (width, height) in [(16, 16), (300, 16), (16, 300)] {
        let style = Style { width, height, flow: Some(flow.clone()), legend: true, view: None, ..style() };
        drawn(Arc::new(|at: Vec3, _: f64| Vec3::Z.cross(at)), &style);
    }
}

#[test]
fn documents_show_fields_too_and_perspective_does_not() {
    let whirl = |at: Vec3, _: f64| Vec3::Z.cross(at) - 0.1 * at;
    let style = Style { legend: true, ..drawing(&FlowLayer::ALL) };
    let mut painter = Painter::new(&place(whirl), &style, &moment(0)).unwrap();
    let svg = painter.svg(&moment(0));
    assert!(elements(&svg) > 50 && svg.matches("data:image/png;base64,").count() == 2);
    assert!(svg.contains(r#"<g id="flow">"#) && svg.contains("spiral sink: a trap") && svg.contains("m/s"));
    let style = Style { projection: Some(Projection::Perspective), ..style };
    assert_eq!(picture(&place(whirl), &style), bare(&place(whirl), &style));
}

#[test]
fn fields_of_whirls_do_not_panic() {
    for case in 0..24u32 {
        // A pseudorandom number.
        let number = move |k: u32| ((case * 7 + k) as f32 * 12.9898).sin() * 43758.547 % 1.0;
        let field = move |at: Vec3, _: f64| {
            let whirl = |k: u32| {
                let off = at.truncate() - Vec2::new(9.0 * number(4 * k), 7.0 * number(4 * k + 1));
                let way = off.perp() * number(4 * k + 2) + off * number(4 * k + 3);
                way * (-0.2 * off.length_squared()).exp()
            };
            (0..case % 7).map(whirl).sum::<Vec2>().extend(0.0)
        };
        picture(&place(field), &drawing(&FlowLayer::ALL));
    }
}

/// A field to the east that adapts: where agents are, it turns to the north.
#[derive(Clone, Copy)]
struct Turning;

impl Field for Turning {
    fn velocity(&self, _: Vec3, _: f64) -> Vec3 {
        Vec3::X
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        Some(self)
    }
}

impl Adaptive for Turning {
    fn check(&self) -> Result<(), throng::Error> {
        Ok(())
    }

    fn interval(&self) -> f64 {
        0.5
    }

    fn memory(&self) -> Vec<f32> {
        vec![0.0]
    }

    fn notice(&self, memory: &mut [f32], people: &[Vec2]) {
        memory[0] += people.len() as f32;
    }

    fn adapted(&self, memory: &[f32]) -> Arc<dyn Field> {
        let turn = 0.7 * memory[0];
        Arc::new(move |_: Vec3, _: f64| Vec2::from_angle(turn).extend(0.0))
    }
}

fn adapting() -> Setting {
    let mut setting = place(Turning);
    setting.flows[0] = Flow { groups: vec![0], governs: true, still: false, ..setting.flows[0].clone() };
    setting
}

#[test]
fn a_field_that_adapts_is_drawn_as_it_is_now() {
    let style = drawing(&[FlowLayer::Arrows]);
    let setting = adapting();
    let mut painter = Painter::new(&setting, &style, &Frame::default()).unwrap();
    let east = painter.paint(&Frame::default()).clone();
    let north: Arc<dyn Field> = Arc::new(|_: Vec3, _: f64| Vec3::Y);
    let fields = vec![AdaptedField { group: 0, field: north }];
    let now = painter.paint(&Frame { time: 1.0, fields, ..Frame::default() }).clone();
    let wanted = picture(&Setting { flows: place(|_: Vec3, _: f64| Vec3::Y).flows, ..setting.clone() }, &style);
    assert!(now == wanted && now != east);
}

#[test]
fn recordings_draw_fields_that_adapt_to_the_recorded_agents() {
    let style = Style { goals: false, ..drawing(&[FlowLayer::Arrows]) };
    let setting = adapting();
    let empty = |frame: Frame| Frame { bodies: Vec::new(), ..frame };
    let mut painter = Painter::new(&setting, &style, &moment(0)).unwrap();
    // two agents at 0, 0.5 and 1 s turn it by 6 times 0.7
    (0..=25).for_each(|k| painter.follow(&moment(k)));
    let later = painter.paint(&empty(Frame { time: 1.01, ..moment(25) })).clone();
    let turned = move |_: Vec3, _: f64| Vec2::from_angle(0.7 * 6.0).extend(0.0);
    let wanted = Setting { flows: place(turned).flows, ..setting.clone() };
    let wanted = Painter::new(&wanted, &style, &moment(0)).unwrap().paint(&empty(moment(25))).clone();
    assert!(later == wanted);
}

#[test]
fn several_fields_are_drawn_near_the_agents_of_their_groups() {
    let style = Style { goals: false, ..drawing(&[FlowLayer::Lic]) };
    let flow = |velocity: Vec3, group: u32| Flow {
        still: true,
        groups: vec![group],
        ..Flow::of(Arc::new(move |_: Vec3, _: f64| velocity))
    };
    let (east, north) = (flow(Vec3::X, 0), flow(Vec3::Y, 1));
    let setting = |flows: Vec<Flow>| Setting { flows, obstacles: Vec::new(), goals: Vec::new(), ..setting() };
    let paint =
        |flows: Vec<Flow>, frame: &Frame| Painter::new(&setting(flows), &style, frame).unwrap().paint(frame).clone();
    // an agent of each group, at the left and at the right edge
    let mut frame = moment(0);
    (frame.bodies[0].position, frame.bodies[1].position) = (DVec2::new(-7.5, 5.0), DVec2::new(7.5, -5.0));
    let both = paint(vec![east.clone(), north.clone()], &frame);
    let bare = paint(Vec::new(), &frame);
    let ink = |image: &Image, left: bool| {
        let near = |at: &Vec2| if left { at.x < 15.0 && at.y < 25.0 } else { at.x > 145.0 && at.y > 95.0 };
        differ(image, &bare).into_iter().filter(near).count()
    };
    assert!(ink(&both, true) > 100 && ink(&both, false) > 100);
    // the picture near an agent shows the lines of its field: rows along the east, columns along the north
    let rough = |image: &Image, (x0, y0): (u32, u32)| {
        let pixels = (0..14).flat_map(move |x| (0..14).map(move |y| (x0 + x, y0 + y)));
        let change = |dx: u32, dy: u32| -> f32 {
            pixels.clone().map(|(x, y)| (dark(image, x + dx, y + dy) - dark(image, x, y)).abs()).sum()
        };
        change(1, 0) / change(0, 1)
    };
    assert!(rough(&both, (16, 2)) < 0.8, "{}", rough(&both, (16, 2)));
    assert!(rough(&both, (128, 100)) > 1.25, "{}", rough(&both, (128, 100)));
    // without agents in the picture, both count the same everywhere
    let none = Frame { bodies: Vec::new(), ..frame };
    assert!(differ(&paint(vec![east, north], &none), &paint(Vec::new(), &none)).len() > 10_000);
}
