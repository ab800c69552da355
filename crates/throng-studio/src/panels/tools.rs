//! The toolbar of the editing tools, and the options of the selected tool.

use super::bar::named;
use crate::direct::{Director, Snapping, Tool};
use crate::intervene::Intervener;
use eframe::egui::containers::menu::MenuButton;
use eframe::egui::{
    Color32, ComboBox, DragValue, Painter, Pos2, Rect, Response, RichText, Role, Sense, Shape, Stroke, StrokeKind, Ui,
    Vec2, WidgetInfo, pos2, vec2,
};
use throng_scene::Scene;

/// The space between buttons, and between their groups, points.
const GAP: f32 = 2.0;
const GROUP_GAP: f32 = 7.0;
/// The most columns of the toolbar.
const WIDEST: usize = 4;
/// The height of the bars above and below the view, points.
const BARS: f32 = 260.0;

/// Returns the side of a button, points. A finger needs more room.
fn side(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y.max(28.0)
}

/// Returns the width of a toolbar of this height: one column of buttons, or as many as it needs.
pub fn tools_width(ui: &Ui, height: f32) -> f32 {
    let columns = (1..WIDEST).find(|&columns| tools_height(ui, columns) <= height).unwrap_or(WIDEST);
    columns as f32 * (side(ui) + GAP) - GAP
}

/// Whether the toolbar has room beside the view in a window of this height.
pub fn tools_fit(ui: &Ui, height: f32) -> bool {
    tools_height(ui, WIDEST) + BARS <= height
}

fn tools_height(ui: &Ui, columns: usize) -> f32 {
    let rows: usize = Tool::GROUPS.iter().map(|group| group.len().div_ceil(columns)).sum();
    rows as f32 * (side(ui) + GAP) + (Tool::GROUPS.len() - 1) as f32 * GROUP_GAP
}

/// Shows the toolbar. Groups have as many columns as fit.
pub fn tools(ui: &mut Ui, director: &mut Director) {
    ui.spacing_mut().item_spacing = vec2(GAP, GAP);
    let columns = ((ui.available_width() + GAP) / (side(ui) + GAP)).floor().max(1.0) as usize;
    for (k, group) in Tool::GROUPS.into_iter().enumerate() {
        if k > 0 {
            ui.add_space(GROUP_GAP - GAP);
        }
        for line in group.chunks(columns) {
            ui.horizontal(|ui| {
                for &tool in line {
                    if button(ui, tool, director.tool == tool).clicked() {
                        director.take(tool);
                    }
                }
            });
        }
    }
}

/// Shows a button that opens the toolbar as a menu.
pub fn tool_menu(ui: &mut Ui, director: &mut Director) {
    let (menu, _) = MenuButton::new("Edit").ui(ui, |ui| {
        ui.set_width(4.0 * (side(ui) + GAP) - GAP);
        tools(ui, director);
    });
    menu.on_hover_text("tools that edit the scene in the view");
}

/// Shows the tools that change the running scene, by name.
pub fn live_tools(ui: &mut Ui, director: &mut Director) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("in the running scene").strong());
        for tool in Tool::all().filter(|tool| tool.intervenes() || *tool == Tool::Hand) {
            let says = tool.says().2;
            let name = says.split(':').next().unwrap_or(says);
            if ui.selectable_label(director.tool == tool, name).on_hover_text(says).clicked() {
                director.take(tool);
            }
        }
    });
    ui.add_space(6.0);
}

/// Shows the options of the selected tool: its group, and the settings of the brush or of the change.
pub fn tool_options(ui: &mut Ui, director: &mut Director, intervener: &mut Intervener, scene: &Scene) {
    ui.set_max_width(ui.ctx().content_rect().width() - 60.0);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(director.tool.says().2).weak());
        if director.tool.directs() {
            ui.separator();
            let name = |g: usize| match scene.groups.get(g) {
                Some(group) if !group.name.is_empty() => group.name.clone(),
                _ => format!("group-{}", g + 1),
            };
            director.group = director.group.min(scene.groups.len().saturating_sub(1));
            ui.label("of");
            ComboBox::from_id_salt("directed").selected_text(name(director.group)).show_ui(ui, |ui| {
                for g in 0..scene.groups.len() {
                    ui.selectable_value(&mut director.group, g, name(g));
                }
            });
        }
        if director.tool.snaps() {
            snapping(ui, &mut director.snapping);
        }
        if director.tool == Tool::Crowd {
            ui.add(DragValue::new(&mut intervener.count).range(1..=10_000).suffix(" agents"));
        }
        if director.tool == Tool::Push {
            let radius = DragValue::new(&mut intervener.radius).range(0.2..=100.0).speed(0.05);
            ui.add(radius.prefix("radius ").suffix(" m"));
        }
        if director.tool.brushes() {
            let brush = &mut director.brush;
            ui.separator();
            ui.add(DragValue::new(&mut brush.radius).range(0.2..=50.0).speed(0.05).prefix("radius ").suffix(" m"));
            if director.tool == Tool::Brush {
                ui.add(DragValue::new(&mut brush.speed).range(-5.0..=5.0).speed(0.02).prefix("speed ").suffix(" m/s"));
                ui.add(DragValue::new(&mut brush.strength).range(0.05..=1.0).speed(0.01).prefix("strength "));
            }
        }
    });
}

/// Shows whether and how gestures snap.
fn snapping(ui: &mut Ui, snapping: &mut Snapping) {
    ui.separator();
    let says =
        "corners, edges and a grid attract the pointer, except with Alt; with Shift, directions are multiples of 45°";
    ui.checkbox(&mut snapping.on, "snap").on_hover_text(says);
    if snapping.on {
        let grid = ComboBox::from_id_salt("pitch").selected_text(format!("{} m", snapping.pitch)).width(64.0);
        let grid = grid.show_ui(ui, |ui| {
            for pitch in Snapping::PITCHES {
                ui.selectable_value(&mut snapping.pitch, pitch, format!("{pitch} m"));
            }
        });
        named(&grid.response, Role::ComboBox, "grid");
    }
}

fn button(ui: &mut Ui, tool: Tool, chosen: bool) -> Response {
    let (_, key, says) = tool.says();
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(side(ui)), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, says));
    let visuals = ui.style().interact(&response);
    let (fill, color) = match chosen {
        true => (ui.visuals().selection.bg_fill, ui.visuals().selection.stroke.color),
        false => (visuals.weak_bg_fill, visuals.fg_stroke.color),
    };
    ui.painter().rect_filled(rect, 6.0, fill);
    draw(ui.painter(), Rect::from_center_size(rect.center(), Vec2::splat(14.0)), tool, color);
    response.on_hover_text(format!("{says} ({key})"))
}

fn draw(painter: &Painter, rect: Rect, tool: Tool, color: Color32) {
    let at = |x: f32, y: f32| rect.min + rect.size() * vec2(x, y);
    let pen = Stroke::new(1.5, color);
    let line =
        |points: &[(f32, f32)]| _ = painter.add(Shape::line(points.iter().map(|&(x, y)| at(x, y)).collect(), pen));
    let shut = |points: &[(f32, f32)]| {
        _ = painter.add(Shape::closed_line(points.iter().map(|&(x, y)| at(x, y)).collect::<Vec<Pos2>>(), pen));
    };
    let dot = |x: f32, y: f32, radius: f32| _ = painter.circle_filled(at(x, y), radius, color);
    let ring = |x: f32, y: f32, radius: f32| _ = painter.circle_stroke(at(x, y), radius, pen);
    let arrow = |from: (f32, f32), to: (f32, f32)| {
        let (from, to) = (at(from.0, from.1), at(to.0, to.1));
        let way = (to - from).normalized();
        painter.line_segment([from, to - way * 2.0], pen);
        let tip = vec![to, to - way * 5.0 + way.rot90() * 2.8, to - way * 5.0 - way.rot90() * 2.8];
        painter.add(Shape::convex_polygon(tip, color, Stroke::NONE));
    };
    let side = rect.width();
    match tool {
        Tool::Hand => {
            for (from, to) in [
                ((0.5, 0.4), (0.5, -0.1)),
                ((0.5, 0.6), (0.5, 1.1)),
                ((0.4, 0.5), (-0.1, 0.5)),
                ((0.6, 0.5), (1.1, 0.5)),
            ] {
                arrow(from, to);
            }
        }
        Tool::Select => {
            shut(&[(0.2, 0.0), (0.2, 0.95), (0.42, 0.72), (0.6, 1.08), (0.75, 1.0), (0.58, 0.66), (0.88, 0.62)])
        }
        Tool::Agents => {
            dot(0.4, 0.5, 0.3 * side);
            line(&[(0.95, -0.1), (0.95, 0.4)]);
            line(&[(0.7, 0.15), (1.2, 0.15)]);
        }
        Tool::Polygon => shut(&[(0.5, 0.0), (1.05, 0.45), (0.8, 1.0), (0.15, 0.95), (0.0, 0.35)]),
        Tool::Rectangle => _ = painter.rect_stroke(rect.shrink2(vec2(0.0, 2.0)), 0.0, pen, StrokeKind::Middle),
        Tool::Disc => ring(0.5, 0.5, 0.5 * side),
        Tool::Wall => {
            line(&[(0.0, 0.95), (0.35, 0.2), (0.7, 0.7), (1.05, 0.1)]);
            [(0.0, 0.95), (0.35, 0.2), (0.7, 0.7), (1.05, 0.1)].into_iter().for_each(|(x, y)| dot(x, y, 2.0));
        }
        Tool::Goal => {
            line(&[(0.2, 1.1), (0.2, 0.0)]);
            painter.add(Shape::convex_polygon(vec![at(0.2, 0.0), at(1.0, 0.28), at(0.2, 0.58)], color, Stroke::NONE));
        }
        Tool::Exit => {
            line(&[(0.55, 0.0), (1.0, 0.0), (1.0, 1.0), (0.55, 1.0)]);
            arrow((-0.1, 0.5), (0.75, 0.5));
        }
        Tool::Anchor => {
            dot(0.12, 0.85, 2.6);
            arrow((0.12, 0.85), (1.0, 0.05));
        }
        Tool::Stroke => {
            line(&[(0.0, 0.9), (0.12, 0.55), (0.35, 0.4), (0.6, 0.5), (0.8, 0.4)]);
            arrow((0.75, 0.45), (1.05, 0.0));
        }
        Tool::Vortex => {
            let round = |k: usize| {
                let (sin, cos) = (0.4 + k as f32 * 5.0 / 24.0).sin_cos();
                pos2(at(0.5, 0.5).x + 0.5 * side * cos, at(0.5, 0.5).y - 0.5 * side * sin)
            };
            painter.add(Shape::line((0..=24).map(round).collect(), pen));
            arrow((0.8, 0.97), (1.03, 0.62));
            dot(0.5, 0.5, 1.6);
        }
        Tool::Source => {
            for (x, y) in [(1.1, 1.1), (-0.1, 1.1), (1.1, -0.1), (-0.1, -0.1)] {
                arrow((0.5, 0.5), (x, y));
            }
        }
        Tool::Sink => {
            for (x, y) in [(1.1, 1.1), (-0.1, 1.1), (1.1, -0.1), (-0.1, -0.1)] {
                arrow((x, y), (0.5 + 0.12 * (x - 0.5), 0.5 + 0.12 * (y - 0.5)));
            }
        }
        Tool::Saddle => {
            arrow((0.5, 0.5), (1.15, 0.5));
            arrow((0.5, 0.5), (-0.15, 0.5));
            arrow((0.5, -0.15), (0.5, 0.42));
            arrow((0.5, 1.15), (0.5, 0.58));
        }
        Tool::Brush => {
            painter.line_segment([at(1.05, -0.05), at(0.5, 0.55)], Stroke::new(2.2, color));
            painter.add(Shape::convex_polygon(
                vec![at(0.58, 0.66), at(0.36, 0.44), at(0.1, 0.62), at(-0.05, 1.05), at(0.4, 0.92)],
                color,
                Stroke::NONE,
            ));
        }
        Tool::Grab => {
            ring(0.5, 0.55, 0.22 * side);
            line(&[(0.0, 0.3), (0.0, 0.0), (0.3, 0.0)]);
            line(&[(0.7, 0.0), (1.0, 0.0), (1.0, 0.3)]);
            line(&[(0.0, 0.75), (0.0, 1.05), (0.3, 1.05)]);
            line(&[(0.7, 1.05), (1.0, 1.05), (1.0, 0.75)]);
        }
        Tool::Lead => {
            dot(0.15, 0.85, 0.2 * side);
            arrow((0.35, 0.65), (1.05, -0.05));
        }
        Tool::Push => {
            ring(0.5, 0.5, 0.2 * side);
            for (from, to) in [
                ((0.75, 0.5), (1.15, 0.5)),
                ((0.25, 0.5), (-0.15, 0.5)),
                ((0.5, 0.25), (0.5, -0.15)),
                ((0.5, 0.75), (0.5, 1.15)),
            ] {
                arrow(from, to);
            }
        }
        Tool::Crowd => {
            for (x, y) in [(0.2, 0.2), (0.7, 0.1), (0.45, 0.5), (0.95, 0.55), (0.1, 0.75), (0.6, 0.95)] {
                dot(x, y, 0.15 * side);
            }
        }
        Tool::Barrier => {
            painter.line_segment([at(0.5, -0.05), at(0.5, 1.05)], Stroke::new(3.0, color));
            arrow((-0.15, 0.5), (0.38, 0.5));
        }
        Tool::Door => {
            line(&[(0.05, 1.05), (0.05, 0.0), (0.95, 0.0), (0.95, 1.05)]);
            line(&[(0.05, 0.0), (0.6, 0.3), (0.6, 1.2), (0.05, 1.05)]);
        }
        Tool::Send => {
            line(&[(0.55, 1.1), (0.55, 0.0)]);
            painter.add(Shape::convex_polygon(vec![at(0.55, 0.0), at(1.15, 0.25), at(0.55, 0.5)], color, Stroke::NONE));
            arrow((-0.15, 0.9), (0.4, 0.9));
        }
        Tool::Eraser => {
            shut(&[(0.62, 0.0), (1.05, 0.42), (0.45, 1.0), (0.2, 1.0), (0.0, 0.62)]);
            line(&[(0.3, 0.32), (0.74, 0.74)]);
        }
    }
}
