//! Agents as shapes.

use super::common::{moment, setting, style};
use glam::{DVec2, DVec3, Vec2};
use throng_draw::{AgentShape, Image, Painter, Projection, Shape, Style};
use throng_record::{Frame, Setting};

fn place() -> Setting {
    Setting { obstacles: Vec::new(), goals: Vec::new(), ..setting() }
}

/// Returns a frame with a single agent that walks along +x.
fn alone(x: f64) -> Frame {
    let mut frame = moment(0);
    frame.bodies.truncate(1);
    let body = &mut frame.bodies[0];
    (body.position, body.radius, body.core, body.heading) = (DVec2::new(x, 0.0), 0.25, Vec2::ZERO, 0.0);
    (body.altitude, body.basis, body.velocity) = (0.0, None, Vec2::X);
    frame
}

fn in_space(form: AgentShape) -> Style {
    // Large enough for all bodies to be drawn at their true size.
    let (width, height, projection) = (800, 600, Some(Projection::Perspective));
    Style { width, height, forms: vec![form; 2], projection, trails: 0.0, legend: false, ..style() }
}

fn differ(a: &Image, b: &Image) -> usize {
    a.data().chunks_exact(4).zip(b.data().chunks_exact(4)).filter(|(a, b)| a != b).count()
}

/// An agent a little above the ground: without a shape it is a ball.
fn floating() -> Frame {
    let mut frame = alone(0.0);
    frame.bodies[0].altitude = 0.02;
    frame
}

#[test]
fn a_figure_stands_on_its_place_and_is_as_tall_as_a_person() {
    let frame = floating();
    let empty = Frame { bodies: Vec::new(), ..frame.clone() };
    let painted = |form: AgentShape, up: f64| {
        let place = Setting { in_space: true, ..place() };
        let mut painter = Painter::new(&place, &in_space(form), &frame).unwrap();
        let at = painter.pixel(DVec3::new(0.0, 0.0, up)).unwrap();
        let [with, bare] = [&frame, &empty].map(|frame| painter.paint(frame).pixel(at.x as u32, at.y as u32));
        with != bare
    };
    let figure = AgentShape::Shaped(Shape::Walker);
    assert!(painted(figure, 1.4) && !painted(figure, 2.0));
    assert!(painted(AgentShape::Body, 0.25) && !painted(AgentShape::Body, 1.4));
}

#[test]
fn a_ball_is_round_and_no_person() {
    let turned = |form: AgentShape| {
        let style = Style { projection: Some(Projection::Plan), ..in_space(form) };
        let mut painter = Painter::new(&place(), &style, &alone(0.0)).unwrap();
        let first = painter.paint(&alone(0.0)).clone();
        let mut frame = alone(0.0);
        frame.bodies[0].heading = 1.0;
        differ(&first, &painter.paint(&frame).clone())
    };
    assert_eq!(turned(AgentShape::Ball), 0);
    assert!(turned(AgentShape::Body) > 5);
    // on the ground in perspective, discs are people, and balls are not
    let painted = |form: AgentShape, up: f64| {
        let frame = alone(0.0);
        let mut painter = Painter::new(&Setting { in_space: false, ..place() }, &in_space(form), &frame).unwrap();
        let at = painter.pixel(DVec3::new(0.0, 0.0, up)).unwrap();
        let empty = Frame { bodies: Vec::new(), ..frame.clone() };
        let [with, bare] = [&frame, &empty].map(|frame| painter.paint(frame).pixel(at.x as u32, at.y as u32));
        with != bare
    };
    assert!(painted(AgentShape::Body, 1.4) && !painted(AgentShape::Ball, 1.4) && painted(AgentShape::Ball, 0.25));
}

#[test]
fn only_walking_moves_the_limbs() {
    let pictures = |step: f64, shape: Shape| {
        let style = Style { projection: Some(Projection::Plan), ..in_space(AgentShape::Shaped(shape)) };
        let mut painter = Painter::new(&place(), &style, &alone(0.0)).unwrap();
        // The position in the picture is the same, so only the walked distance differs.
        painter.follow(&alone(0.0));
        let first = painter.paint(&alone(0.0)).clone();
        painter.follow(&alone(step));
        let back = painter.paint(&alone(0.0)).clone();
        differ(&first, &back)
    };
    assert_eq!(pictures(0.0, Shape::Walker), 0);
    // The way there and back is 0.4 m, more than a quarter of a period.
    assert!(pictures(0.2, Shape::Walker) > 5);
    assert_eq!(pictures(0.2, Shape::Vehicle), 0);
}

#[test]
fn every_shape_is_drawn_from_above_and_in_space() {
    for projection in [Projection::Plan, Projection::Perspective] {
        let mut pictures: Vec<Image> = Vec::new();
        for form in Shape::ALL.map(AgentShape::Shaped).into_iter().chain([AgentShape::Body]) {
            let style = Style { projection: Some(projection), ..in_space(form) };
            let place = Setting { in_space: true, ..place() };
            let mut painter = Painter::new(&place, &style, &floating()).unwrap();
            let image = painter.paint(&floating()).clone();
            assert!(pictures.iter().all(|other| differ(other, &image) > 5), "{form:?}, {projection:?}");
            pictures.push(image);
        }
    }
}
