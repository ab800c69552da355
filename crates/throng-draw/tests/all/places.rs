//! Places that change, and sets.

use crate::common::{setting, style};
use glam::{DVec2, Vec3};
use std::sync::Arc;
use throng::Obstacle;
use throng_draw::{Image, Painter, Projection, Style};
use throng_record::{Frame, SetMesh, Setting};

fn picture(setting: &Setting, style: &Style) -> Image {
    Painter::new(setting, style, &Frame::default()).unwrap().paint(&Frame::default()).clone()
}

#[test]
fn obstacles_that_change_are_drawn() {
    let wall = Obstacle::Wall { points: vec![DVec2::new(-5.0, -1.0), DVec2::new(3.0, 1.0)] };
    for projection in [Projection::Plan, Projection::Perspective] {
        let style = Style { projection: Some(projection), goals: false, legend: false, ..style() };
        let walled = Setting { obstacles: vec![wall.clone()], ..setting() };
        let bare = Setting { obstacles: Vec::new(), ..setting() };
        let [start, walled, bare] = [&setting(), &walled, &bare].map(|setting| picture(setting, &style));
        assert!(start != walled && walled != bare && bare != start);
        let mut painter = Painter::new(&setting(), &style, &Frame::default()).unwrap();
        let mut paint = |obstacles: Option<Vec<Obstacle>>| {
            painter.paint(&Frame { obstacles: obstacles.map(Arc::from), ..Frame::default() }).clone()
        };
        assert!(paint(None) == start, "{projection:?}: at the start");
        assert!(paint(Some(vec![wall.clone()])) == walled, "{projection:?}: a wall in place of the disc");
        assert!(paint(Some(Vec::new())) == bare, "{projection:?}: nothing");
        assert!(paint(None) == start, "{projection:?}: as at the start");
    }
}

/// A red square of 4 m that stands on the line x = 0, facing the viewpoint.
fn board(replaces: bool) -> SetMesh {
    let corners = [(-2.0, 0.0), (2.0, 0.0), (2.0, 4.0), (-2.0, 4.0)];
    SetMesh {
        positions: corners.map(|(x, z)| Vec3::new(x, 0.0, z)).to_vec(),
        normals: vec![Vec3::NEG_Y; 4],
        colors: vec![[200, 20, 20]; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        replaces,
    }
}

#[test]
fn a_set_is_seen_in_perspective_from_both_sides() {
    let red = |image: &Image| {
        let reds = image
            .data()
            .chunks_exact(4)
            .filter(|pixel| pixel[0] > pixel[1].saturating_add(60) && pixel[0] > pixel[2].saturating_add(60));
        reds.count()
    };
    let with = |set: Option<SetMesh>| Setting { set: set.map(Arc::new), ..setting() };
    let style = Style { projection: Some(Projection::Perspective), goals: false, legend: false, ..style() };
    let bare = picture(&with(None), &style);
    let set = picture(&with(Some(board(false))), &style);
    assert!(red(&bare) == 0 && red(&set) > 500, "{} and {} red pixels", red(&bare), red(&set));
    let mut turned = board(false);
    turned.normals.iter_mut().for_each(|normal| *normal = -*normal);
    turned.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    assert!(red(&picture(&with(Some(turned)), &style)) > 500, "it has two sides");
    let plan = Style { projection: Some(Projection::Plan), ..style.clone() };
    assert_eq!(red(&picture(&with(Some(board(false))), &plan)), 0, "a plan has no set");
    // without the obstacles and the ground
    let alone = picture(&with(Some(board(true))), &style);
    let no_obstacles = Setting { obstacles: Vec::new(), ..with(Some(board(true))) };
    assert!(alone == picture(&no_obstacles, &style) && alone != set);
}
