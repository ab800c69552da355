//! The contents of pictures.

use super::common::{elements, moment, setting, style};
use glam::{DVec2, Vec2};
use throng::Status;
use throng_draw::{Color, ColorBy, Error, Image, Painter, Style, Theme, WorldBox, palette, ramp};
use throng_record::{Frame, Setting};

fn paint(setting: &Setting, style: &Style, frame: &Frame) -> (Painter, Image) {
    let mut painter = Painter::new(setting, style, frame).unwrap();
    let image = painter.paint(frame).clone();
    (painter, image)
}

/// Returns the colour of a point of the world in the picture.
fn at(painter: &Painter, image: &Image, point: DVec2) -> Color {
    let pixel = painter.pixel(point.extend(0.0)).unwrap();
    image.pixel(pixel.x as u32, pixel.y as u32)
}

#[test]
fn an_agent_has_the_colour_of_its_group_at_its_centre() {
    let frame = moment(0);
    let (painter, image) = paint(&setting(), &style(), &frame);
    for body in &frame.bodies {
        assert_eq!(at(&painter, &image, body.position), palette(body.group as usize));
    }
}

#[test]
fn the_style_chooses_colours_by_speed_or_goal() {
    let frame = moment(0);
    let by = |color_by| Style { color_by, ..style() };
    let (painter, image) = paint(&setting(), &by(ColorBy::Speed { max: Some(2.0) }), &frame);
    assert_eq!(at(&painter, &image, frame.bodies[0].position), ramp(0.5));
    let (painter, image) = paint(&setting(), &by(ColorBy::Goal), &frame);
    assert_eq!(at(&painter, &image, frame.bodies[1].position), palette(0));
}

#[test]
fn higher_bodies_cover_lower_ones() {
    let mut frame = moment(0);
    frame.bodies[0].position = frame.bodies[1].position;
    let shown = |heights: [f32; 2], color_by| {
        let mut frame = frame.clone();
        for (body, height) in frame.bodies.iter_mut().zip(heights) {
            body.altitude = height;
        }
        let (painter, image) = paint(&setting(), &Style { color_by, ..style() }, &frame);
        at(&painter, &image, frame.bodies[1].position)
    };
    let [first, second] = [0, 1].map(|k| palette(frame.bodies[k].group as usize));
    assert_eq!(shown([3.0, 1.0], ColorBy::Group), first);
    assert_eq!(shown([1.0, 3.0], ColorBy::Group), second);
    assert_eq!(shown([0.0, 0.0], ColorBy::Group), second, "at equal height the later number");
    assert_eq!(shown([4.0, 1.0], ColorBy::Altitude), ramp(1.0));
}

#[test]
fn flying_agents_have_shadows_whose_offset_grows_with_the_height() {
    let mut frame = moment(0);
    frame.bodies.truncate(1);
    let ground = Theme::light().ground;
    let body = frame.bodies[0];
    let dark = |height: f32, off: f64| {
        let mut frame = frame.clone();
        frame.bodies[0].altitude = height;
        let (painter, image) = paint(&setting(), &Style { trails: 0.0, goals: false, ..style() }, &frame);
        at(&painter, &image, body.position + DVec2::new(off, -off)) != ground
    };
    assert!(!dark(0.0, 0.6) && dark(5.0, 0.6) && !dark(10.0, 0.6) && dark(10.0, 1.2));
}

#[test]
fn the_notch_is_in_front() {
    let frame = moment(0);
    let (painter, image) = paint(&setting(), &style(), &frame);
    let body = &frame.bodies[0];
    let notch = at(&painter, &image, body.position + DVec2::new(0.3, 0.0));
    assert!(notch.r > palette(0).r + 80, "{notch:?}");
    assert_eq!(at(&painter, &image, body.position - DVec2::new(0.2, 0.0)), palette(0));
    let (painter, image) = paint(&setting(), &Style { headings: false, ..style() }, &frame);
    assert_eq!(at(&painter, &image, body.position + DVec2::new(0.2, 0.0)), palette(0));
}

#[test]
fn ground_obstacles_and_outside_have_their_tones() {
    let theme = Theme::light();
    let (painter, image) = paint(&setting(), &style(), &moment(0));
    assert_eq!(at(&painter, &image, DVec2::new(0.0, 4.0)), theme.obstacle);
    assert_eq!(at(&painter, &image, DVec2::new(-5.0, -5.0)), theme.ground, "without walkable areas all is ground");
    let corner = |x, y| DVec2::new(x, y);
    let room = throng::Walkable {
        outer: vec![corner(-6.0, -3.0), corner(6.0, -3.0), corner(6.0, 3.0), corner(-6.0, 3.0)],
        holes: vec![vec![corner(-1.0, -2.0), corner(1.0, -2.0), corner(1.0, 2.0), corner(-1.0, 2.0)]],
    };
    let setting = Setting { walkable: vec![room], ..Setting::default() };
    let (painter, image) = paint(&setting, &style(), &moment(0));
    assert_eq!(at(&painter, &image, DVec2::new(-5.0, -5.0)), theme.outside);
    assert_eq!(at(&painter, &image, DVec2::new(-4.0, -2.0)), theme.ground);
    assert_eq!(at(&painter, &image, DVec2::new(0.0, 0.0)), theme.obstacle, "a hole is solid");
}

#[test]
fn arrived_agents_are_paler() {
    let mut frame = moment(0);
    frame.bodies[0].status = Status::Arrived;
    let (painter, image) = paint(&setting(), &style(), &frame);
    let (there, walking) = (at(&painter, &image, frame.bodies[0].position), palette(0));
    assert!(there.r > walking.r + 40 && there.g > walking.g + 40, "{there:?}");
}

#[test]
fn a_trail_lies_behind_and_fades() {
    let style = Style { trails: 2.0, ..style() };
    let mut painter = Painter::new(&setting(), &style, &moment(0)).unwrap();
    for k in 0..100 {
        painter.follow(&moment(k));
    }
    let frame = moment(100);
    let image = painter.paint(&frame).clone();
    let body = frame.bodies[0].position;
    let red = |behind: f64| at(&painter, &image, body - DVec2::new(behind, 0.0)).r;
    let ground = style.theme.ground.r;
    assert!(red(0.7) < red(1.2) && red(1.2) < red(1.6), "{} {} {}", red(0.7), red(1.2), red(1.6));
    assert_eq!(red(2.6), ground, "points older than two seconds are dropped");
    assert_eq!(at(&painter, &image, body + DVec2::new(0.8, 0.0)).r, ground, "nothing lies ahead");
}

#[test]
fn the_same_moments_give_the_same_picture() {
    let style = Style { trails: 1.0, legend: true, ..Style::default() };
    let mut followed = Painter::new(&setting(), &style, &moment(0)).unwrap();
    let mut painted = Painter::new(&setting(), &style, &moment(0)).unwrap();
    for k in 0..30 {
        followed.follow(&moment(k));
        painted.paint(&moment(k));
    }
    assert_eq!(followed.paint(&moment(30)), painted.paint(&moment(30)));
    assert_eq!(followed.paint(&moment(30)), painted.paint(&moment(30)), "a moment painted again");
}

#[test]
fn everything_is_in_the_picture_of_the_automatic_view() {
    let mut frame = moment(0);
    frame.bodies[1].position = DVec2::new(300.0, -200.0);
    let painter = Painter::new(&setting(), &Style::default(), &frame).unwrap();
    for point in [frame.bodies[0].position, frame.bodies[1].position, DVec2::new(0.0, 5.0)] {
        let pixel = painter.pixel(point.extend(0.0)).unwrap();
        assert!(pixel.cmpge(Vec2::ZERO).all() && pixel.cmple(Vec2::new(640.0, 480.0)).all(), "{point} at {pixel}");
    }
}

#[test]
fn open_ground_has_a_margin() {
    let frame = moment(0);
    let room = |setting: &Setting| WorldBox::of(setting, &frame).unwrap().max.x - frame.bodies[1].position.x;
    assert!(room(&setting()) > 1.0, "more than a body beside the outermost: {}", room(&setting()));
    let corners = [(-9.0, -9.0), (6.0, -9.0), (6.0, 9.0), (-9.0, 9.0)];
    let outer = corners.map(|(x, y)| DVec2::new(x, y)).to_vec();
    let walled = Setting { walkable: vec![throng::Walkable { outer, holes: Vec::new() }], ..setting() };
    assert_eq!(room(&walled), 1.0, "up to the wall");
}

#[test]
fn a_small_goal_area_gets_a_ring() {
    let ink = |half: f64| {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let corners = corners.map(|(x, y)| DVec2::new(x, y) * half).to_vec();
        let setting = Setting { goals: vec![throng::Goal::Exit { corners }], obstacles: vec![], ..setting() };
        let (_, image) = paint(&setting, &style(), &Frame::default());
        image.data().chunks_exact(4).filter(|p| p[0] < 0xc0).count()
    };
    assert!(ink(0.1) > 30, "an exit of 2 pixels leaves {} dark pixels", ink(0.1));
}

#[test]
fn the_legend_is_drawn_only_on_request() {
    let blank = |legend| {
        let style = Style { legend, goals: false, ..Style::default() };
        let (_, image) = paint(&Setting { title: "Title".into(), ..Setting::default() }, &style, &Frame::default());
        image.data().chunks_exact(4).filter(|p| p[0] < 0x90).count()
    };
    assert_eq!(blank(false), 0);
    assert!(blank(true) > 100);
}

#[test]
fn invalid_numbers_and_empty_places_do_not_panic() {
    let mut frame = moment(0);
    frame.bodies[0].position = DVec2::NAN;
    frame.bodies[1].radius = f32::INFINITY;
    frame.bodies[1].group = u32::MAX;
    let nowhere = vec![DVec2::ZERO; 3];
    let setting = Setting {
        walkable: vec![throng::Walkable { outer: nowhere.clone(), holes: vec![Vec::new()] }],
        obstacles: vec![
            throng::Obstacle::Wall { points: Vec::new() },
            throng::Obstacle::Polygon { corners: nowhere },
            throng::Obstacle::Circle { center: DVec2::ZERO, radius: -1.0 },
        ],
        goals: vec![throng::Goal::Area { corners: Vec::new() }],
        ..setting()
    };
    let style = Style { view: None, legend: true, trails: 1.0, ..style() };
    let (mut painter, _) = paint(&setting, &style, &frame);
    painter.svg(&frame);
    paint(&Setting::default(), &Style::default(), &Frame::default());
}

#[test]
fn invalid_sizes_are_refused() {
    for (width, height) in [(0, 480), (640, 5), (100_000, 100)] {
        let style = Style { width, height, ..Style::default() };
        let error = Painter::new(&setting(), &style, &moment(0)).unwrap_err();
        assert!(matches!(error, Error::Size { .. }), "{error}");
    }
}

#[test]
fn an_svg_is_well_formed_and_holds_all_agents() {
    let style = Style { trails: 1.0, legend: true, ..style() };
    let mut painter = Painter::new(&setting(), &style, &moment(0)).unwrap();
    for k in 0..20 {
        painter.follow(&moment(k));
    }
    let svg = painter.svg(&moment(20));
    assert!(elements(&svg) > 15);
    assert!(svg.contains("Cats &amp; &lt;dogs&gt;"), "the title is escaped");
    for group in [0, 1] {
        assert!(svg.contains(&palette(group).hex()), "group {group} has its colour");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn a_group_can_have_a_colour_of_its_own() {
    let (frame, red) = (moment(0), Color::rgb(0xcc3333));
    let (painter, image) = paint(&setting(), &Style { groups: vec![Some(red)], ..style() }, &frame);
    assert_eq!(at(&painter, &image, frame.bodies[0].position), red);
    assert_eq!(at(&painter, &image, frame.bodies[1].position), palette(1));
}

#[test]
fn goals_are_drawn_only_if_agents_go_there_and_they_are_visible() {
    let drawn = |setting: &Setting, frame: &Frame| {
        let with = paint(setting, &style(), frame).1;
        let without = paint(setting, &Style { goals: false, ..style() }, frame).1;
        with != without
    };
    assert!(drawn(&setting(), &moment(0)));
    // An agent that stands at its goal waits there.
    let mut waiting = moment(0);
    waiting.bodies.truncate(1);
    waiting.bodies[0].position = DVec2::new(4.0, -4.0);
    assert!(!drawn(&setting(), &waiting));
    // A goal for each of a hundred agents, each body a speck.
    let at = |k: u32| DVec2::new(f64::from(k % 10) - 4.5, f64::from(k / 10) - 4.5);
    let goals = (0..100).map(|k| throng::Goal::Point { at: at(k), tolerance: 0.1 }).collect();
    let many = Setting { goals, ..setting() };
    assert!(drawn(&many, &moment(0)));
    let mut small = moment(0);
    small.bodies.iter_mut().for_each(|body| body.radius = 0.1);
    assert!(!drawn(&many, &small));
}

#[test]
fn areas_in_holes_are_ground() {
    let square = |half: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec2::new(x, y) * half);
    let area = |outer: f64, holes: &[f64]| throng::Walkable {
        outer: square(outer).to_vec(),
        holes: holes.iter().map(|&half| square(half).to_vec()).collect(),
    };
    let walkable = vec![area(1.0, &[]), area(4.0, &[3.0])];
    let setting = Setting { walkable, obstacles: vec![], goals: vec![], ..setting() };
    let frame = Frame::default();
    let (painter, image) = paint(&setting, &style(), &frame);
    let theme = Theme::light();
    for (x, color) in [(0.0, theme.ground), (2.0, theme.obstacle), (3.5, theme.ground), (4.5, theme.outside)] {
        assert_eq!(at(&painter, &image, DVec2::new(x, 0.0)), color, "at {x}");
    }
}
