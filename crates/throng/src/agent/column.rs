//! A fact about all agents: kept once while it is the same for everybody.

use super::{Cycles, GroupId, JourneyId, ScriptId};
use crate::lanes::from_side_by_side;
use crate::motion::{Attitude, Basis};
use fearless_simd::prelude::*;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::ops::{Index, Range};

/// What a [`Column`] can hold.
pub trait Value: Copy {
    /// Whether two are the same to the bit: then either can stand for the other.
    fn same(self, other: Self) -> bool;
}

macro_rules! value {
    ($($type:ty: |$value:ident| $bits:expr,)*) => {
        $(impl Value for $type {
            #[inline]
            fn same(self, other: Self) -> bool {
                let bits = |$value: Self| $bits;
                bits(self) == bits(other)
            }
        })*
    };
}

value! {
    bool: |value| value,
    u32: |value| value,
    f32: |value| value.to_bits(),
    f64: |value| value.to_bits(),
    Vec2: |value| [value.x.to_bits(), value.y.to_bits()],
    GroupId: |value| value,
    JourneyId: |value| value,
    Option<ScriptId>: |value| value,
    Attitude: |value| {
        let Basis { forward, side, up } = value.basis;
        [forward, side, up, value.acceleration, value.curvature].map(|v| v.to_array().map(f32::to_bits))
    },
}

/// A value for every row. While all are the same to the bit it holds one, whatever the number of rows; reading a row
/// takes no branch either way.
///
/// ```
/// use throng::agent::Column;
/// let mut radii: Column<f32> = std::iter::repeat_n(0.2, 1000).collect();
/// assert_eq!((radii[500], radii.uniform(), radii.values().len()), (0.2, Some(0.2), 1));
/// radii.set(7, 0.3);
/// assert_eq!((radii[6], radii[7], radii.uniform(), radii.values().len()), (0.2, 0.3, None, 1000));
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "Saved<T>", into = "Saved<T>")]
#[serde(bound(serialize = "T: Value + Serialize", deserialize = "T: Value + Deserialize<'de>"))]
pub struct Column<T> {
    /// One value if `mask` is 0, else one a row.
    values: Vec<T>,
    /// What of a row is an index into `values`: nothing, or all of it.
    mask: usize,
    len: usize,
    /// Rows there will be, as far as known.
    room: usize,
}

impl<T> Default for Column<T> {
    fn default() -> Self {
        Self { values: Vec::new(), mask: 0, len: 0, room: 0 }
    }
}

impl<T> Column<T> {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The values that occur: one for all rows, or one a row. What concerns any of them, or the greatest, needs no look
    /// at every row.
    #[inline]
    pub fn values(&self) -> &[T] {
        &self.values
    }
}

impl<T: Value> Column<T> {
    /// The value of every row, if it is known to be the same. None for no rows.
    #[inline]
    pub fn uniform(&self) -> Option<T> {
        if self.mask == 0 { self.values.first().copied() } else { None }
    }

    /// The values of all rows.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = T> + '_ {
        (0..self.len).map(|row| self[row])
    }

    /// The values that occur, to change: one of all rows at once, or one a row.
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// Becomes what `f` makes of the values of another, in the memory it has. It must make the same of the same.
    pub fn map_from<U: Value>(&mut self, other: &Column<U>, f: impl FnMut(U) -> T) {
        self.values.clear();
        self.values.extend(other.values.iter().copied().map(f));
        (self.mask, self.len, self.room) = (other.mask, other.len, other.room);
    }

    /// Makes room for more rows.
    pub fn reserve(&mut self, additional: usize) {
        self.room = self.len + additional;
        if self.mask != 0 {
            self.values.reserve(additional);
        }
    }

    /// Adds a row.
    pub fn push(&mut self, value: T) {
        match self.values.first() {
            Some(first) if self.mask == 0 => {
                if !first.same(value) {
                    self.spread();
                    self.values.push(value);
                }
            }
            _ => self.values.push(value),
        }
        self.len += 1;
    }

    /// Sets the value of a row.
    ///
    /// # Panics
    /// If there is no such row.
    #[inline]
    pub fn set(&mut self, row: usize, value: T) {
        assert!(row < self.len, "row {row} of {}", self.len);
        if self.mask == 0 && self.len > 1 {
            if self.values[0].same(value) {
                return;
            }
            self.spread();
        }
        self.values[row] = value;
    }

    /// The values of all rows, to change one by one.
    pub(crate) fn rows_mut(&mut self) -> &mut [T] {
        if self.mask == 0 && self.len > 1 {
            self.spread();
        }
        &mut self.values
    }

    /// Exchanges the values of all rows for others.
    ///
    /// # Panics
    /// If there are more or fewer.
    pub(crate) fn exchange(&mut self, values: &mut Vec<T>) {
        assert_eq!(values.len(), self.len, "a value for every row");
        self.rows_mut();
        std::mem::swap(&mut self.values, values);
    }

    /// Removes a row; the last row takes its place.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn swap_remove(&mut self, row: usize) {
        assert!(row < self.len, "row {row} of {}", self.len);
        self.len -= 1;
        if self.mask != 0 || self.len == 0 {
            self.values.swap_remove(row);
        }
        if self.len == 0 {
            self.mask = 0;
        }
    }

    /// Moves rows along cycles. Notices if all have become the same.
    pub(crate) fn permute(&mut self, cycles: &Cycles) {
        if self.mask != 0 && self.all_same() {
            self.values.truncate(1);
            self.values.shrink_to_fit();
            self.mask = 0;
        } else if self.mask != 0 {
            cycles.turn(&mut self.values);
        }
    }

    /// Gives every row a value of its own.
    #[cold]
    fn spread(&mut self) {
        let value = self.values[0];
        self.values.reserve_exact(self.room.max(self.len + 1) - 1);
        self.values.resize(self.len, value);
        self.mask = usize::MAX;
    }

    fn all_same(&self) -> bool {
        self.values.iter().all(|value| value.same(self.values[0]))
    }
}

impl Column<f32> {
    /// The values of rows side by side, at most a vector, a lane a row.
    #[inline(always)]
    pub(crate) fn lanes<S: Simd>(&self, simd: S, rows: Range<usize>) -> S::f32s {
        match self.uniform() {
            Some(value) => S::f32s::splat(simd, value),
            None => from_side_by_side(simd, &self.values[rows]),
        }
    }

    /// The values of some rows, at most a vector, a lane a row.
    #[inline(always)]
    pub(crate) fn lanes_of<S: Simd>(&self, simd: S, rows: &[u32]) -> S::f32s {
        match self.uniform() {
            Some(value) => S::f32s::splat(simd, value),
            None => S::f32s::from_fn(simd, |lane| rows.get(lane).map_or(0.0, |&row| self.values[row as usize])),
        }
    }
}

impl<T: Value> Index<usize> for Column<T> {
    type Output = T;

    #[inline]
    fn index(&self, row: usize) -> &T {
        debug_assert!(row < self.len, "row {row} of {}", self.len);
        &self.values[row & self.mask]
    }
}

impl<T: Value + PartialEq> PartialEq for Column<T> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl<T: Value> FromIterator<T> for Column<T> {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        let mut column = Self::default();
        values.into_iter().for_each(|value| column.push(value));
        column
    }
}

/// A column in a file: one value where all are the same, whether or not that was known.
#[derive(Serialize, Deserialize)]
struct Saved<T> {
    len: usize,
    values: Vec<T>,
}

impl<T: Value> From<Column<T>> for Saved<T> {
    fn from(mut column: Column<T>) -> Self {
        if column.all_same() {
            column.values.truncate(1);
        }
        Self { len: column.len, values: column.values }
    }
}

impl<T: Value> TryFrom<Saved<T>> for Column<T> {
    type Error = String;

    fn try_from(Saved { len, values }: Saved<T>) -> Result<Self, String> {
        let mask = match values.len() {
            1 if len > 0 => 0,
            count if count == len => usize::MAX,
            count => return Err(format!("a column of {len} rows has {count} values")),
        };
        Ok(Self { mask: if len == 0 { 0 } else { mask }, values, len, room: len })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[derive(Clone, Copy, Debug)]
    enum Change {
        Push(f32),
        Set(usize, f32),
        SetAll(f32),
        Remove(usize),
        Reserve(usize),
        Rotate(usize),
        SaveAndLoad,
    }

    /// Few values, that columns become and stay uniform; two that are equal, but not the same.
    fn value() -> impl Strategy<Value = f32> {
        prop_oneof![6 => Just(0.0f32), 1 => Just(-0.0f32), 2 => Just(1.5f32)]
    }

    fn change() -> impl Strategy<Value = Change> {
        prop_oneof![
            4 => value().prop_map(Change::Push),
            4 => (any::<usize>(), value()).prop_map(|(row, value)| Change::Set(row, value)),
            1 => value().prop_map(Change::SetAll),
            2 => any::<usize>().prop_map(Change::Remove),
            1 => (0usize..9).prop_map(Change::Reserve),
            1 => any::<usize>().prop_map(Change::Rotate),
            1 => Just(Change::SaveAndLoad),
        ]
    }

    fn bits(values: impl Iterator<Item = f32>) -> Vec<u32> {
        values.map(f32::to_bits).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn a_column_holds_what_a_vector_would(changes in prop::collection::vec(change(), 0..40)) {
            let (mut column, mut plain, mut negative) = (Column::default(), Vec::new(), Column::default());
            for change in changes {
                match change {
                    Change::Push(value) => {
                        column.push(value);
                        plain.push(value);
                    }
                    Change::Set(row, value) if !plain.is_empty() => {
                        let row = row % plain.len();
                        column.set(row, value);
                        plain[row] = value;
                    }
                    Change::SetAll(value) => {
                        column.values_mut().fill(value);
                        plain.fill(value);
                    }
                    Change::Remove(row) if !plain.is_empty() => {
                        let row = row % plain.len();
                        column.swap_remove(row);
                        plain.swap_remove(row);
                    }
                    Change::Reserve(rows) => column.reserve(rows),
                    Change::Rotate(by) => {
                        let mut order: Vec<u32> = (0..plain.len() as u32).collect();
                        let by = by % plain.len().max(1);
                        order.rotate_left(by);
                        let mut cycles = Cycles::default();
                        cycles.find(&order);
                        column.permute(&cycles);
                        plain.rotate_left(by);
                        let same = plain.iter().all(|value: &f32| value.same(plain[0]));
                        prop_assert!(column.uniform().is_some() == (same && !plain.is_empty()));
                    }
                    Change::SaveAndLoad => {
                        let bytes = postcard::to_stdvec(&column).unwrap();
                        let fresh: Column<f32> = plain.iter().copied().collect();
                        prop_assert_eq!(&bytes, &postcard::to_stdvec(&fresh).unwrap());
                        column = postcard::from_bytes(&bytes).unwrap();
                    }
                    Change::Set(..) | Change::Remove(_) => {}
                }
                prop_assert_eq!(column.len(), plain.len());
                prop_assert_eq!(bits(column.iter()), bits(plain.iter().copied()));
                prop_assert!((0..plain.len()).all(|row| column[row].same(plain[row])));
                if let Some(value) = column.uniform() {
                    prop_assert!(plain.iter().all(|other| other.same(value)));
                    prop_assert_eq!(column.values().len(), 1);
                } else {
                    prop_assert_eq!(bits(column.values().iter().copied()), bits(plain.iter().copied()));
                }
                negative.map_from(&column, |value: f32| -value);
                prop_assert_eq!(bits(negative.iter()), bits(plain.iter().map(|value| -value)));
                prop_assert_eq!(&column, &plain.iter().copied().collect());
            }
        }
    }

    #[test]
    fn what_is_the_same_takes_no_room() {
        let mut column: Column<f32> = std::iter::repeat_n(0.5, 1000).collect();
        column.reserve(1000);
        column.set(3, 0.5);
        assert!(column.values.capacity() < 10, "{} values", column.values.capacity());
        column.push(0.25);
        assert_eq!(column.values.capacity(), 2000, "as much as was to come, and no more");
    }

    #[test]
    fn a_saved_column_of_the_wrong_length_is_refused() {
        for (len, values) in [(3, vec![1.0f32, 2.0]), (0, vec![1.0]), (2, vec![])] {
            let bytes = postcard::to_stdvec(&Saved { len, values }).unwrap();
            assert!(postcard::from_bytes::<Column<f32>>(&bytes).is_err(), "{len} rows");
        }
    }
}
