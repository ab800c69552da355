//! Figures over time as SVG; colours come from the page's style.

use std::fmt::Write;

/// Size of a plot, and where its axes cross: pixels from the left and from the bottom.
const SIZE: [f64; 2] = [560.0, 250.0];
const CORNER: [f64; 2] = [46.0, 38.0];
/// Room above and right of the axes.
const ROOM: [f64; 2] = [14.0, 12.0];

/// What a plot shows.
pub struct Plot<'a> {
    /// What is plotted.
    pub title: &'a str,
    /// Its unit, as it stands at the axis.
    pub unit: &'a str,
    /// The lines, by model: times and values; gaps where a value is no number.
    pub lines: Vec<Vec<(f64, f64)>>,
    /// The top of the axis is at least the first; values above the second are cut off.
    pub top: [f64; 2],
    /// A value to mark, and what it means.
    pub mark: Option<(f64, &'a str)>,
    /// The end of the time axis, seconds.
    pub end: f64,
}

impl Plot<'_> {
    /// The plot as an SVG element.
    pub fn svg(&self) -> String {
        let [width, height] = SIZE;
        let ([left, below], [right, above]) = (CORNER, ROOM);
        let highest = self.lines.iter().flatten().map(|point| point.1).filter(|y| y.is_finite()).fold(0.0, f64::max);
        let top = round_up(highest.max(self.top[0]).min(self.top[1]));
        let end = self.end.max(1e-3);
        let x = |t: f64| left + t / end * (width - left - right);
        let y = |value: f64| height - below - value.min(top) / top * (height - below - above);
        let mut out = format!(
            "<figure class=\"plot\"><figcaption>{} <small>{}</small></figcaption>\n\
             <svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\" data-left=\"{left}\" \
             data-right=\"{}\" data-end=\"{end}\">\n",
            self.title,
            self.unit,
            self.title,
            width - right
        );
        for tick in ticks(top) {
            let (at, label) = (y(tick), number(tick));
            let _ = write!(out, "<path class=\"grid\" d=\"M{left} {at:.1}H{:.1}\"/>", width - right);
            let _ = writeln!(out, "<text class=\"tick end\" x=\"{}\" y=\"{:.1}\">{label}</text>", left - 7.0, at + 4.0);
        }
        for tick in ticks(end) {
            let (at, base) = (x(tick), height - below);
            let _ = write!(out, "<path class=\"axis\" d=\"M{at:.1} {base}v4\"/>");
            let _ =
                writeln!(out, "<text class=\"tick mid\" x=\"{at:.1}\" y=\"{}\">{}</text>", base + 18.0, number(tick));
        }
        let _ = writeln!(out, "<path class=\"axis\" d=\"M{left} {}H{}\"/>", height - below, width - right);
        let _ = writeln!(out, "<text class=\"tick end\" x=\"{}\" y=\"{}\">time, s</text>", width - right, height - 4.0);
        if let Some((value, _)) = self.mark {
            let _ = writeln!(out, "<path class=\"mark\" d=\"M{left} {:.1}H{:.1}\"/>", y(value), width - right);
        }
        for (k, line) in self.lines.iter().enumerate() {
            let mut path = String::new();
            let mut pen = 'M';
            for &(t, value) in line {
                if value.is_finite() || value == f64::INFINITY {
                    let _ = write!(path, "{pen}{:.1} {:.1}", x(t), y(value));
                    pen = 'L';
                } else {
                    pen = 'M';
                }
            }
            if !path.is_empty() {
                let _ = writeln!(out, "<path class=\"line m{}\" d=\"{path}\"/>", k % 8);
            }
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

/// The least of 1, 1.5, 2, 3, 4, 5, 6, 8 and 10 times a power of ten that is not below `value`.
fn round_up(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.into_iter().map(|step| step * power).find(|&top| top >= value * (1.0 - 1e-9)).unwrap_or(10.0 * power)
}

/// Round numbers from 0 to `end`, three to six of them.
fn ticks(end: f64) -> Vec<f64> {
    let power = 10f64.powf((end / 5.0).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|step| step * power).find(|step| end / step <= 5.0 + 1e-9);
    let step = step.unwrap_or(10.0 * power);
    (0..=(end / step + 1e-9) as u32).map(|k| f64::from(k) * step).collect()
}

fn number(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_a_few_round_numbers() {
        assert_eq!(ticks(15.04), [0.0, 5.0, 10.0, 15.0]);
        assert_eq!(ticks(3.0), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!((round_up(36.0), round_up(0.11), round_up(300.0)), (40.0, 0.15000000000000002, 300.0));
        for k in 1..1000 {
            let end = f64::from(k) * 0.37;
            assert!((3..=6).contains(&ticks(end).len()), "{end}: {:?}", ticks(end));
        }
    }

    #[test]
    fn a_gap_lifts_the_pen() {
        let line = vec![(0.0, 1.0), (1.0, 1.0), (2.0, f64::NAN), (3.0, 1.0), (4.0, 1.0)];
        let plot = Plot { title: "", unit: "", lines: vec![line], top: [1.0, 9.0], mark: None, end: 4.0 };
        let svg = plot.svg();
        let path = svg.lines().find(|line| line.contains("line m0")).unwrap();
        assert_eq!((path.matches('M').count(), path.matches('L').count()), (2, 2), "{path}");
    }
}
