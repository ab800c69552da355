//! What is drawn beside agents.

mod common;

use common::{elements, moment, setting, style};
use glam::{DVec2, Vec3};
use throng::steer::{Reason, Told};
use throng::{Account, Asked};
use throng_draw::{Annotation, Annotations, Image, Painter, Projection, Style};
use throng_record::{Frame, Setting};

/// Somebody who tells one thing.
fn account(number: u32, reason: Reason) -> Account {
    Account { number, steering: Vec3::Y * 8.0, preferred: -Vec3::X * 4.0, told: vec![Told { depth: 0, reason }] }
}

fn picture(setting: &Setting, frame: &Frame, style: Style) -> Image {
    Painter::new(setting, &style, frame).unwrap().paint(frame).clone()
}

/// How many pixels a kind changes.
fn ink(kind: Annotation, frame: &Frame, agents: Option<Vec<u32>>, projection: Projection) -> usize {
    let style = Style { projection: Some(projection), ..style() };
    let with = Style { annotations: Annotations { kinds: vec![kind], agents }, ..style.clone() };
    let (bare, with) = (picture(&setting(), frame, style), picture(&setting(), frame, with));
    bare.data().chunks_exact(4).zip(with.data().chunks_exact(4)).filter(|(a, b)| a != b).count()
}

#[test]
fn every_kind_leaves_ink_of_what_is_told_in_both_projections() {
    let there = Vec3::new(-1.0, 3.0, 0.0);
    let told = [
        (Annotation::Neighbourhoods, Reason::Looks { distance: 3.0, angle: 2.0 }),
        (Annotation::Neighbourhoods, Reason::Regards(1)),
        (Annotation::Paths, Reason::Via(there)),
        (Annotation::Feelers, Reason::Feels(there)),
        (Annotation::Predictions, Reason::Expects(there)),
        (Annotation::Targets, Reason::Aim(there)),
        (Annotation::Threats, Reason::Threat { number: 1, seconds: 1.0, own: there, theirs: there + 1.0 }),
        (Annotation::Preferred, Reason::Wishes(Vec3::X * 3.0)),
        (Annotation::Force, Reason::State(0)),
    ];
    for projection in [Projection::Plan, Projection::Perspective] {
        for (kind, reason) in told {
            let mut accounts = vec![account(0, reason)];
            // a path has more than one corner
            accounts[0].told.push(Told { depth: 0, reason: Reason::Via(Vec3::ZERO) });
            let frame = Frame { accounts, ..moment(0) };
            assert!(ink(kind, &frame, None, projection) > 5, "{kind:?} in {projection:?}");
        }
        assert!(ink(Annotation::Velocity, &moment(0), None, projection) > 5);
        let other = Frame { accounts: vec![account(0, Reason::Aim(there))], ..moment(0) };
        assert_eq!(ink(Annotation::Threats, &other, None, projection), 0, "nobody tells of one");
        assert_eq!(ink(Annotation::Targets, &other, Some(vec![1]), projection), 0, "another is asked");
    }
}

#[test]
fn a_target_is_where_it_is_told_relative_to_the_origin() {
    let annotations = Annotations { kinds: vec![Annotation::Targets], agents: None };
    let frame = Frame { accounts: vec![account(0, Reason::Aim(Vec3::new(1.0, 2.0, 0.0)))], ..moment(0) };
    let setting = Setting { origin: DVec2::new(1.0, -4.0), ..setting() };
    let (style, bare) = (Style { annotations, ..style() }, style());
    let mut painter = Painter::new(&setting, &style, &frame).unwrap();
    let pixel = painter.pixel(DVec2::new(2.0, -2.0).extend(0.0)).unwrap();
    let (x, y) = (pixel.x as u32, pixel.y as u32);
    assert_ne!(painter.paint(&frame).pixel(x, y), picture(&setting, &frame, bare).pixel(x, y));
}

#[test]
fn trails_are_kept_of_those_who_are_annotated_and_the_key_names_what_was_seen() {
    let annotations = Annotations { kinds: Annotation::ALL.to_vec(), agents: Some(vec![0]) };
    assert_eq!(annotations.asked(), Asked::Numbers(vec![0]));
    let style = Style { annotations, legend: true, trails: 0.0, ..style() };
    let mut painter = Painter::new(&setting(), &style, &moment(0)).unwrap();
    let told = Frame { accounts: vec![account(0, Reason::Feels(Vec3::ZERO))], ..moment(1) };
    painter.follow(&told);
    (2..50).for_each(|k| painter.follow(&moment(k)));
    let svg = painter.svg(&moment(50));
    assert!(elements(&svg) > 10 && svg.contains(">feelers<") && svg.contains(">trails<"), "{svg}");
    assert!(!svg.contains(">threats<"), "nobody told of one");
    assert_eq!(Annotations::default().asked(), Asked::Nobody);
}
