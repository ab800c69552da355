//! Annotations of agents.

use super::common::{elements, moment, setting, style};
use glam::{DVec2, Vec3};
use throng::steer::{SteeringReason, TraceEntry};
use throng::{Trace, TraceRequest};
use throng_draw::{Annotation, Annotations, Image, Painter, Projection, Style};
use throng_record::{Frame, Setting};

/// Returns a trace with one reason.
fn account(number: u32, reason: SteeringReason) -> Trace {
    Trace { number, steering: Vec3::Y * 8.0, preferred: -Vec3::X * 4.0, entries: vec![TraceEntry { depth: 0, reason }] }
}

fn picture(setting: &Setting, frame: &Frame, style: Style) -> Image {
    Painter::new(setting, &style, frame).unwrap().paint(frame).clone()
}

/// Returns the number of pixels that a kind changes.
fn ink(kind: Annotation, frame: &Frame, agents: Option<Vec<u32>>, projection: Projection) -> usize {
    let style = Style { projection: Some(projection), ..style() };
    let with = Style { annotations: Annotations { kinds: vec![kind], agents }, ..style.clone() };
    let (bare, with) = (picture(&setting(), frame, style), picture(&setting(), frame, with));
    bare.data().chunks_exact(4).zip(with.data().chunks_exact(4)).filter(|(a, b)| a != b).count()
}

#[test]
fn every_kind_is_drawn_in_both_projections() {
    let there = Vec3::new(-1.0, 3.0, 0.0);
    let told = [
        (Annotation::Neighbourhoods, SteeringReason::Looks { distance: 3.0, angle: 2.0 }),
        (Annotation::Neighbourhoods, SteeringReason::Regards(1)),
        (Annotation::Paths, SteeringReason::Via(there)),
        (Annotation::Feelers, SteeringReason::Feels(there)),
        (Annotation::Feelers, SteeringReason::Cylinder { from: Vec3::ZERO, to: there, radius: 0.5 }),
        (Annotation::Paths, SteeringReason::Stretch { from: Vec3::ZERO, to: there, radius: 0.5 }),
        (Annotation::Paths, SteeringReason::Projects { from: Vec3::ZERO, to: there }),
        (Annotation::Constructions, SteeringReason::Circle { center: there, radius: 1.0 }),
        (Annotation::Constructions, SteeringReason::Rectangle([Vec3::ZERO, Vec3::X, there, Vec3::Y])),
        (Annotation::Flow, SteeringReason::Samples { place: there, velocity: Vec3::X * 3.0 }),
        (Annotation::Predictions, SteeringReason::Expects { now: Vec3::ZERO, then: there }),
        (Annotation::Targets, SteeringReason::Aim(there)),
        (Annotation::Targets, SteeringReason::Shuns(there)),
        (Annotation::Threats, SteeringReason::Hits { point: there, normal: Vec3::X }),
        (Annotation::Terms, SteeringReason::Adds(Vec3::X * 8.0)),
        (Annotation::Threats, SteeringReason::Threat { number: 1, seconds: 1.0, own: there, theirs: there + 1.0 }),
        (Annotation::Preferred, SteeringReason::Wishes(Vec3::X * 3.0)),
        (Annotation::Force, SteeringReason::State(0)),
    ];
    for projection in [Projection::Plan, Projection::Perspective] {
        for (kind, reason) in told {
            let mut accounts = vec![account(0, reason)];
            // A path has more than one corner.
            accounts[0].entries.push(TraceEntry { depth: 0, reason: SteeringReason::Via(Vec3::ZERO) });
            let frame = Frame { accounts, ..moment(0) };
            assert!(ink(kind, &frame, None, projection) > 5, "{kind:?} in {projection:?}");
        }
        assert!(ink(Annotation::Velocity, &moment(0), None, projection) > 5);
        let other = Frame { accounts: vec![account(0, SteeringReason::Aim(there))], ..moment(0) };
        assert_eq!(ink(Annotation::Threats, &other, None, projection), 0, "no trace has a threat");
        assert_eq!(ink(Annotation::Targets, &other, Some(vec![1]), projection), 0, "another agent is requested");
    }
}

#[test]
fn a_target_is_drawn_relative_to_the_origin() {
    let annotations = Annotations { kinds: vec![Annotation::Targets], agents: None };
    let frame = Frame { accounts: vec![account(0, SteeringReason::Aim(Vec3::new(1.0, 2.0, 0.0)))], ..moment(0) };
    let setting = Setting { origin: DVec2::new(1.0, -4.0), ..setting() };
    let (style, bare) = (Style { annotations, ..style() }, style());
    let mut painter = Painter::new(&setting, &style, &frame).unwrap();
    let pixel = painter.pixel(DVec2::new(2.0, -2.0).extend(0.0)).unwrap();
    let (x, y) = (pixel.x as u32, pixel.y as u32);
    assert_ne!(painter.paint(&frame).pixel(x, y), picture(&setting, &frame, bare).pixel(x, y));
}

#[test]
fn annotated_agents_have_trails_and_the_key_names_visible_kinds() {
    let annotations = Annotations { kinds: Annotation::ALL.to_vec(), agents: Some(vec![0]) };
    assert_eq!(annotations.asked(), TraceRequest::Numbers(vec![0]));
    let style = Style { annotations, legend: true, trails: 0.0, ..style() };
    let mut painter = Painter::new(&setting(), &style, &moment(0)).unwrap();
    let told = Frame { accounts: vec![account(0, SteeringReason::Feels(Vec3::ZERO))], ..moment(1) };
    painter.follow(&told);
    (2..50).for_each(|k| painter.follow(&moment(k)));
    let svg = painter.svg(&moment(50));
    assert!(elements(&svg) > 10 && svg.contains(">feelers<") && svg.contains(">trails<"), "{svg}");
    assert!(!svg.contains(">threats<"), "no trace had a threat");
    assert_eq!(Annotations::default().asked(), TraceRequest::None);
}
