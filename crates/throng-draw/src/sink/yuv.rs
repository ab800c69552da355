//! Converts RGB to video colours: BT.709 (ITU-R BT.709-6), 8 bits, studio range, chroma at half the resolution.

use crate::Image;

/// Fixed point: the weights are in units of 2^-16.
const BITS: i32 = 16;

/// Returns the weight of a channel that spans 255, scaled to `range` steps.
const fn weight(w: f64, range: f64) -> i32 {
    let scaled = w * range / 255.0 * (1 << BITS) as f64;
    (scaled + if scaled < 0.0 { -0.5 } else { 0.5 }) as i32
}

const Y: [i32; 3] = [weight(0.2126, 219.0), weight(0.7152, 219.0), weight(0.0722, 219.0)];
/// Cb is (B - Y) / 1.8556, Cr is (R - Y) / 1.5748.
const CB: [i32; 3] = [weight(-0.2126 / 1.8556, 224.0), weight(-0.7152 / 1.8556, 224.0), weight(0.5, 224.0)];
const CR: [i32; 3] = [weight(0.5, 224.0), weight(-0.7152 / 1.5748, 224.0), weight(-0.0722 / 1.5748, 224.0)];

/// A picture in video colours: three planes with even sides.
#[derive(Clone, Debug, Default)]
pub(super) struct Yuv {
    pub width: usize,
    pub height: usize,
    pub y: Vec<u8>,
    pub u: Vec<u8>,
    pub v: Vec<u8>,
}

impl Yuv {
    /// Converts a picture. Odd sides become even by repeating the last row or column.
    pub(super) fn read(&mut self, image: &Image) {
        let (w, h) = (image.width() as usize, image.height() as usize);
        (self.width, self.height) = (w.next_multiple_of(2), h.next_multiple_of(2));
        self.y.resize(self.width * self.height, 0);
        self.u.resize(self.width * self.height / 4, 0);
        self.v.resize(self.width * self.height / 4, 0);
        let mut odd = [Vec::new(), Vec::new()];
        for pair in 0..self.height / 2 {
            let rows = [2 * pair, (2 * pair + 1).min(h - 1)].map(|r| &image.data()[r * w * 4..(r + 1) * w * 4]);
            let [mut a, mut b] = rows;
            if w % 2 == 1 {
                for (row, wide) in rows.iter().zip(&mut odd) {
                    wide.clear();
                    wide.extend_from_slice(row);
                    wide.extend_from_slice(&row[row.len() - 4..]);
                }
                [a, b] = [&odd[0][..], &odd[1][..]];
            }
            let (ya, yb) = self.y[2 * pair * self.width..][..2 * self.width].split_at_mut(self.width);
            luma(a, ya);
            luma(b, yb);
            let half = self.width / 2;
            chroma(a, b, &mut self.u[pair * half..][..half], &mut self.v[pair * half..][..half]);
        }
    }
}

fn luma(row: &[u8], y: &mut [u8]) {
    for (p, y) in row.chunks_exact(4).zip(y) {
        let sum = Y[0] * i32::from(p[0]) + Y[1] * i32::from(p[1]) + Y[2] * i32::from(p[2]);
        *y = ((sum + (16 << BITS) + (1 << (BITS - 1))) >> BITS) as u8;
    }
}

fn chroma(a: &[u8], b: &[u8], u: &mut [u8], v: &mut [u8]) {
    // The sum of four pixels needs two more bits.
    const SHIFT: i32 = BITS + 2;
    const MIDDLE: i32 = (128 << SHIFT) + (1 << (SHIFT - 1));
    for (((a, b), u), v) in a.chunks_exact(8).zip(b.chunks_exact(8)).zip(u).zip(v) {
        let sum = |k: usize| i32::from(a[k]) + i32::from(a[k + 4]) + i32::from(b[k]) + i32::from(b[k + 4]);
        let (red, green, blue) = (sum(0), sum(1), sum(2));
        *u = ((CB[0] * red + CB[1] * green + CB[2] * blue + MIDDLE) >> SHIFT) as u8;
        *v = ((CR[0] * red + CR[1] * green + CR[2] * blue + MIDDLE) >> SHIFT) as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;

    #[test]
    fn colours_come_back_through_the_matrix_of_the_standard() {
        for hex in [0x000000, 0xffffff, 0xff0000, 0x00ff00, 0x0000ff, 0x3866b6, 0xe38c2e, 0xf6f5f1] {
            let color = Color::rgb(hex);
            let mut yuv = Yuv::default();
            yuv.read(&Image::new(4, 4, color));
            let y = (f64::from(yuv.y[5]) - 16.0) / 219.0;
            let (cb, cr) = ((f64::from(yuv.u[1]) - 128.0) / 224.0, (f64::from(yuv.v[1]) - 128.0) / 224.0);
            let (r, b) = (y + 1.5748 * cr, y + 1.8556 * cb);
            let g = (y - 0.2126 * r - 0.0722 * b) / 0.7152;
            for (got, want) in [(r, color.r), (g, color.g), (b, color.b)] {
                assert!((got * 255.0 - f64::from(want)).abs() < 2.5, "{color:?}: {got}");
            }
        }
    }

    #[test]
    fn odd_sides_are_made_even() {
        let mut yuv = Yuv::default();
        yuv.read(&Image::new(5, 7, Color::rgb(0xffffff)));
        assert_eq!((yuv.width, yuv.height), (6, 8));
        assert!(yuv.y.iter().all(|&y| y == 235));
        assert!(yuv.u.iter().chain(&yuv.v).all(|&c| c == 128));
    }
}
