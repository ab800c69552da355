//! Colours, and the palette of groups.

use std::sync::LazyLock;
use throng_record::color;

/// A colour with 8 bits per channel, sRGB, alpha not premultiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Color {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// Opacity; 255 is opaque.
    pub a: u8,
}

impl Color {
    /// Returns an opaque colour from `0xRRGGBB`.
    pub const fn rgb(hex: u32) -> Self {
        Self { r: (hex >> 16) as u8, g: (hex >> 8) as u8, b: hex as u8, a: 255 }
    }

    const fn of([r, g, b]: [u8; 3]) -> Self {
        Self { r, g, b, a: 255 }
    }

    /// Returns the same colour with an opacity of `alpha`, 0 to 1.
    pub fn alpha(self, alpha: f32) -> Self {
        Self { a: (alpha.clamp(0.0, 1.0) * 255.0).round() as u8, ..self }
    }

    /// Returns the same colour with its opacity times `share`.
    pub fn faded(self, share: f32) -> Self {
        self.alpha(share * f32::from(self.a) / 255.0)
    }

    /// Interpolates to `other`; `t` is 0 to 1.
    pub fn mix(self, other: Self, t: f32) -> Self {
        let mix = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * t.clamp(0.0, 1.0) + 0.5) as u8;
        Self { r: mix(self.r, other.r), g: mix(self.g, other.g), b: mix(self.b, other.b), a: mix(self.a, other.a) }
    }

    /// Returns this colour as it looks on a ground.
    pub fn over(self, ground: Self) -> Self {
        Self { a: 255, ..ground.mix(Self { a: 255, ..self }, f32::from(self.a) / 255.0) }
    }

    /// Returns the contrast with another colour, 1 to 21, by the formula of WCAG 2.2 (relative luminance). Both are opaque.
    ///
    /// ```
    /// use throng_draw::Color;
    /// let contrast = Color::rgb(0x76_7676).contrast(Color::rgb(0xff_ffff));
    /// assert!((contrast - 4.54).abs() < 0.01, "the lightest grey for type on white");
    /// ```
    pub fn contrast(self, other: Self) -> f64 {
        let (a, b) = (self.luminance() + 0.05, other.luminance() + 0.05);
        (a / b).max(b / a)
    }

    /// Returns the relative luminance, 0 to 1.
    fn luminance(self) -> f64 {
        let [r, g, b] = [self.r, self.g, self.b].map(|value| LIGHT[usize::from(value)]);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Returns this colour, mixed with that of the type as little as a contrast of `least` with all of these grounds needs.
    pub fn legible(self, grounds: &[Self], text: Self, least: f64) -> Self {
        const STEPS: u8 = 20;
        let mixed = (0..=STEPS).map(|step| self.mix(text, f32::from(step) / f32::from(STEPS)));
        let is_clear = |color: &Self| grounds.iter().all(|&ground| color.over(ground).contrast(ground) >= least);
        mixed.into_iter().find(is_clear).unwrap_or(text)
    }

    /// Returns `#rrggbb`, without the opacity.
    pub fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.r, self.g, self.b)
    }
}

/// The linear light of each value of sRGB, 0 to 1.
pub(crate) static LIGHT: LazyLock<[f64; 256]> = LazyLock::new(|| {
    std::array::from_fn(|value| {
        let value = value as f64 / 255.0;
        if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
    })
});

/// The colours of groups and goals on dark ground, in the order of [`PALETTE`] and with its hues: each has a contrast of
/// at least 3.6 with the ground of [`Theme::dark`](crate::Theme::dark), and they are distinguishable for the three kinds of
/// colour blindness.
pub const PALETTE_ON_DARK: [Color; 8] = [
    Color::rgb(0x5184d8),
    Color::rgb(0xec9a39),
    Color::rgb(0x2fb780),
    Color::rgb(0xbb7eb9),
    Color::rgb(0xb7cff5),
    Color::rgb(0x83787f),
    Color::rgb(0xe6e77c),
    Color::rgb(0xd05f33),
];

/// The colours of groups and goals, in order ([`throng_record::color::PALETTE`]). A test checks that they are
/// distinguishable for the three kinds of colour blindness.
pub const PALETTE: [Color; 8] = {
    let mut colors = [Color::rgb(0); 8];
    let mut k = 0;
    while k < colors.len() {
        colors[k] = Color::of(color::PALETTE[k]);
        k += 1;
    }
    colors
};

/// Returns the colour of the group or goal `index`: the palette, repeated in paler rounds.
pub fn palette(index: usize) -> Color {
    Color::of(color::palette(index))
}

/// The stops of the ramp for speeds, slow to fast, with rising lightness.
const RAMP: [Color; 5] =
    [Color::rgb(0x2d3a6b), Color::rgb(0x35719a), Color::rgb(0x3fa38f), Color::rgb(0x8fbd59), Color::rgb(0xecb93c)];

/// Returns the colour of a quantity `t` between 0 (least) and 1 (most).
pub fn ramp(t: f32) -> Color {
    let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 } * (RAMP.len() - 1) as f32;
    let k = (t as usize).min(RAMP.len() - 2);
    RAMP[k].mix(RAMP[k + 1], t - k as f32)
}

/// Returns the colour of a direction, given as a fraction of a turn, without a jump at a full turn. Lightness rises and
/// falls once, so that opposite directions differ for colour-blind people too.
pub fn wheel(turn: f32) -> Color {
    const STOPS: [Color; 6] = [
        Color::rgb(0x2f74a8),
        Color::rgb(0x3aa09a),
        Color::rgb(0xa9c15a),
        Color::rgb(0xeba94a),
        Color::rgb(0xcf6463),
        Color::rgb(0x74519a),
    ];
    let t = turn.rem_euclid(1.0) * STOPS.len() as f32;
    let k = (t as usize).min(STOPS.len() - 1);
    STOPS[k].mix(STOPS[(k + 1) % STOPS.len()], t - k as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the linear light of one channel.
    fn linear(c: u8) -> f64 {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    }

    /// How colour-blind people see a colour, as matrices in linear light: Machado, Oliveira and Fernandes (2009),
    /// severity 1. The first is normal vision.
    const EYES: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    ];

    /// Returns CIE L*a*b* of linear sRGB, D65.
    fn lab(rgb: [f64; 3]) -> [f64; 3] {
        let dot = |w: [f64; 3]| w[0] * rgb[0] + w[1] * rgb[1] + w[2] * rgb[2];
        let f = |t: f64| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
        let x = f(dot([0.4124, 0.3576, 0.1805]) / 0.9505);
        let y = f(dot([0.2126, 0.7152, 0.0722]));
        let z = f(dot([0.0193, 0.1192, 0.9505]) / 1.089);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    fn difference(eye: &[[f64; 3]; 3], a: Color, b: Color) -> f64 {
        let see = |c: Color| {
            let c = [linear(c.r), linear(c.g), linear(c.b)];
            lab(eye.map(|row| (row[0] * c[0] + row[1] * c[1] + row[2] * c[2]).clamp(0.0, 1.0)))
        };
        let (a, b) = (see(a), see(b));
        ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
    }

    #[test]
    fn the_palette_is_distinguishable_for_colour_blind_people() {
        for (n, eye) in EYES.iter().enumerate() {
            for palette in [PALETTE, PALETTE_ON_DARK] {
                for (i, &a) in palette.iter().enumerate() {
                    for (j, &b) in palette[..i].iter().enumerate() {
                        let d = difference(eye, a, b);
                        assert!(d >= 18.0, "eye {n}: colours {j} and {i} differ by only {d:.1}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_ramp_gets_lighter_all_the_way() {
        let light = |t: f32| {
            let c = ramp(t);
            lab([linear(c.r), linear(c.g), linear(c.b)])[0]
        };
        for k in 0..50 {
            assert!(light((k + 1) as f32 / 50.0) > light(k as f32 / 50.0));
        }
    }

    #[test]
    fn the_wheel_has_no_jump() {
        assert_eq!(wheel(0.0), wheel(1.0));
        assert_eq!(wheel(-0.25), wheel(0.75));
    }
}
