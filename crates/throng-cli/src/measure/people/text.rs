//! The figures of people for the terminal.

use super::People;
use super::moments::numbered;
use crate::columns::aligned;
use crate::measure::short;
use std::fmt::Write;
use throng_record::pedestrian::{Inside, NEAR_MISS, flow, steady_flow};
use throng_record::swarm::Distribution;

impl People {
    /// Returns the figures as text.
    pub fn text(&self, name: &str) -> String {
        let Self { question, figures, .. } = self;
        let (motion, ways, contacts) = (&figures.motion, &figures.ways, &figures.contacts);
        let [from, to] = [figures.instants.first(), figures.instants.last()].map(|at| at.map_or(0.0, |at| at.time));
        let rate = short(1.0 / figures.interval);
        let mut out = format!(
            "{name}: {} people, {from:.2} to {to:.2} s, {} moments, {rate} a second\n",
            figures.people,
            figures.instants.len()
        );
        let heads = ["", "mean", "sd", "least", "most"].map(str::to_owned);
        let row = |what: &str, all: &Distribution| -> Vec<String> {
            let figures = [all.mean(), all.deviation(), all.least(), all.most()];
            std::iter::once(what.to_owned()).chain(figures.map(short)).collect()
        };
        out.push_str(&aligned(&[
            heads.to_vec(),
            row("speed, m/s", &motion.speed),
            row("turning, °/s", &motion.turning),
            row("acceleration, m/s²", &motion.acceleration),
            row("effort, W/kg", &motion.effort),
            row("travel time, s", &ways.time),
            row("path length, m", &ways.length),
            row("path ratio", &ways.ratio),
        ]));
        // Writing to a string does not fail.
        for (k, (area, inside)) in question.areas.iter().zip(&figures.areas).enumerate() {
            let mean = |figure: fn(&Inside) -> f64| short(Inside::mean(inside, figure));
            let (density, cells) = (mean(|at| at.density), mean(|at| at.voronoi_density));
            let (speed, theirs) = (mean(|at| at.speed), mean(|at| at.voronoi_speed));
            let (name, size) = (numbered("area", "_", k, question.areas.len()), short(area.size()));
            let _ = writeln!(out, "  {name:<10} {size} m²: density {density} /m², by Voronoi cells {cells} /m²");
            let _ = writeln!(out, "             speed {speed} m/s, by Voronoi cells {theirs} m/s");
        }
        for (k, (line, crossed)) in question.lines.iter().zip(&figures.crossings).enumerate() {
            let left = crossed.iter().filter(|crossing| crossing.leftwards).count();
            let [first, last] = [crossed.first(), crossed.last()].map(|at| at.map_or(f64::NAN, |at| at.time));
            let (name, length) = (numbered("line", "_", k, question.lines.len()), line.length());
            let _ = writeln!(
                out,
                "  {name:<10} {} m: {} cross it, {left} to its left, from {first:.2} to {last:.2} s",
                short(length),
                crossed.len()
            );
            for (what, flow) in [("flow       ", flow(crossed)), ("steady flow", steady_flow(crossed))] {
                let _ = writeln!(out, "             {what} {} /s, {} /(m s)", short(flow), short(flow / length));
            }
        }
        let [one, other] = figures.directions;
        if one.min(other) > 0 {
            let [order, steady] = [figures.mean(|at| at.lane_order), figures.steady_lane_order()].map(short);
            let _ =
                writeln!(out, "  lanes      {one} people one way, {other} the other; order {order}, steady {steady}");
        }
        let [least, separation, time] = [contacts.least, contacts.separation, contacts.least_time].map(short);
        let (collisions, misses) = (contacts.collisions, contacts.near_misses);
        let _ = writeln!(out, "  nearest    {least} m, {separation} of the sum of radii; {collisions} collisions");
        let _ = writeln!(out, "  near miss  {misses} within {NEAR_MISS} s of a collision; the nearest {time} s");
        let [half, most, all] = [0.5, 0.95, 1.0].map(|part| short(ways.left(part).unwrap_or(f64::NAN)));
        let _ = writeln!(out, "  left       half after {half} s, 95 % after {most} s, all after {all} s");
        out
    }
}
