//! The share of the sky that near things do not hide (ambient occlusion in the picture: McGuire, Mara, Luebke, Scalable
//! Ambient Obscurance, 2012). It is found for every other pixel of every other row, and blended for the rest.

use crate::coarse::{Coarse, STRIDE};
use crate::front::{Fronts, blurred, turn};
use crate::{View, parallel};
use glam::{Vec2, Vec3};

/// The distance within which things hide the sky, metres.
const REACH: f32 = 0.9;
/// The number of places that are compared.
const SPOKES: usize = 9;
/// How much of the sky near things hide, at most about 1.
const STRENGTH: f32 = 1.5;
/// The greatest distance in pixels; beyond, the comparison would be slow and coarse.
const FARTHEST: f32 = 90.0;
/// The sine of the angle above a surface from which things hide the sky.
const LEAST: f32 = 0.08;

/// The side of a square of pixels that is left as it is at once where nothing near rises above it.
const TILE: usize = 8;

/// Returns the share of the sky that each pixel sees, 0 to 1.
pub(crate) fn open(fronts: &Fronts, coarse: &Coarse, view: &View) -> Vec<f32> {
    let near = Near::new(coarse, view);
    let width = coarse.fronts.width;
    let rooms = near.rooms();
    let mut raw = vec![1.0; coarse.fronts.all.len()];
    parallel::chunks(&mut raw, width, |row, open| {
        let rooms = &rooms[row / TILE * width.div_ceil(TILE)..];
        open.iter_mut().enumerate().for_each(|(column, open)| *open = near.open([column, row], &rooms[column / TILE]));
    });
    let some = blurred(&raw, &coarse.fronts);
    let mut open = vec![1.0; fronts.all.len()];
    parallel::chunks(&mut open, fronts.width, |row, open| {
        for (column, open) in open.iter_mut().enumerate() {
            let front = &fronts.all[row * fronts.width + column];
            *open = if front.near > 0.0 { coarse.blended(&some, [column, row], front) } else { 1.0 };
        }
    });
    open
}

/// A box about places.
#[derive(Clone, Copy)]
struct Room {
    low: Vec3,
    high: Vec3,
}

impl Room {
    const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    fn add(&mut self, place: Vec3) {
        *self = Self { low: self.low.min(place), high: self.high.max(place) };
    }

    fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether places of two rooms can be near enough to hide the sky from one another.
    fn is_near(&self, other: &Self) -> bool {
        let apart = (self.low - other.high).max(other.low - self.high).max(Vec3::ZERO);
        apart.length_squared() < REACH * REACH
    }

    /// Returns how far the room is above a surface, at most.
    fn above(&self, place: Vec3, normal: Vec3) -> f32 {
        (Vec3::select(normal.cmpgt(Vec3::ZERO), self.high, self.low) - place).dot(normal)
    }
}

/// The chosen pixels, and what is near them.
struct Near<'a> {
    coarse: &'a Coarse,
    /// The places that the chosen pixels see, relative to the viewpoint, metres; infinity for the sky.
    places: Vec<Vec3>,
    view: &'a View,
}

impl<'a> Near<'a> {
    fn new(coarse: &'a Coarse, view: &'a View) -> Self {
        let width = coarse.fronts.width;
        let mut places = vec![Vec3::INFINITY; coarse.fronts.all.len()];
        parallel::chunks(&mut places, width, |row, places| {
            for (column, place) in places.iter_mut().enumerate() {
                let near = coarse.fronts.all[row * width + column].near;
                if near > 0.0 {
                    let pixel = Vec2::new((column * STRIDE) as f32 + 0.5, (row * STRIDE) as f32 + 0.5);
                    *place = view.ray(pixel) * (1.0 / near);
                }
            }
        });
        Self { coarse, places, view }
    }

    /// Returns the distance within which pixels are compared with one of this depth, pixels of the picture.
    fn radius(&self, depth: f32) -> f32 {
        (REACH / self.view.pixel_width(depth)).min(FARTHEST)
    }

    /// Returns the room of all that may hide the sky from the pixels of each tile.
    fn rooms(&self) -> Vec<Room> {
        let width = self.coarse.fronts.width.div_ceil(TILE);
        let height = self.coarse.height.div_ceil(TILE);
        let own = parallel::map(width * height, |tile| {
            let (mut room, mut radius) = (Room::EMPTY, 0.0f32);
            for row in tile / width * TILE..((tile / width + 1) * TILE).min(self.coarse.height) {
                for column in tile % width * TILE..((tile % width + 1) * TILE).min(self.coarse.fronts.width) {
                    let cell = row * self.coarse.fronts.width + column;
                    let near = self.coarse.fronts.all[cell].near;
                    if near > 0.0 {
                        room.add(self.places[cell]);
                        radius = radius.max(self.radius(1.0 / near));
                    }
                }
            }
            (room, radius)
        });
        let span = |at: usize, reach: usize, most: usize| at.saturating_sub(reach)..(at + reach + 1).min(most);
        parallel::map(width * height, |tile| {
            let (room, radius) = own[tile];
            let reach = (radius / (STRIDE * TILE) as f32) as usize + 1;
            let columns = span(tile % width, reach, width);
            let tiles = span(tile / width, reach, height).flat_map(|row| columns.clone().map(move |k| row * width + k));
            tiles.map(|tile| own[tile].0).filter(|other| room.is_near(other)).fold(room, Room::with)
        })
    }

    /// Returns the share of the sky that a chosen pixel sees. `room` holds all that may hide it.
    fn open(&self, at: [usize; 2], room: &Room) -> f32 {
        let (width, height) = (self.coarse.fronts.width, self.coarse.height);
        let cell = at[1] * width + at[0];
        let (front, place) = (self.coarse.fronts.all[cell], self.places[cell]);
        if front.near <= 0.0 {
            return 1.0;
        }
        let depth = 1.0 / front.near;
        let radius = self.radius(depth);
        if radius < 1.0 {
            return 1.0;
        }
        // Other pixels are at least the width of a pixel away.
        if room.above(place, front.normal) <= self.view.pixel_width(depth) * LEAST {
            return 1.0;
        }
        let reach = (radius * self.view.pixel_width(depth)).min(REACH);
        let fading = 1.0 / (reach * reach);
        let middle = Vec2::new(at[0] as f32, at[1] as f32);
        let turn = turn(at[0], at[1]);
        let mut arm = turn.direction;
        // three turns of a spiral
        const STEP: Vec2 = Vec2::new(-0.939_692_6, 0.342_020_14);
        let mut hidden = 0.0;
        for spoke in 0..SPOKES {
            let part = (spoke as f32 + 0.5 + 0.5 * turn.share) / SPOKES as f32;
            let other = middle + arm * ((radius * part * part).max(1.0) / STRIDE as f32) + 0.5;
            arm = arm.rotate(STEP);
            // a negative number becomes a large one
            let (x, y) = (other.x as i32 as u32 as usize, other.y as i32 as u32 as usize);
            if x >= width || y >= height {
                continue;
            }
            let offset = self.places[y * width + x] - place;
            let square = offset.length_squared().max(1e-8);
            let above = offset.dot(front.normal);
            let fade = 1.0 - square * fading;
            if above > 0.0 && fade > 0.0 {
                hidden += (above / square.sqrt() - LEAST).max(0.0) * fade;
            }
        }
        (1.0 - STRENGTH * hidden / SPOKES as f32 * 2.0).clamp(0.0, 1.0)
    }
}
