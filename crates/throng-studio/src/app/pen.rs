//! The pointer of the keyboard: with a tool, arrow keys move a cross over the view, and Enter presses and releases it.

use crate::direct::Tool;
use eframe::egui::{
    Color32, Context, Event, Id, Key, LayerId, Modifiers, Order, PointerButton, Pos2, Rect, Stroke, Vec2,
};

/// How far a key moves the cross, and how far with Shift, points of the screen.
const STEP: f32 = 16.0;
const FINE: f32 = 2.0;
/// The length of the arms of the cross, points of the screen.
const ARM: f32 = 12.0;
/// The name of the layer of the cross.
const LAYER: &str = "pen";

/// The pointer of the keyboard.
#[derive(Clone, Debug, Default)]
pub struct Pen {
    tool: Tool,
    /// Where the cross is. Without one, the mouse has been used last.
    at: Option<Pos2>,
    /// Whether the button is pressed.
    down: bool,
    /// Whether the last input was a key.
    typed: bool,
    /// The control that had the focus before the view.
    from: Option<Id>,
}

impl Pen {
    /// Turns keys into events of the pointer, if a tool works in the view at `place` and no control has the focus. Returns
    /// whether the user wants to leave the tool.
    pub fn take(&mut self, events: &mut Vec<Event>, tool: Tool, place: Rect, ctx: &Context) -> bool {
        let mut made = Vec::new();
        if self.tool != tool {
            self.release(&mut made);
            (self.tool, self.at) = (tool, (tool != Tool::Hand && self.typed).then(|| place.center()));
            self.pass_focus(ctx);
        }
        for event in events.iter() {
            match event {
                Event::Key { pressed: true, .. } => self.typed = true,
                Event::PointerMoved(_) | Event::PointerButton { .. } | Event::Touch { .. } => {
                    self.typed = false;
                    self.release(&mut made);
                    self.at = None;
                }
                _ => {}
            }
        }
        let mut leaves = false;
        if tool != Tool::Hand && ctx.memory(|memory| memory.focused().is_none()) {
            events.retain(|event| match event {
                Event::Key { key, pressed, modifiers, .. } if !modifiers.command && !modifiers.alt => {
                    if *key == Key::Escape {
                        leaves |= *pressed;
                        return true;
                    }
                    !self.key(*key, *pressed, *modifiers, place, &mut made)
                }
                _ => true,
            });
        }
        if !made.is_empty() {
            ctx.request_repaint();
        }
        events.append(&mut made);
        leaves
    }

    /// Handles a key. Returns whether it is one of the pen's.
    fn key(&mut self, key: Key, pressed: bool, modifiers: Modifiers, place: Rect, made: &mut Vec<Event>) -> bool {
        let by = match key {
            Key::ArrowLeft => -Vec2::X,
            Key::ArrowRight => Vec2::X,
            Key::ArrowUp => -Vec2::Y,
            Key::ArrowDown => Vec2::Y,
            Key::Enter if self.at.is_some() => Vec2::ZERO,
            _ => return false,
        };
        if !pressed {
            return true;
        }
        let from = self.at.unwrap_or(place.center());
        let at = place.shrink(1.0).clamp(from + by * if modifiers.shift { FINE } else { STEP });
        self.at = Some(at);
        made.push(Event::PointerMoved(at));
        if key == Key::Enter {
            self.press(at, !self.down, made);
            // tools that work click by click have no drags
            if self.tool.clicks() {
                self.release(made);
            }
        }
        true
    }

    fn press(&mut self, pos: Pos2, pressed: bool, made: &mut Vec<Event>) {
        self.down = pressed;
        made.push(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE });
    }

    fn release(&mut self, made: &mut Vec<Event>) {
        if let Some(at) = self.at.filter(|_| self.down) {
            self.press(at, false, made);
        }
    }

    /// Lets keys reach the view while a tool works there, and gives the focus back afterwards.
    fn pass_focus(&mut self, ctx: &Context) {
        ctx.memory_mut(|memory| match (self.tool, memory.focused()) {
            (Tool::Hand, None) => self.from.take().into_iter().for_each(|id| memory.request_focus(id)),
            (Tool::Hand, Some(_)) => self.from = None,
            (_, Some(id)) => {
                self.from = Some(id);
                memory.surrender_focus(id);
            }
            (_, None) => {}
        });
    }

    /// Draws the cross.
    pub fn draw(&self, ctx: &Context, color: Color32) {
        let Some(at) = self.at else { return };
        let painter = ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique(LAYER)));
        let width = if self.down { 3.0 } else { 1.5 };
        for arm in [Vec2::X * ARM, Vec2::Y * ARM] {
            painter.line_segment([at - arm, at + arm], Stroke::new(width + 2.0, Color32::WHITE));
            painter.line_segment([at - arm, at + arm], Stroke::new(width, color));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACE: Rect = Rect { min: Pos2::new(100.0, 50.0), max: Pos2::new(500.0, 350.0) };

    /// Returns the events of the pointer that keys make, each as its position and whether the button changes.
    fn typed(pen: &mut Pen, tool: Tool, keys: &[(Key, Modifiers)]) -> Vec<(Pos2, Option<bool>)> {
        let ctx = Context::default();
        let mut made = Vec::new();
        for &(key, modifiers) in keys {
            let mut events: Vec<Event> = [true, false]
                .map(|pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers })
                .to_vec();
            pen.take(&mut events, tool, PLACE, &ctx);
            made.extend(events.into_iter().filter_map(|event| match event {
                Event::PointerMoved(at) => Some((at, None)),
                Event::PointerButton { pos, pressed, .. } => Some((pos, Some(pressed))),
                Event::Key { .. } => None,
                other => panic!("{other:?}"),
            }));
        }
        made
    }

    #[test]
    fn a_wall_is_drawn_with_keys() {
        let (mut pen, none) = (Pen::default(), Modifiers::NONE);
        let keys = [(Key::ArrowRight, none), (Key::Enter, none), (Key::ArrowUp, Modifiers::SHIFT), (Key::Enter, none)];
        let [a, b] = [Pos2::new(316.0, 200.0), Pos2::new(316.0, 198.0)];
        let wanted = [(a, None), (a, None), (a, Some(true)), (b, None), (b, None), (b, Some(false))];
        assert_eq!(typed(&mut pen, Tool::Barrier, &keys), wanted);
        // at the edge of the view it stops
        let far = typed(&mut pen, Tool::Barrier, &[(Key::ArrowRight, none); 40]);
        assert_eq!(far.last(), Some(&(Pos2::new(499.0, 198.0), None)));
        // a tool that works click by click
        let clicks = typed(&mut pen, Tool::Polygon, &[(Key::ArrowDown, none), (Key::Enter, none)]);
        assert_eq!(clicks.iter().filter_map(|(_, change)| *change).collect::<Vec<_>>(), [true, false]);
    }

    #[test]
    fn without_a_tool_and_in_controls_keys_stay() {
        let (mut pen, ctx, none) = (Pen::default(), Context::default(), Modifiers::NONE);
        assert_eq!(typed(&mut pen, Tool::Hand, &[(Key::ArrowRight, none), (Key::Enter, none)]), []);
        let key = |key| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: none };
        // Enter is that of the mouse's gestures until the cross is there
        let mut events = vec![key(Key::Enter)];
        let mut fresh = Pen { tool: Tool::Barrier, ..Pen::default() };
        assert!(!fresh.take(&mut events, Tool::Barrier, PLACE, &ctx) && events == [key(Key::Enter)]);
        // a tool taken from a control takes the focus, and gives it back
        let button = Id::unique("button");
        ctx.memory_mut(|memory| memory.request_focus(button));
        let mut events = vec![key(Key::Enter)];
        let mut pen = Pen::default();
        pen.take(&mut events, Tool::Hand, PLACE, &ctx);
        let mut events = Vec::new();
        pen.take(&mut events, Tool::Barrier, PLACE, &ctx);
        assert!(ctx.memory(|memory| memory.focused().is_none()) && pen.at == Some(PLACE.center()));
        let mut events = vec![key(Key::Escape)];
        assert!(pen.take(&mut events, Tool::Barrier, PLACE, &ctx));
        pen.take(&mut Vec::new(), Tool::Hand, PLACE, &ctx);
        assert_eq!((ctx.memory(|memory| memory.focused()), pen.at), (Some(button), None));
    }

    #[test]
    fn the_mouse_takes_over() {
        let (mut pen, none) = (Pen::default(), Modifiers::NONE);
        typed(&mut pen, Tool::Barrier, &[(Key::ArrowRight, none), (Key::Enter, none)]);
        assert!(pen.down);
        let mut events = vec![Event::PointerMoved(Pos2::new(1.0, 2.0))];
        pen.take(&mut events, Tool::Barrier, PLACE, &Context::default());
        assert!(pen.at.is_none() && !pen.down);
        assert!(matches!(events[1], Event::PointerButton { pressed: false, .. }), "{events:?}");
    }
}
