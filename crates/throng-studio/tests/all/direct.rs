//! Direct manipulation: a gesture becomes the intended edit of the text, in a single step that can be undone.

use eframe::egui::{self, Modifiers, PointerButton};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec2;
use std::time::Duration;
use throng_draw::WorldBox;
use throng_record::{Frame, moment};
use throng_scene::flow::{Named, Paint, Sketch};
use throng_scene::{ExitGoal, Goal, Place, PointGoal, PointsPlace, Region, Ring, Scene, Shape, gallery};
use throng_studio::direct::{DirectedWorld, Director, Event, Tool};
use throng_studio::document::Document;
use throng_studio::panels;
use throng_studio::play::{Command, Engine};

/// A studio without a window, at 20 points of the screen per metre.
struct Hand {
    document: Document,
    director: Director,
}

impl Hand {
    fn new(document: Document) -> Self {
        Self { document, director: Director::default() }
    }

    fn gallery(name: &str) -> Self {
        Self::new(Document::gallery(name).unwrap())
    }

    fn scene(&self) -> &Scene {
        self.document.scene().unwrap()
    }

    /// Presses at the first point, moves along the other points and releases.
    fn drag(&mut self, tool: Tool, way: &[[f64; 2]]) -> Result<bool, String> {
        let mut first = Frame::default();
        let (world, built) = self.scene().build().unwrap();
        moment::capture(&world, &mut first);
        let [min, max] = built.bounds;
        let stage = DirectedWorld { first: &first, bounds: WorldBox { min, max }, scale: 20.0 };
        if self.director.tool != tool {
            self.director.take(tool);
        }
        let [from, to] = [way[0], way[way.len() - 1]].map(DVec2::from);
        let mut point = |at: DVec2, event| self.director.point(&mut self.document, at, event, stage);
        let pressed = point(from, Event::Press)?;
        if tool.clicks() {
            return Ok(pressed);
        }
        assert!(!pressed, "a press edits nothing");
        for &at in &way[1..] {
            assert_eq!(point(at.into(), Event::Move), Ok(false), "a move edits nothing");
        }
        point(to, Event::Release)
    }

    fn click(&mut self, tool: Tool, at: [f64; 2]) -> Result<bool, String> {
        self.drag(tool, &[at])
    }

    /// Checks that the last edit builds, is one step, and is undone to the exact text.
    fn is_one_step_from(&mut self, before: &str) {
        assert!(self.scene().build().is_ok(), "{}", self.document.text());
        let after = self.document.text().to_owned();
        assert_ne!(before, after);
        assert!(self.document.undo());
        assert_eq!(self.document.text(), before);
        assert!(self.document.redo());
        assert_eq!(self.document.text(), after);
    }

    fn text(&self) -> String {
        self.document.text().to_owned()
    }
}

fn near(a: [f64; 2], b: [f64; 2]) {
    assert!(DVec2::from(a).distance(b.into()) < 1e-3, "{a:?} is not {b:?}");
}

fn points(place: &Place) -> Vec<[f64; 2]> {
    place.read::<PointsPlace>().unwrap_or_else(|| panic!("{place:?}")).0
}

#[test]
fn one_more_and_one_fewer() {
    let mut hand = Hand::gallery("pedestrians");
    for (by, count) in [(1, 101), (1, 102), (-1, 101)] {
        let before = hand.text();
        assert_eq!(hand.director.more(&mut hand.document, 0, by), Ok(true));
        assert_eq!(hand.scene().groups[0].count, Some(count));
        hand.is_one_step_from(&before);
    }
    let mut hand = Hand::gallery("capture-the-flag");
    let defenders = hand.scene().groups.iter().position(|group| group.name == "defenders").unwrap();
    assert_eq!(hand.director.more(&mut hand.document, defenders, -1), Ok(true));
    assert_eq!(points(&hand.scene().groups[defenders].place).len(), 3);
    let before = hand.text();
    let says = hand.director.more(&mut hand.document, defenders, 1).unwrap_err();
    assert!(says.contains("(P)") && hand.text() == before, "{says}");
}

#[test]
fn a_rule_moves_as_a_whole_and_a_list_entry_by_entry() {
    let mut hand = Hand::gallery("circle");
    let before = hand.text();
    assert_eq!(hand.drag(Tool::Select, &[[0.0, 0.0], [1.0, 0.5], [2.0, -1.25]]), Ok(true));
    let ring: Ring = hand.scene().groups[0].place.read().unwrap();
    near(ring.center, [2.0, -1.25]);
    assert!(hand.document.text().contains("# metres"), "comments stay");
    hand.is_one_step_from(&before);

    let mut hand = Hand::new(Document::empty());
    assert_eq!(hand.click(Tool::Agents, [-9.0, 3.0]), Ok(true));
    let before = hand.text();
    assert_eq!(hand.drag(Tool::Select, &[[-9.0, 3.1], [-7.5, 4.1]]), Ok(true));
    near(points(&hand.scene().groups[0].place)[0], [-9.0, 0.0]);
    near(points(&hand.scene().groups[0].place)[1], [-7.5, 4.0]);
    hand.is_one_step_from(&before);
    assert_eq!(hand.click(Tool::Select, [-7.5, 4.0]), Ok(false), "a click selects");
    assert_eq!(hand.director.remove(&mut hand.document), Ok(true));
    assert_eq!(points(&hand.scene().groups[0].place).len(), 1);
    hand.click(Tool::Select, [-9.0, 0.0]).unwrap();
    let says = hand.director.remove(&mut hand.document).unwrap_err();
    assert!(says.contains("at least one group"), "{says}");
}

#[test]
fn agents_are_added_a_body_apart() {
    let mut hand = Hand::new(Document::empty());
    let before = hand.text();
    let way: Vec<[f64; 2]> = (0..=40).map(|k| [-6.0 + 0.1 * f64::from(k), 2.0]).collect();
    assert_eq!(hand.drag(Tool::Agents, &way), Ok(true));
    let there = points(&hand.scene().groups[0].place);
    assert_eq!(there.len(), 13, "twelve agents on four metres: {there:?}");
    assert!(there[1..].windows(2).all(|pair| DVec2::from(pair[0]).distance(pair[1].into()) >= 0.359));
    hand.is_one_step_from(&before);
    let says = hand.click(Tool::Agents, [-9.1, 0.0]).unwrap_err();
    assert!(says.contains("another agent stands there"), "{says}");

    // where the place is a rule, a new group with the same properties holds the new agents
    let mut hand = Hand::gallery("circle");
    let before = hand.text();
    assert_eq!(hand.click(Tool::Agents, [0.0, 0.5]), Ok(true));
    assert_eq!((hand.scene().groups.len(), hand.director.group), (2, 1));
    assert_eq!(hand.scene().groups[1].name, "walkers-2");
    near(points(&hand.scene().groups[1].place)[0], [0.0, 0.5]);
    assert_eq!(hand.scene().groups[1].avoid, hand.scene().groups[0].avoid);
    let text = hand.text();
    assert!(text.find("walkers-2").unwrap() < text.find("[view]").unwrap(), "{text}");
    hand.is_one_step_from(&before);
    assert_eq!(hand.click(Tool::Agents, [1.0, 0.5]), Ok(true));
    assert_eq!((hand.scene().groups.len(), points(&hand.scene().groups[1].place).len()), (2, 2));
}

#[test]
fn obstacles_are_drawn_moved_and_taken_out() {
    let mut hand = Hand::new(Document::empty());
    let before = hand.text();
    assert_eq!(hand.drag(Tool::Disc, &[[0.0, 0.0], [0.0, 1.5]]), Ok(true));
    hand.is_one_step_from(&before);
    assert_eq!(hand.drag(Tool::Rectangle, &[[3.0, 3.0], [5.0, 4.0]]), Ok(true));
    for at in [[-4.0, -4.0], [-2.0, -4.0], [-2.0, -2.0]] {
        assert_eq!(hand.click(Tool::Polygon, at), Ok(false));
    }
    assert_eq!(hand.click(Tool::Polygon, [-4.1, -4.1]), Ok(true), "a click on the first corner ends the polygon");
    hand.click(Tool::Wall, [3.0, -6.0]).unwrap();
    hand.click(Tool::Wall, [3.0, -3.0]).unwrap();
    assert_eq!(hand.click(Tool::Wall, [3.0, -3.0]), Ok(true), "a second click on the last corner ends the wall");
    let shapes: Vec<Shape> = hand.scene().obstacles.iter().map(|obstacle| obstacle.shape.clone()).collect();
    let [Shape::Circle(disc), Shape::Rectangle(block), Shape::Polygon(corners), Shape::Wall(wall)] = shapes.as_slice()
    else {
        panic!("{shapes:?}")
    };
    near(disc.center, [0.0, 0.0]);
    assert!((disc.radius - 1.5).abs() < 1e-3);
    near(block.center, [4.0, 3.5]);
    near(block.size, [2.0, 1.0]);
    assert_eq!((corners.len(), wall.as_slice()), (3, [[3.0, -6.0], [3.0, -3.0]].as_slice()));

    // drags the rim, a corner, and the interior
    hand.drag(Tool::Select, &[[1.5, 0.0], [2.0, 0.0]]).unwrap();
    hand.drag(Tool::Select, &[[-2.0, -2.0], [-2.0, -1.5]]).unwrap();
    hand.drag(Tool::Select, &[[3.5, 3.3], [3.5, 5.3]]).unwrap();
    let shape = |k: usize| hand.scene().obstacles[k].shape.clone();
    assert!(matches!(shape(0), Shape::Circle(disc) if (disc.radius - 2.0).abs() < 1e-3));
    assert!(matches!(shape(1), Shape::Rectangle(block) if block.center == [4.0, 5.5]));
    assert!(matches!(shape(2), Shape::Polygon(corners) if corners[2] == [-2.0, -1.5]));
    hand.click(Tool::Select, [0.1, 0.0]).unwrap();
    assert_eq!(hand.director.remove(&mut hand.document), Ok(true));
    assert_eq!(hand.scene().obstacles.len(), 3);
    assert!(hand.drag(Tool::Disc, &[[0.0, 0.0]]).unwrap_err().contains("drag"));
}

#[test]
fn goals_and_exits_are_placed_and_dragged() {
    let mut hand = Hand::new(Document::empty());
    let before = hand.text();
    assert_eq!(hand.click(Tool::Goal, [5.0, 5.0]), Ok(true));
    hand.is_one_step_from(&before);
    hand.drag(Tool::Select, &[[5.0, 5.0], [6.0, 4.0]]).unwrap();
    let there: PointGoal = hand.scene().groups[0].goal.as_ref().and_then(Goal::read).unwrap();
    assert_eq!(there.at, [6.0, 4.0]);
    hand.drag(Tool::Exit, &[[8.0, -2.0], [10.0, 2.0]]).unwrap();
    let goal: Option<ExitGoal> = hand.scene().groups[0].goal.as_ref().and_then(Goal::read);
    assert!(matches!(goal, Some(ExitGoal(Region::Rectangle(sides))) if sides.center == [9.0, 0.0]));
    // an explicit tolerance is kept
    let text = hand.text().replace("goal.exit", "# goal.exit") + "goal.point = { at = [1, 1], tolerance = 0.5 }\n";
    hand.document.edit(text);
    hand.drag(Tool::Select, &[[1.0, 1.0], [2.0, 2.0]]).unwrap();
    assert!(hand.document.text().contains("goal.point = { at = [2.0, 2.0], tolerance = 0.5 }"), "{}", hand.text());
}

#[test]
fn a_field_is_sketched_and_rubbed_out() {
    let mut hand = Hand::new(Document::empty());
    let before = hand.text();
    assert_eq!(hand.drag(Tool::Anchor, &[[-6.0, 0.0], [-6.0, 1.5]]), Ok(true));
    hand.is_one_step_from(&before);
    assert_eq!(hand.drag(Tool::Stroke, &[[-5.0, 2.0], [0.0, 3.0], [5.0, 2.0]]), Ok(true));
    for (tool, x) in [(Tool::Vortex, -4.0), (Tool::Source, 0.0), (Tool::Sink, 4.0), (Tool::Saddle, 8.0)] {
        assert_eq!(hand.drag(tool, &[[x, -4.0], [x, -2.5]]), Ok(true));
    }
    assert_eq!(hand.scene().fields.len(), 1, "one sketch holds all parts");
    assert!(hand.scene().build().is_ok());
    let sketch = |hand: &Hand| hand.scene().fields[0].flow.read::<Sketch>().unwrap();
    let said = sketch(&hand);
    let anchor = &said.anchors.as_ref().unwrap()[0];
    near(anchor.at, [-6.0, 0.0]);
    near(anchor.velocity, [0.0, 1.0]);
    assert_eq!(said.strokes.as_ref().unwrap()[0].points, [[-5.0, 2.0], [0.0, 3.0], [5.0, 2.0]]);
    assert_eq!(said.stamps.as_ref().unwrap().len(), 4);
    // the tip of the arrow sets the velocity
    hand.drag(Tool::Select, &[[-6.0, 1.5], [-4.5, 1.5]]).unwrap();
    near(sketch(&hand).anchors.unwrap()[0].velocity, [1.0, 1.0]);
    // erasing on an anchor removes it, erasing on a stroke erases a part of it
    hand.director.brush.radius = 1.0;
    hand.click(Tool::Eraser, [-6.2, 0.0]).unwrap();
    hand.click(Tool::Eraser, [0.0, 3.0]).unwrap();
    let said = sketch(&hand);
    assert_eq!((said.anchors.unwrap().len(), said.erase.unwrap().len()), (0, 1));
    assert!(hand.scene().build().is_ok());
}

#[test]
fn a_way_is_painted_over_the_field_that_is_there() {
    let mut hand = Hand::gallery("field-anchors");
    let before = hand.text();
    hand.director.brush.radius = 1.5;
    assert_eq!(hand.drag(Tool::Brush, &[[-10.0, 0.0], [0.0, 5.0], [10.0, 0.0]]), Ok(true));
    hand.is_one_step_from(&before);
    let paint = hand.scene().fields[1].flow.read::<Paint>().unwrap();
    assert_eq!((paint.strokes.len(), paint.strokes[0].radius), (1, Some(1.5)));
    assert_eq!(*paint.on.unwrap(), Named("bend".into()).into());
    hand.drag(Tool::Eraser, &[[0.0, 5.0], [1.0, 5.0]]).unwrap();
    hand.drag(Tool::Anchor, &[[0.0, -6.0], [2.0, -6.0]]).unwrap();
    let paint = hand.scene().fields[1].flow.read::<Paint>().unwrap();
    assert_eq!(paint.strokes[1].erase, Some(true));
    let sketch = hand.scene().fields[0].flow.read::<Sketch>().unwrap();
    assert_eq!(sketch.anchors.as_ref().unwrap().len(), 6, "the field below the paint gets the anchor");
    assert!(hand.scene().build().is_ok());
}

#[test]
fn a_sketch_in_another_field_has_handles_and_takes_anchors() {
    let sketch = "sketch.anchors = [{ at = [3, 2], velocity = [1, 0] }]";
    for (flow, of) in [
        (format!("sum = [{{ of.uniform = [1, 0] }}, {{ of.{sketch} }}]"), "sum.1.of"),
        (format!("keyframes.frames = [{{ at = 0, of.{sketch} }}]"), "keyframes.frames.0.of"),
        (format!("around_walls.of.sampled.of.{sketch}"), "around_walls.of.sampled.of"),
        (format!("paint = {{ min = [0, 0], max = [9, 9], strokes = [], on.{sketch} }}"), "paint.on"),
    ] {
        let text = format!("[[group]]\nplace.point = [0, 0]\nfield.of.{flow}\n");
        let mut hand = Hand::new(Document::new("a", text));
        let parts = throng_studio::direct::parts::Parts::of(hand.scene());
        let changes = parts.handles.iter().flat_map(|handle| &handle.changes).map(|change| format!("{change:?}"));
        let path = format!("group.0.field.of.{of}.sketch.anchors.0.at");
        assert_eq!(changes.filter(|change| change.contains(&path)).count(), 1, "{path}");
        hand.drag(Tool::Anchor, &[[0.0, -6.0], [2.0, -6.0]]).unwrap();
        assert_eq!(hand.text().matches("velocity").count(), 2, "{}", hand.text());
        assert!(hand.scene().fields.is_empty() && hand.scene().build().is_ok(), "{}", hand.text());
    }
}

#[test]
fn every_handle_of_the_gallery_moves_what_it_is_of() {
    for name in gallery::names() {
        let document = Document::gallery(name).unwrap();
        let parts = throng_studio::direct::parts::Parts::of(document.scene().unwrap());
        for handle in parts.handles.iter().step_by(1 + parts.handles.len() / 40) {
            let by = DVec2::new(0.25, 0.125);
            let edit = |edit: &mut throng_studio::document::Edit| {
                handle.changes.iter().try_for_each(|change| change.apply(edit, by, handle.at + by))
            };
            let scene = document.preview(edit).unwrap_or_else(|says| panic!("{name}, {handle:?}: {says}"));
            let moved = throng_studio::direct::parts::Parts::of(&scene);
            let nearest = moved.handles.iter().map(|other| other.at.distance(handle.at + by));
            let off = nearest.fold(f64::INFINITY, f64::min);
            assert!(off < 0.3, "{name}: {handle:?} is {off} m off");
        }
    }
}

/// An obstacle over an agent gives a scene that cannot be built.
#[test]
fn a_gesture_that_gives_no_valid_scene_is_refused() {
    let mut hand = Hand::gallery("circle");
    let before = hand.text();
    let says = hand.drag(Tool::Disc, &[[7.0, 0.0], [7.5, 0.0]]).unwrap_err();
    assert!(says.contains("starts inside obstacle"), "{says}");
    assert_eq!((hand.text(), hand.document.changed()), (before, false));
}

#[test]
fn what_is_directed_runs_as_it_is_saved() {
    let mut hand = Hand::new(Document::empty());
    hand.drag(Tool::Agents, &[[-9.0, 2.0], [-8.0, 2.0], [-7.0, 2.0]]).unwrap();
    hand.drag(Tool::Disc, &[[0.0, 0.0], [1.0, 0.0]]).unwrap();
    hand.drag(Tool::Stroke, &[[-6.0, 1.0], [0.0, 4.0], [6.0, 1.0]]).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("directed.toml");
    std::fs::write(&path, hand.document.text()).unwrap();
    let (mut world, _) = Scene::load(&path).unwrap().build().unwrap();
    (0..150).for_each(|_| world.step());
    let mut engine = Engine::default();
    let scene = hand.document.scene().unwrap().clone();
    engine.command(Command::Load { name: "directed".into(), scene, run: false });
    engine.command(Command::Seek(150));
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(50));
    }
    assert_eq!(engine.shown().unwrap().hash, world.state_hash());
}

#[test]
fn nothing_is_edited_while_the_text_is_wrong() {
    let mut hand = Hand::new(Document::empty());
    let first = Frame::default();
    let stage = DirectedWorld { first: &first, bounds: WorldBox { min: DVec2::ZERO, max: DVec2::ONE }, scale: 20.0 };
    let text = hand.text().replace("goal", "gaol");
    hand.document.edit(text.clone());
    for tool in Tool::all() {
        hand.director.take(tool);
        for event in [Event::Press, Event::Move, Event::Release, Event::Finish] {
            let done = hand.director.point(&mut hand.document, DVec2::ONE, event, stage);
            assert!(done == Ok(false) || done.is_err_and(|says| says.contains("fix the text first")), "{tool:?}");
        }
    }
    assert_eq!(hand.document.text(), text);
}

#[test]
fn tools_are_taken_from_the_bar() {
    let mut director = Director::default();
    let mut harness = Harness::new_ui(|ui| panels::tools(ui, &mut director));
    harness.get_by_label(Tool::Wall.says().2).click();
    harness.run();
    drop(harness);
    assert_eq!(director.tool, Tool::Wall);
    assert_eq!(Tool::of_key(egui::Key::L), Some(Tool::Wall));
}

/// A block of typed sides, drawn in the whole studio.
#[test]
fn a_size_is_typed_while_a_block_is_drawn() {
    let mut harness = crate::layout::studio([1440.0, 900.0], "circle@0&panels.text=true");
    let view = harness.get_by_label("view of the scene").rect();
    harness.get_by_label("block: drag from corner to corner").click();
    harness.run_steps(2);
    let (pos, button, modifiers) = (view.lerp_inside([0.5, 0.5]), PointerButton::Primary, Modifiers::NONE);
    harness.event(egui::Event::PointerMoved(pos));
    harness.run_steps(2);
    harness.event(egui::Event::PointerButton { pos, button, pressed: true, modifiers });
    harness.run_steps(2);
    harness.event(egui::Event::PointerMoved(pos + egui::vec2(40.0, -40.0)));
    harness.run_steps(2);
    harness.event(egui::Event::Text("3 x 22".into()));
    harness.run_steps(2);
    harness.key_press(egui::Key::Backspace);
    harness.run_steps(2);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(4);
    let text = harness.get_by_role(egui::Role::MultilineTextInput).value().unwrap_or_default();
    assert!(text.contains("size = [3.0, 2.0]"), "{text}");
}
