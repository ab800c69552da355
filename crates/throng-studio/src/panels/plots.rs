//! Live plots against time, and the tools to draw meters.

use super::meters::{MeterTool, Meters, color};
use crate::play::{Command, Gauge, Meter, Quantity, RunMoment};
use crate::style;
use eframe::egui::{Align, Color32, Id, Layout, RichText, ScrollArea, Ui};
use egui_plot::{AxisHints, HoverPosition, Line, Plot};
use throng_draw::palette;

/// Indices of the palette that are legible on light and on dark ground, one for each quantity.
const COLORS: [usize; Quantity::ALL.len()] = [0, 7, 2, 3, 1];
/// The time after which a flow is shown, seconds.
const SETTLED: f64 = 1.0;
/// The most points of a line.
const FINE: usize = 500;

/// Shows the plots. Returns the command for the player.
pub fn plots(ui: &mut Ui, shown: &RunMoment, meters: &mut Meters) -> Option<Command> {
    ui.label(RichText::new("Plots").heading());
    let asked = tools(ui, meters);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for (index, gauge) in shown.series.gauges().iter().enumerate() {
            metered(ui, shown, index, gauge);
        }
        // a file of trajectories does not record the guard, and not always the arrivals
        let known = |quantity: &Quantity| match (&shown.reel, quantity) {
            (Some(_), Quantity::Guarded) => false,
            (Some(reel), Quantity::Arrived) => reel.has_arrivals(),
            _ => true,
        };
        for (index, quantity) in Quantity::ALL.into_iter().enumerate().filter(|(_, quantity)| known(quantity)) {
            let value = |sample: &crate::play::Sample| [sample.time, f64::from(sample.values[index])];
            let points: Vec<_> = shown.series.samples().iter().map(value).collect();
            let now = points.last().map_or(f64::NAN, |&[_, value]| value);
            let color = style::color(palette(COLORS[index]));
            let name = (quantity.label(), quantity.unit());
            Chart { name, says: quantity.says(), now: said(now, quantity.unit()), color }.ui(ui, points);
        }
    });
    asked
}

/// Shows the buttons that draw or remove meters.
fn tools(ui: &mut Ui, meters: &mut Meters) -> Option<Command> {
    ui.horizontal(|ui| {
        ui.label(RichText::new("measure").weak());
        for (tool, says, help) in [
            (MeterTool::Line, "Flow", "draw a line in the view to count the agents that cross it in either direction"),
            (MeterTool::Area, "Density", "draw a rectangle in the view to count the agents inside"),
        ] {
            let mut on = meters.tool() == Some(tool);
            if ui.toggle_value(&mut on, says).on_hover_text(help).changed() {
                meters.take_up(on.then_some(tool));
            }
        }
        let clear = !meters.is_empty() && ui.button("Clear").on_hover_text("remove all meters").clicked();
        clear.then(|| meters.clear())
    })
    .inner
}

fn metered(ui: &mut Ui, shown: &RunMoment, index: usize, gauge: &Gauge) {
    let (color, extent, number) = (color(index), gauge.meter().extent(), index + 1);
    let now = shown.frame.time;
    match gauge.meter() {
        Meter::Line(_) => {
            let counts = thinned(gauge.counts().chain([[now, f64::from(gauge.count())]]).collect());
            let begin = counts.first().map_or(0.0, |&[time, _]| time);
            let name = format!("{number}: crossed");
            let says = "agents that have crossed the line in either direction since it was drawn";
            Chart { name: (&name, "agents"), says, now: gauge.count().to_string(), color }.ui(ui, counts);
            let times = shown.series.samples().iter().map(|sample| sample.time).filter(|&time| time >= begin + SETTLED);
            let flows = thinned(times.map(|time| [time, gauge.flow(time)]).collect());
            let flow = gauge.flow(now);
            let name = format!("{number}: flow");
            let says = "crossings per second over the last 5 s, also per metre of the line";
            let now = format!("{flow:.2} /s   {:.2} /(m s)", flow / extent);
            Chart { name: (&name, "1/s"), says, now, color }.ui(ui, flows);
        }
        Meter::Area(_) => {
            let densities = thinned(gauge.densities().collect());
            let last = densities.last().map_or(f64::NAN, |&[_, density]| density);
            let name = format!("{number}: density");
            let now = format!("{}   in {extent:.1} m²", said(last, "1/m²"));
            Chart { name: (&name, "1/m²"), says: "agents in the rectangle over its area", now, color }
                .ui(ui, densities);
        }
    }
}

/// Thins the points to at most [`FINE`], and keeps the last point.
fn thinned(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let (every, last) = (points.len().div_ceil(FINE).max(1), points.len().saturating_sub(1));
    let mut k = 0;
    points.retain(|_| {
        k += 1;
        (k - 1) % every == 0 || k - 1 == last
    });
    points
}

/// Formats a value with its unit.
fn said(value: f64, unit: &str) -> String {
    let digits = if value.abs() >= 10.0 || value == value.round() { 0 } else { 2 };
    if value.is_finite() { format!("{value:.digits$} {unit}").trim_end().to_owned() } else { "–".into() }
}

/// A line against time, with its name and its current value.
struct Chart<'a> {
    /// The name and the unit.
    name: (&'a str, &'a str),
    says: &'a str,
    now: String,
    color: Color32,
}

impl Chart<'_> {
    fn ui(self, ui: &mut Ui, mut points: Vec<[f64; 2]>) {
        let (name, unit) = self.name;
        ui.horizontal(|ui| {
            ui.label(RichText::new(name).strong()).on_hover_text(self.says);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.label(RichText::new(self.now).monospace().color(self.color));
            });
        });
        points.retain(|[_, value]| value.is_finite());
        let together = Id::unique("plots");
        let unit_of = unit.to_owned();
        Plot::new(name)
            .height(86.0)
            .show_background(false)
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .allow_boxed_zoom(false)
            .allow_axis_zoom_drag(false)
            .include_x(0.0)
            .include_y(0.0)
            .y_axis_min_width(34.0)
            .grid_color(ui.visuals().weak_text_color().gamma_multiply(0.5))
            .custom_x_axes(vec![
                AxisHints::new_x().label_spacing(16.0..=30.0).formatter(|mark, _| format!("{} s", mark.value)),
            ])
            .link_cursor(together, [true, false])
            .link_axis(together, [true, false])
            .label_formatter(move |at| match at {
                HoverPosition::NearDataPoint { position, .. } => {
                    Some(format!("{:.2} s\n{}", position.x, said(position.y, &unit_of)))
                }
                HoverPosition::Elsewhere { .. } => None,
            })
            .show(ui, |plot| plot.line(Line::new(name, points).color(self.color).width(1.6)));
        ui.add_space(4.0);
    }
}
