//! Agents as shapes.

mod common;

use common::{moment, setting, style};
use glam::{DVec2, DVec3, Vec2};
use throng_draw::{Form, Image, Painter, Projection, Shape, Style};
use throng_record::{Frame, Setting};

fn place() -> Setting {
    Setting { obstacles: Vec::new(), goals: Vec::new(), ..setting() }
}

/// Somebody alone who walks along +x.
fn alone(x: f64) -> Frame {
    let mut frame = moment(0);
    frame.bodies.truncate(1);
    let body = &mut frame.bodies[0];
    (body.position, body.radius, body.core, body.heading) = (DVec2::new(x, 0.0), 0.25, Vec2::ZERO, 0.0);
    (body.altitude, body.basis, body.velocity) = (0.0, None, Vec2::X);
    frame
}

fn in_space(form: Form) -> Style {
    // large enough for nobody to be drawn larger than they are
    let (width, height, projection) = (800, 600, Some(Projection::Perspective));
    Style { width, height, forms: vec![form; 2], projection, trails: 0.0, legend: false, ..style() }
}

fn differ(a: &Image, b: &Image) -> usize {
    a.data().chunks_exact(4).zip(b.data().chunks_exact(4)).filter(|(a, b)| a != b).count()
}

#[test]
fn a_figure_stands_on_its_place_and_is_as_tall_as_a_person() {
    let frame = alone(0.0);
    let nobody = Frame { bodies: Vec::new(), ..frame.clone() };
    let painted = |form: Form, up: f64| {
        let mut painter = Painter::new(&place(), &in_space(form), &frame).unwrap();
        let at = painter.pixel(DVec3::new(0.0, 0.0, up)).unwrap();
        let [with, bare] = [&frame, &nobody].map(|frame| painter.paint(frame).pixel(at.x as u32, at.y as u32));
        with != bare
    };
    // the head of one with a radius of 0.25 m is from 1.4 to 1.65 m, and nothing is above
    assert!(painted(Form::Shaped(Shape::Walker), 1.5) && !painted(Form::Shaped(Shape::Walker), 1.75));
    assert!(painted(Form::Body, 0.25) && !painted(Form::Body, 1.5));
}

#[test]
fn who_walks_moves_their_limbs_and_who_stands_does_not() {
    let pictures = |step: f64, shape: Shape| {
        let mut painter = Painter::new(&place(), &in_space(Form::Shaped(shape)), &alone(0.0)).unwrap();
        // on the spot in the picture: only what has been walked differs
        painter.follow(&alone(0.0));
        let first = painter.paint(&alone(0.0)).clone();
        painter.follow(&alone(step));
        let back = painter.paint(&alone(0.0)).clone();
        differ(&first, &back)
    };
    assert_eq!(pictures(0.0, Shape::Walker), 0);
    // there and back are 0.4 m, a quarter of a turn and more
    assert!(pictures(0.2, Shape::Walker) > 5);
    assert_eq!(pictures(0.2, Shape::Vehicle), 0);
}

#[test]
fn every_shape_is_drawn_from_above_and_in_space() {
    for projection in [Projection::Plan, Projection::Perspective] {
        let mut pictures: Vec<Image> = Vec::new();
        for form in Shape::ALL.map(Form::Shaped).into_iter().chain([Form::Body]) {
            let style = Style { projection: Some(projection), ..in_space(form) };
            let mut painter = Painter::new(&place(), &style, &alone(0.0)).unwrap();
            let image = painter.paint(&alone(0.0)).clone();
            assert!(pictures.iter().all(|other| differ(other, &image) > 5), "{form:?}, {projection:?}");
            pictures.push(image);
        }
    }
}
