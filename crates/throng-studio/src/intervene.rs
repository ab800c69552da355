//! Intervening in the running scene with the mouse: what the pointer does becomes commands for the player.

use crate::direct::{Tool, simplified};
use crate::play::{Act, Held};
use crate::style::color;
use crate::view::ground;
use eframe::egui::{Color32, CursorIcon, Pos2, Response, Shape, Stroke, Ui};
use glam::{DVec2, Vec2};
use throng_draw::{Projector, Theme};
use throng_scene::{AddAgents, Change, NewGoal, Obstacle, Point, Shape as Outline};

/// The distance at which the pointer takes an obstacle, points of the screen.
const REACH: f64 = 9.0;
/// The tolerance with which a drawn wall is simplified, points of the screen.
const TOLERANCE: f64 = 2.0;

/// The tools that change the running scene, and a gesture under way.
#[derive(Clone, Debug)]
pub struct Intervener {
    /// The number of agents that a click adds.
    pub count: u32,
    /// The radius within which agents are driven away, metres.
    pub radius: f64,
    held: Option<(Held, Point)>,
    line: Vec<DVec2>,
}

impl Default for Intervener {
    fn default() -> Self {
        Self { count: 100, radius: 2.0, held: None, line: Vec::new() }
    }
}

/// The pointer in the view.
#[derive(Clone, Copy, Debug)]
struct Pointer {
    /// Its position on the ground.
    at: DVec2,
    pressed: bool,
    down: bool,
    released: bool,
}

impl Intervener {
    /// Handles input in the view of `response` and draws over it. `group` is the name of the group that gets agents and
    /// goals, `hovered` the agent under the pointer. Returns what the player is to do.
    pub fn ui(
        &mut self,
        ui: &Ui,
        response: &Response,
        (tool, group, hovered): (Tool, &str, Option<u32>),
        (projector, theme): (&Projector, &Theme),
    ) -> Vec<Act> {
        let rect = response.rect;
        let pointer = response.interact_pointer_pos().or(response.hover_pos());
        let at = pointer.and_then(|at| ground(projector, Vec2::new(at.x - rect.min.x, at.y - rect.min.y)));
        let Some(at) = at else { return self.let_go() };
        let pointer = ui.input(|input| Pointer {
            at,
            pressed: input.pointer.primary_pressed() && response.contains_pointer(),
            down: input.pointer.primary_down(),
            released: input.pointer.primary_released(),
        });
        let scale = projector.scale(at.extend(0.0)).max(1e-6);
        let acts = self.point(pointer, (tool, group, hovered), scale);
        ui.ctx().set_cursor_icon(match tool {
            Tool::Grab if self.held.is_some() => CursorIcon::Grabbing,
            Tool::Grab => CursorIcon::Grab,
            _ => CursorIcon::Crosshair,
        });
        let painter = ui.painter_at(rect);
        let place = |at: DVec2| {
            let pixel = projector.pixel(at.extend(0.0))?;
            Some(Pos2::new(rect.min.x + pixel.x, rect.min.y + pixel.y))
        };
        let pen = Stroke::new(2.0, color(theme.palette[1]));
        match tool {
            Tool::Push => _ = painter.add(ring(at, self.radius, place, pen)),
            Tool::Barrier => _ = painter.add(Shape::line(self.line.iter().filter_map(|&at| place(at)).collect(), pen)),
            _ => {}
        }
        acts
    }

    /// Ends a gesture.
    pub fn let_go(&mut self) -> Vec<Act> {
        self.line.clear();
        self.held.take().map(|_| Act::LetGo).into_iter().collect()
    }

    fn point(&mut self, pointer: Pointer, (tool, group, hovered): (Tool, &str, Option<u32>), scale: f64) -> Vec<Act> {
        let at = written(pointer.at);
        if pointer.pressed {
            let made = match tool {
                Tool::Grab => return self.hold(hovered.map(Held::Grab), at),
                Tool::Lead => return self.hold(hovered.map(Held::Lead), at),
                Tool::Push => return self.hold(Some(Held::Push(self.radius)), at),
                Tool::Barrier => {
                    self.line = vec![pointer.at];
                    return Vec::new();
                }
                Tool::Door => return vec![Act::Door(at, REACH / scale)],
                Tool::Crowd => Change::Add(AddAgents { group: group.to_owned(), count: self.count, at, radius: None }),
                Tool::Send => Change::Goal(NewGoal { group: group.to_owned(), point: at }),
                _ => return Vec::new(),
            };
            return vec![Act::Make(made)];
        }
        if pointer.released || !pointer.down {
            let line = simplified(&std::mem::take(&mut self.line), TOLERANCE / scale);
            let mut acts = self.let_go();
            if line.len() > 1 && line[0].distance(line[1]) * scale > REACH {
                let points = line.iter().map(|&at| written(at)).collect();
                acts.push(Act::Make(Change::Obstacle(Obstacle::from(Outline::Wall(points)))));
            }
            return acts;
        }
        if !self.line.is_empty() {
            self.line.push(pointer.at);
        }
        match &mut self.held {
            Some((held, last)) if *last != at => {
                *last = at;
                vec![Act::Hold(*held, at)]
            }
            _ => Vec::new(),
        }
    }

    fn hold(&mut self, held: Option<Held>, at: Point) -> Vec<Act> {
        self.held = held.map(|held| (held, at));
        held.map(|held| Act::Hold(held, at)).into_iter().collect()
    }
}

/// Returns a point in whole millimetres, as the text of the scene has it.
fn written(at: DVec2) -> Point {
    at.to_array().map(|x| (x * 1e3).round() / 1e3)
}

fn ring(center: DVec2, radius: f64, place: impl Fn(DVec2) -> Option<Pos2>, pen: Stroke) -> Shape {
    let angles = (0..48).map(|k| f64::from(k) * std::f64::consts::TAU / 48.0);
    let points = angles.filter_map(|angle| place(center + DVec2::from_angle(angle) * radius));
    Shape::convex_polygon(points.collect(), Color32::TRANSPARENT, pen)
}
