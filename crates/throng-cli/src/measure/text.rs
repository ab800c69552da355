//! The figures for the terminal.

use super::{Measured, mean};
use crate::columns::aligned;
use std::fmt::Write;
use throng_record::swarm::Distribution;

/// Returns the figures of all groups as text.
pub fn text(name: &str, groups: &[Measured]) -> String {
    groups.iter().map(|group| of(name, group)).collect()
}

/// Returns the figures of one group as text.
pub fn of(scene: &str, Measured { name, swarm }: &Measured) -> String {
    let moments = swarm.moments();
    let of = if name.is_empty() { String::new() } else { format!(", {name}") };
    let (from, to) = (moments.first().map_or(0.0, |at| at.time), moments.last().map_or(0.0, |at| at.time));
    let agents = mean(swarm, |moment| moment.count as f64);
    let mut out = format!("{scene}{of}: {agents:.0} agents, {from:.2} to {to:.2} s, {} moments\n", moments.len());
    let heads = ["", "mean", "sd", "least", "most", "skewness", "kurtosis"].map(str::to_owned);
    let row = |what: String, all: &Distribution| -> Vec<String> {
        let figures = [all.mean(), all.deviation(), all.least(), all.most(), all.skewness(), all.kurtosis()];
        std::iter::once(what).chain(figures.map(short)).collect()
    };
    let mut lines = vec![heads.to_vec(), row("speed, m/s".into(), swarm.speed())];
    for (what, unit, all) in [("velocity", "m/s", swarm.velocity()), ("acceleration", "m/s²", swarm.acceleration())] {
        for (axis, all) in ["x", "y", "z"].iter().zip(all).filter(|(_, all)| all.rms() > 0.0) {
            lines.push(row(format!("{what} {axis}, {unit}"), all));
        }
    }
    lines.push(row("nearest neighbour, m".into(), swarm.nearest()));
    out.push_str(&aligned(&lines));
    let falls = swarm
        .correlation()
        .time()
        .map_or("does not fall to 1/e".into(), |time| format!("falls to 1/e in {} s", short(time)));
    let size = short(mean(swarm, |moment| moment.size()));
    let axes = [0, 1, 2].map(|axis| short(mean(swarm, |moment| moment.axes[axis])));
    let polarisation = short(mean(swarm, |moment| moment.polarisation));
    let _ = writeln!(out, "  velocities   autocorrelation {falls}; polarisation {polarisation}");
    let _ = writeln!(out, "  spread       radius of gyration {size} m; along x, y, z {} m", axes.join(", "));
    out
}

/// Formats a number with three significant digits.
pub fn short(value: f64) -> String {
    if !value.is_finite() {
        return "-".into();
    }
    let digits = if value == 0.0 { 0 } else { (2.0 - value.abs().log10().floor()).clamp(0.0, 6.0) as usize };
    let text = format!("{value:.digits$}");
    if text.trim_start_matches('-').bytes().all(|byte| matches!(byte, b'0' | b'.')) { "0".into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn three_digits_count() {
        let all = [1234.5, 12.345, 0.012345, -0.5, 1e-9, -1e-9, 0.0, f64::NAN];
        assert_eq!(all.map(short), ["1234", "12.3", "0.0123", "-0.500", "0", "0", "0", "-"]);
    }
}
