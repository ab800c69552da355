//! Figures of explanations.

use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::avoid::{Hrvo, LocalModel, Orca, Rvo, Vo};
use throng::motion::Holonomic;
use throng::{Agent, Explanation, Goal, Group, Journey, Obstacle, Settings, Stop, World};
use throng_draw::{Color, Error, Figure, Style, Theme};
use throng_record::{Frame, Setting};

const SIZE: (u32, u32) = (1200, 760);

fn style(theme: Theme) -> Style {
    Style { width: SIZE.0, height: SIZE.1, theme, ..Style::default() }
}

/// Returns an agent that walks to the right past `others` agents, the first of which comes towards it.
fn meeting(model: Arc<dyn LocalModel>, others: u32) -> World {
    let mut world = World::new(Settings { step: 0.05, ..Settings::default() }).unwrap();
    let group = world
        .add_group(Group { model, look_ahead: false, keep_right: 0.0, neighbours: 40, ..Group::default() })
        .unwrap();
    world.add_obstacle(Obstacle::Circle { center: DVec2::new(1.0, -1.6), radius: 0.5 }).unwrap();
    for number in 0..=others {
        let k = f64::from(number);
        let (from, to) = match number {
            0 => (DVec2::ZERO, DVec2::new(8.0, 0.0)),
            _ => (DVec2::new(1.5 + 0.5 * k, 0.1 * k), DVec2::new(-8.0, 0.5 * k)),
        };
        let goal = world.add_goal(Goal::Point { at: to, tolerance: 0.1 }).unwrap();
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap();
        let velocity = (to - from).as_vec2().normalize() * 1.3;
        world.add_agent(Agent { position: from.extend(0.0), velocity, journey, group, ..Agent::default() }).unwrap();
    }
    world
}

fn figure(world: &World, style: &Style) -> (Figure, Explanation) {
    let why = world.explain(world.id(0)).unwrap();
    (Figure::explain(&Setting::of(world, "A meeting"), &Frame::of(world), &why, style).unwrap(), why)
}

/// Returns the texts of a document with their positions.
fn words(svg: &str) -> Vec<(Vec2, &str)> {
    let number = |tag: &str, key: &str| -> f32 {
        let from = tag.find(key).unwrap() + key.len();
        tag[from..].split('"').next().unwrap().parse().unwrap()
    };
    let texts = svg.split("<text ").skip(1);
    texts
        .map(|text| {
            let (tag, rest) = text.split_once('>').unwrap();
            (Vec2::new(number(tag, "x=\""), number(tag, "y=\"")), rest.split('<').next().unwrap())
        })
        .collect()
}

/// Returns the pixel of a velocity, from the numbers along the axes.
fn pixel(svg: &str, velocity: Vec2) -> (u32, u32) {
    let words = words(svg);
    // The numbers below the plot have the same y, those beside the plot the same x.
    let zeros: Vec<Vec2> = words.iter().filter(|(_, text)| *text == "0").map(|(at, _)| *at).collect();
    let ones: Vec<Vec2> = words.iter().filter(|(_, text)| *text == "1").map(|(at, _)| *at).collect();
    let below =
        |all: &[Vec2]| all.iter().copied().filter(|at| at.y > 560.0).max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
    let beside = |all: &[Vec2]| {
        let column = below(&zeros).x;
        all.iter()
            .copied()
            .filter(|at| at.y < 560.0 && at.x < column && at.x > 600.0)
            .min_by(|a, b| a.x.total_cmp(&b.x))
            .unwrap()
    };
    let scale = below(&ones).x - below(&zeros).x;
    let zero = Vec2::new(below(&zeros).x, beside(&zeros).y - 0.34 * 14.0);
    assert!((beside(&zeros).y - beside(&ones).y - scale).abs() < 1.0, "both axes have one scale");
    let at = zero + Vec2::new(velocity.x, -velocity.y) * scale;
    (at.x as u32, at.y as u32)
}

#[test]
fn only_forbidden_velocities_are_tinted() {
    for model in [Arc::new(Vo::default()) as Arc<dyn LocalModel>, Arc::new(Orca::default()), Arc::new(Hrvo::default())]
    {
        let mut world = meeting(model, 1);
        for _ in 0..8 {
            world.step();
        }
        let (figure, why) = figure(&world, &style(Theme::light()));
        let (image, svg) = (figure.image(), figure.svg());
        let (mut free, mut forbidden) = (0, 0);
        for k in 0..400 {
            // The samples avoid the grid, the arrows and the labels.
            let v = Vec2::new((k % 20) as f32, (k / 20) as f32) * 0.16 - Vec2::splat(1.53);
            let depths = why.reasons.iter().filter_map(|reason| reason.depth(v)).map(|(_, depth)| depth);
            let deepest = depths.fold(f32::NEG_INFINITY, f32::max);
            let (x, y) = pixel(&svg, v);
            let (color, white) = (image.pixel(x, y), Color::rgb(0xfdfdfc));
            if v.length() < 1.7 && deepest < -0.05 {
                free += usize::from(color.r.abs_diff(white.r).max(color.b.abs_diff(white.b)) < 4);
            } else if v.length() < 1.7 && deepest > 0.05 {
                let tinted = color.r.abs_diff(white.r).max(color.b.abs_diff(white.b)) >= 4;
                assert!(tinted, "{v} is {deepest} within, but {color:?}: {}", why.model);
                forbidden += 1;
            }
        }
        assert!(free > 40 && forbidden > 20, "{free} free, {forbidden} forbidden: {}", why.model);
    }
}

#[test]
fn both_parts_name_every_neighbour_and_the_title_names_agent_and_time() {
    let mut world = meeting(Arc::new(Orca::default()), 3);
    world.step();
    let (figure, why) = figure(&world, &style(Theme::light()));
    let svg = figure.svg();
    let words = words(&svg);
    assert_eq!(words.iter().filter(|(_, text)| *text == "A meeting: agent 0 at 0.05 s, ORCA").count(), 1);
    for other in &why.neighbours {
        let number = other.number.to_string();
        let places = words.iter().filter(|(at, text)| *text == number && at.y < 610.0);
        let (near, plot): (Vec<Vec2>, Vec<Vec2>) = places.map(|(at, _)| *at).partition(|at| at.x < 600.0);
        assert!(near.len() == 1 && !plot.is_empty(), "{number}: {near:?} {plot:?}");
    }
    for entry in ["preferred", "chosen by the model", "after the guard", "by a wall", "permitted by all"] {
        assert!(words.iter().any(|(_, text)| text.contains(entry)), "{entry}");
    }
    assert!(words.iter().any(|(_, text)| text.starts_with("Chosen: ") && text.contains("touches")), "{words:?}");
}

#[test]
fn candidates_are_drawn() {
    let mut world = meeting(Arc::new(Rvo::default()), 2);
    world.step();
    let (figure, _) = figure(&world, &style(Theme::light()));
    assert!(figure.svg().contains("tried: costly to cheap"));
}

#[test]
fn figures_are_the_same_every_time_and_have_no_broken_numbers() {
    let mut world = meeting(Arc::new(Orca::default()), 38);
    for _ in 0..30 {
        world.step();
        let [(one, _), (two, _)] = [0, 1].map(|_| figure(&world, &style(Theme::dark())));
        assert_eq!(one.svg(), two.svg());
        assert!(!one.svg().contains("NaN") && !one.svg().contains("inf"), "at {}", world.time());
    }
}

#[test]
fn any_size_and_any_agent_is_drawn() {
    let mut still = World::new(Settings::default()).unwrap();
    let rest = Agent {
        preferred_speed: 0.0,
        motor: Holonomic { max_speed: 0.0, ..Holonomic::default() }.into(),
        ..Agent::default()
    };
    still.add_agent(rest).unwrap();
    for world in [still, meeting(Arc::new(Orca::default()), 2)] {
        for (width, height) in [(16, 16), (2000, 16), (16, 2000), (300, 200), (3000, 1500)] {
            let style = Style { width, height, ..Style::default() };
            let (figure, _) = figure(&world, &style);
            assert_eq!((figure.image().width(), figure.image().height()), (width, height));
            let svg = figure.svg();
            assert!(!svg.contains("width=\"-") && !svg.contains(" r=\"-"), "{width} x {height}");
        }
    }
}

#[test]
fn errors_are_returned() {
    let world = meeting(Arc::new(Orca::default()), 1);
    let (figure, why) = figure(&world, &style(Theme::light()));
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(figure.write(folder.path().join("a.mp4")), Err(Error::Still { .. })));
    assert!(matches!(figure.write(folder.path().join("no/a.png")), Err(Error::Output(_))));
    for name in ["a.png", "a.svg"] {
        figure.write(folder.path().join(name)).unwrap();
    }
    let tiny = Style { width: 3, ..Style::default() };
    let refused = Figure::explain(&Setting::default(), &Frame::default(), &why, &tiny);
    assert!(matches!(refused, Err(Error::Size { width: 3, .. })));
}
