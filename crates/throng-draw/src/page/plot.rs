//! Plots of figures over time and of distributions, as SVG; the page's style defines the colours.

use std::borrow::Cow;
use std::fmt::Write;

/// The size of a plot, and the point where its axes cross: pixels from the left and from the bottom.
pub(super) const SIZE: [f64; 2] = [560.0, 250.0];
pub(super) const CORNER: [f64; 2] = [46.0, 38.0];
/// The margins above and right of the axes.
pub(super) const ROOM: [f64; 2] = [14.0, 12.0];

/// The label of a horizontal axis that shows time.
pub const TIME: &str = "time, s";

/// A plot of lines.
pub struct Plot<'a> {
    /// The title.
    pub title: Cow<'a, str>,
    /// The unit of the values, shown beside the title.
    pub unit: &'a str,
    /// The lines: pairs of abscissa and value, with ascending abscissas; NaN values are gaps.
    pub lines: Vec<Vec<(f64, f64)>>,
    /// The range of values.
    pub height: Height,
    /// A marked value and its meaning.
    pub mark: Option<(f64, &'a str)>,
    /// The label of the horizontal axis, with its unit.
    pub axis: &'a str,
    /// The range of the horizontal axis; lines outside are cut off.
    pub span: [f64; 2],
}

/// A set of dots on a plot.
pub struct Dots {
    /// The name in the legend.
    pub name: &'static str,
    /// The colour: that of the line with this number.
    pub colour: usize,
    /// The diameter, pixels.
    pub width: f64,
    /// The positions: pairs of abscissa and value.
    pub points: Vec<(f64, f64)>,
}

/// The range of values of a plot.
#[derive(Clone, Copy)]
pub enum Height {
    /// From 0 to the highest value: at least the first number; values above the second are cut off.
    FromZero([f64; 2]),
    /// From the first number to the second.
    Between([f64; 2]),
    /// Decades from this value to above the highest; lower values, including 0, are gaps.
    Decades(f64),
}

/// The vertical axis. Its ends are logarithms where it shows decades.
pub(super) struct Up {
    low: f64,
    high: f64,
    decades: bool,
}

impl Up {
    fn new(height: Height, values: impl Iterator<Item = f64>) -> Self {
        let highest = values.filter(|y| y.is_finite()).fold(0.0, f64::max);
        let (low, high) = match height {
            Height::FromZero([least, most]) => (0.0, round_up(highest.max(least).min(most))),
            Height::Between([low, high]) => (low, high),
            Height::Decades(least) => (least.log10(), highest.max(10.0 * least).log10().ceil()),
        };
        Self { low, high, decades: matches!(height, Height::Decades(_)) }
    }

    /// Returns the height of a value, 0 to 1; NaN for a gap.
    fn share(&self, value: f64) -> f64 {
        let value = if self.decades && value != f64::INFINITY { value.log10() } else { value };
        let value = if self.decades && value < self.low { f64::NAN } else { value };
        let held = if value.is_nan() { value } else { value.clamp(self.low, self.high) };
        (held - self.low) / (self.high - self.low)
    }

    /// Returns the labelled values of the axis.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        if self.decades {
            let powers = self.low.ceil() as i32..=self.high as i32;
            return powers.map(|power| (10f64.powi(power), format!("1e{power}"))).collect();
        }
        ticks(self.low, self.high).into_iter().map(|tick| (tick, number(tick))).collect()
    }
}

/// The positions of values on a plot.
pub(super) struct Scales {
    pub up: Up,
    start: f64,
    end: f64,
}

impl Scales {
    /// Returns pixels from the left.
    pub fn x(&self, across: f64) -> f64 {
        CORNER[0] + (across - self.start) / (self.end - self.start) * (SIZE[0] - CORNER[0] - ROOM[0])
    }

    /// Returns pixels from the top; NaN for a gap.
    pub fn y(&self, value: f64) -> f64 {
        SIZE[1] - CORNER[1] - self.up.share(value) * (SIZE[1] - CORNER[1] - ROOM[1])
    }

    /// Returns the labelled values of the horizontal axis.
    pub fn across(&self) -> impl Iterator<Item = (f64, String)> {
        ticks(self.start, self.end).into_iter().map(|tick| (tick, number(tick)))
    }

    /// Splits a line at its gaps and converts it to pixels.
    pub fn pieces(&self, line: &[(f64, f64)]) -> Vec<Vec<[f64; 2]>> {
        let seen = |&(across, value): &(f64, f64)| {
            let y = self.y(value);
            (!y.is_nan() && (self.start..=self.end).contains(&across)).then(|| [self.x(across), y])
        };
        let points: Vec<Option<[f64; 2]>> = line.iter().map(seen).collect();
        points
            .split(Option::is_none)
            .filter(|piece| !piece.is_empty())
            .map(|piece| piece.iter().flatten().copied().collect())
            .collect()
    }
}

impl Plot<'_> {
    /// Returns the scales of the plot.
    pub(super) fn scales(&self) -> Scales {
        let up = Up::new(self.height, self.lines.iter().flatten().map(|point| point.1));
        let start = self.span[0];
        Scales { up, start, end: self.span[1].max(start + 1e-3) }
    }

    /// Returns the plot as an SVG element.
    pub fn svg(&self) -> String {
        self.svg_with_dots(&[])
    }

    /// Returns the plot with dots on it as an SVG element. Dots outside the range of the horizontal axis are left out.
    pub fn svg_with_dots(&self, dots: &[Dots]) -> String {
        let [width, height] = SIZE;
        let ([left, below], [right, above]) = (CORNER, ROOM);
        let scales = self.scales();
        let (x, y) = (|across| scales.x(across), |value| scales.y(value));
        let mut out = format!(
            "<figure class=\"plot\"><figcaption>{} <small>{}</small></figcaption>\n\
             <svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\" data-left=\"{left}\" \
             data-right=\"{}\"{}>\n",
            self.title,
            self.unit,
            self.title,
            width - right,
            // The player needs the range of times to map its clock to the plot.
            if self.axis == TIME {
                format!(" data-start=\"{}\" data-end=\"{}\"", scales.start, scales.end)
            } else {
                String::new()
            }
        );
        for (tick, label) in scales.up.ticks() {
            let at = y(tick);
            let _ = write!(out, "<path class=\"grid\" d=\"M{left} {at:.1}H{:.1}\"/>", width - right);
            let _ = writeln!(out, "<text class=\"tick end\" x=\"{}\" y=\"{:.1}\">{label}</text>", left - 7.0, at + 4.0);
        }
        for (tick, label) in scales.across() {
            let (at, base) = (x(tick), height - below);
            let _ = write!(out, "<path class=\"axis\" d=\"M{at:.1} {base}v4\"/>");
            let _ = writeln!(out, "<text class=\"tick mid\" x=\"{at:.1}\" y=\"{}\">{label}</text>", base + 18.0);
        }
        let _ = writeln!(out, "<path class=\"axis\" d=\"M{left} {}H{}\"/>", height - below, width - right);
        let (x_end, foot) = (width - right, height - 4.0);
        let _ = writeln!(out, "<text class=\"tick end\" x=\"{x_end}\" y=\"{foot}\">{}</text>", self.axis);
        if let Some((value, _)) = self.mark {
            let _ = writeln!(out, "<path class=\"mark\" d=\"M{left} {:.1}H{:.1}\"/>", y(value), width - right);
        }
        for (k, line) in self.lines.iter().enumerate() {
            let piece = |piece: Vec<[f64; 2]>| {
                let points: Vec<String> = piece.iter().map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
                format!("M{}", points.join("L"))
            };
            let path: String = scales.pieces(line).into_iter().map(piece).collect();
            if !path.is_empty() {
                let _ = writeln!(out, "<path class=\"line m{}\" d=\"{path}\"/>", k % 8);
            }
        }
        for Dots { colour, width, points, .. } in dots {
            let at = |piece: Vec<[f64; 2]>| piece.iter().map(|[x, y]| format!("M{x:.1} {y:.1}h0")).collect::<String>();
            let path: String = scales.pieces(points).into_iter().map(at).collect();
            let _ = writeln!(out, "<path class=\"dot m{}\" style=\"stroke-width:{width}\" d=\"{path}\"/>", colour % 8);
        }
        if let Some((value, meaning)) = self.mark {
            let (x, y) = (left + 6.0, y(value) + 15.0);
            let _ = writeln!(out, "<text class=\"tick over\" x=\"{x}\" y=\"{y:.1}\">{meaning}</text>");
        }
        let _ = write!(out, "<path class=\"now\" d=\"M{left} {above}V{}\"/>", height - below);
        out.push_str("\n</svg></figure>\n");
        out
    }
}

/// Returns the least of 1, 1.5, 2, 3, 4, 5, 6, 8 and 10 times a power of ten that is not below `value`.
pub fn round_up(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.into_iter().map(|step| step * power).find(|&top| top >= value * (1.0 - 1e-9)).unwrap_or(10.0 * power)
}

/// Returns three to six round numbers from `start` to `end`.
fn ticks(start: f64, end: f64) -> Vec<f64> {
    let length = end - start;
    let power = 10f64.powf((length / 5.0).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|step| step * power).find(|step| length / step <= 5.0 + 1e-9);
    let step = step.unwrap_or(10.0 * power);
    let first = (start / step - 1e-9).ceil() as i64;
    (first..=(end / step + 1e-9).floor() as i64).map(|k| k as f64 * step).collect()
}

fn number(value: f64) -> String {
    // Adding 0 turns -0 into 0.
    format!("{}", (value * 1e4).round() / 1e4 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_a_few_round_numbers() {
        assert_eq!(ticks(0.0, 15.04), [0.0, 5.0, 10.0, 15.0]);
        assert_eq!(ticks(0.0, 3.0), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(ticks(-0.4, 1.0), [0.0, 0.5, 1.0]);
        assert_eq!((round_up(36.0), round_up(0.11), round_up(300.0)), (40.0, 0.15000000000000002, 300.0));
        for k in 1..1000 {
            let end = f64::from(k) * 0.37;
            assert!((3..=6).contains(&ticks(0.0, end).len()), "{end}: {:?}", ticks(0.0, end));
            assert!((2..=6).contains(&ticks(-0.3 * end, end).len()), "{end}: {:?}", ticks(-0.3 * end, end));
        }
    }

    fn plot(line: Vec<(f64, f64)>, height: Height) -> String {
        let plot =
            Plot { title: "".into(), unit: "", lines: vec![line], height, mark: None, axis: "", span: [0.0, 4.0] };
        plot.svg().lines().find(|line| line.contains("line m0")).unwrap_or_default().to_owned()
    }

    #[test]
    fn dots_are_where_lines_would_be() {
        let points = [(1.0, 1.0), (2.0, 2.0), (9.0, 1.0)];
        let plot = Plot {
            title: "".into(),
            unit: "",
            lines: vec![points.to_vec()],
            height: Height::Between([0.0, 4.0]),
            mark: None,
            axis: "",
            span: [0.0, 4.0],
        };
        let svg = plot.svg_with_dots(&[Dots { name: "", colour: 3, width: 5.0, points: points.to_vec() }]);
        let path =
            |class: &str| svg.lines().find(|line| line.contains(class)).unwrap().split("d=").nth(1).unwrap().to_owned();
        assert_eq!(path("dot m3").replace("h0M", "L").replace("h0", ""), path("line m0"));
    }

    #[test]
    fn a_gap_lifts_the_pen() {
        let line = vec![(0.0, 1.0), (1.0, 1.0), (2.0, f64::NAN), (3.0, 1.0), (4.0, 1.0), (5.0, 1.0)];
        let path = plot(line, Height::FromZero([1.0, 9.0]));
        assert_eq!((path.matches('M').count(), path.matches('L').count()), (2, 2), "{path}");
    }

    #[test]
    fn decades_are_evenly_spaced_and_zero_is_a_gap() {
        let line = vec![(0.0, 0.1), (1.0, 0.01), (2.0, 0.001), (3.0, 0.0), (4.0, 1e-9)];
        let path = plot(line, Height::Decades(1e-3));
        let heights: Vec<f64> =
            path.split(['M', 'L']).skip(1).map(|at| at.split([' ', '"']).nth(1).unwrap().parse().unwrap()).collect();
        assert_eq!(heights.len(), 3, "{path}");
        assert!((heights[2] + heights[0] - 2.0 * heights[1]).abs() < 0.2 && heights[2] == 212.0, "{heights:?}");
    }
}
