//! The levels of a mesh: faces connected by walkable edges and steps.

use super::walk::{Face, STEP, is_walkable, size};
use crate::error::{Error, Kind};
use std::collections::BTreeMap;

/// Corners nearer than this are the same corner, metres.
const WELD: f64 = 1e-3;
/// The least size of a level with a number, relative to the largest level.
const LARGE: f64 = 0.01;
/// The maximum number of levels that a note lists.
const LISTED: usize = 12;

/// A level of a mesh, and the other faces.
pub(super) struct Levels {
    /// The faces of the chosen level, including the steps between them.
    pub level: Vec<Face>,
    pub others: Vec<Face>,
    /// A list of the levels, if there are several.
    pub note: Option<String>,
}

/// The properties of a level.
struct Level {
    /// The index of its first face.
    root: usize,
    /// Area, m².
    size: f64,
    /// Mean height, metres.
    height: f64,
}

impl Levels {
    /// Selects a level: by its number, from 1 for the lowest, or else the largest.
    ///
    /// # Errors
    /// There is no such level.
    pub fn of(faces: &[Face], asked: Option<u64>) -> Result<Self, Error> {
        let roots = roots(faces);
        let mut levels: BTreeMap<usize, Level> = BTreeMap::new();
        for (face, root) in faces.iter().zip(&roots).filter(|(face, _)| is_walkable(face)) {
            let Some(root) = *root else { continue };
            let level = levels.entry(root).or_insert(Level { root, size: 0.0, height: 0.0 });
            level.size += size(face);
            level.height += size(face) * face.iter().map(|p| p.z).sum::<f64>() / 3.0;
        }
        let largest = levels.values().map(|level| level.size).fold(0.0, f64::max);
        let (mut known, small): (Vec<Level>, Vec<Level>) =
            levels.into_values().partition(|level| level.size >= LARGE * largest);
        known.iter_mut().for_each(|level| level.height /= level.size);
        known.sort_by(|a, b| a.height.total_cmp(&b.height).then(a.root.cmp(&b.root)));
        let chosen = match asked {
            None => known.iter().position(|level| level.size == largest),
            Some(number) => usize::try_from(number).ok().and_then(|number| number.checked_sub(1)),
        };
        let Some(chosen) = chosen.filter(|chosen| *chosen < known.len()) else {
            let message = format!("this mesh has no level {}", asked.unwrap_or_default());
            return Err(Error::new(Kind::OutOfRange, message).hint(format!("it has {}", list(&known))));
        };
        let root = Some(known[chosen].root);
        let (inside, outside): (Vec<usize>, Vec<usize>) = (0..faces.len()).partition(|i| roots[*i] == root);
        let of = |places: Vec<usize>| places.into_iter().map(|i| faces[i]).collect();
        let note = (known.len() > 1).then(|| {
            let taken = if asked.is_none() { ", the largest," } else { "" };
            format!(
                "{}: level {}{taken} is taken; --level N, in a scene `level`, chooses another",
                list(&known),
                chosen + 1
            )
        });
        let rest = small.iter().map(|level| level.size).sum::<f64>();
        let smaller = (rest > LARGE * largest)
            .then(|| format!("{} smaller levels of {rest:.1} m² in all are left out", small.len()));
        let note = match (note, smaller) {
            (Some(note), Some(smaller)) => Some(format!("{note}; {smaller}")),
            (note, smaller) => note.or(smaller),
        };
        Ok(Self { level: of(inside), others: of(outside), note })
    }
}

/// Lists the levels with their numbers.
fn list(levels: &[Level]) -> String {
    let one = |(i, level): (usize, &Level)| {
        let height = if level.height.abs() < 0.05 { 0.0 } else { level.height };
        format!("{} (at {height:.1} m, {:.1} m²)", i + 1, level.size)
    };
    let some: Vec<String> = levels.iter().enumerate().take(LISTED).map(one).collect();
    let more = if levels.len() > LISTED { format!(" and {} more", levels.len() - LISTED) } else { String::new() };
    let levels = if levels.len() == 1 { "one level" } else { "levels" };
    format!("{levels} {}{more}", some.join(", "))
}

/// Returns, for every face that agents can walk on or step over, the first face connected to it.
fn roots(faces: &[Face]) -> Vec<Option<usize>> {
    let tall = |face: &Face| {
        let [a, b, c] = face.map(|p| p.z);
        a.max(b).max(c) - a.min(b).min(c)
    };
    let belongs: Vec<bool> = faces.iter().map(|face| is_walkable(face) || tall(face) <= STEP).collect();
    let key = |p: crate::geometry::DVec3| (p / WELD).round().to_array().map(|x| x as i64);
    let mut edges: BTreeMap<[[i64; 3]; 2], Vec<usize>> = BTreeMap::new();
    for (i, face) in faces.iter().enumerate().filter(|(i, _)| belongs[*i]) {
        for k in 0..3 {
            let mut ends = [key(face[k]), key(face[(k + 1) % 3])];
            ends.sort_unstable();
            edges.entry(ends).or_default().push(i);
        }
    }
    let mut parent: Vec<usize> = (0..faces.len()).collect();
    for sharing in edges.values() {
        for pair in sharing.windows(2) {
            let (a, b) = (root(&mut parent, pair[0]), root(&mut parent, pair[1]));
            parent[a.max(b)] = a.min(b);
        }
    }
    (0..faces.len()).map(|i| belongs[i].then(|| root(&mut parent, i))).collect()
}

/// Returns the first face connected to a face.
fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}
