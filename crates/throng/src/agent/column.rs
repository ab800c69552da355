//! A property of all agents, stored once while it is the same for all.

use super::{Cycles, GroupId, JourneyId, Rounding, ScriptId};
use crate::motion::{Attitude, Basis, Vehicle};
use crate::simd::from_side_by_side;
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};
use std::ops::{Index, Range};

/// A type that a [`Column`] can hold.
pub trait ColumnValue: Copy {
    /// Whether two values are the same to the bit, so that either can stand for the other.
    fn same(self, other: Self) -> bool;
}

macro_rules! value {
    ($($type:ty: |$value:ident| $bits:expr,)*) => {
        $(impl ColumnValue for $type {
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
    u64: |value| value,
    f32: |value| value.to_bits(),
    f64: |value| value.to_bits(),
    Vec2: |value| [value.x.to_bits(), value.y.to_bits()],
    Rounding: |value| value.0.to_array().map(f32::to_bits),
    GroupId: |value| value,
    JourneyId: |value| value,
    Option<ScriptId>: |value| value,
    Option<Vec3>: |value| value.map(|v| v.to_array().map(f32::to_bits)),
    // a vehicle has no number for which the sign of zero matters
    Option<Vehicle>: |value| value,
    Attitude: |value| {
        let Basis { forward, side, up } = value.basis;
        [forward, side, up, value.acceleration, value.curvature].map(|v| v.to_array().map(f32::to_bits))
    },
}

/// A value for every row. While all values are the same to the bit it holds one value, whatever the number of rows.
/// Reading a row takes no branch in either case.
///
/// ```
/// use throng::agent::Column;
/// let mut radii: Column<f32> = std::iter::repeat_n(0.2, 1000).collect();
/// assert_eq!((radii[500], radii.uniform(), radii.values().len()), (0.2, Some(0.2), 1));
/// radii.set(7, 0.3);
/// assert_eq!((radii[6], radii[7], radii.uniform(), radii.values().len()), (0.2, 0.3, None, 1000));
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "SavedColumn<T>", into = "SavedColumn<T>")]
#[serde(bound(serialize = "T: ColumnValue + Serialize", deserialize = "T: ColumnValue + Deserialize<'de>"))]
pub struct Column<T> {
    /// One value if `mask` is 0, otherwise one for each row.
    values: Vec<T>,
    /// Mask of a row that gives its index into `values`: no bits, or all.
    mask: usize,
    len: usize,
    /// Expected number of rows.
    room: usize,
}

impl<T> Default for Column<T> {
    fn default() -> Self {
        Self { values: Vec::new(), mask: 0, len: 0, room: 0 }
    }
}

impl<T> Column<T> {
    /// Returns the number of rows.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Returns the values that occur: one for all rows, or one for each row. A test of all values, or their maximum,
    /// needs no loop over rows.
    #[inline]
    pub fn values(&self) -> &[T] {
        &self.values
    }
}

impl<T: ColumnValue> Column<T> {
    /// Returns the value of all rows, if it is known to be the same; `None` without rows.
    #[inline]
    pub fn uniform(&self) -> Option<T> {
        if self.mask == 0 { self.values.first().copied() } else { None }
    }

    /// Returns the values of all rows.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = T> + '_ {
        (0..self.len).map(|row| self[row])
    }

    /// Returns the values that occur, mutable: one for all rows, or one for each row.
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// Sets the values to those of another column under `f`, in the memory it has. `f` must map equal values to equal
    /// values.
    pub fn map_from<U: ColumnValue>(&mut self, other: &Column<U>, f: impl FnMut(U) -> T) {
        self.values.clear();
        self.values.extend(other.values.iter().copied().map(f));
        (self.mask, self.len, self.room) = (other.mask, other.len, other.room);
    }

    /// Reserves memory for more rows.
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

    /// Adds rows with any value: the value of all rows, if it is the same.
    pub(crate) fn extend_with_any(&mut self, rows: usize)
    where
        T: Default,
    {
        let value = self.values.first().copied().unwrap_or_default();
        self.len += rows;
        if self.mask != 0 {
            self.values.resize(self.len, value);
        } else if self.values.is_empty() && rows > 0 {
            self.values.push(value);
        }
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

    /// Returns the values of all rows, mutable, one for each row.
    pub(crate) fn rows_mut(&mut self) -> &mut [T] {
        if self.mask == 0 && self.len > 1 {
            self.spread();
        }
        &mut self.values
    }

    /// Exchanges the values of all rows for other values.
    ///
    /// # Panics
    /// If the number of values differs from the number of rows.
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

    /// Removes all rows from this one on.
    pub(crate) fn truncate(&mut self, rows: usize) {
        self.len = self.len.min(rows);
        if self.mask != 0 || self.len == 0 {
            self.values.truncate(self.len);
        }
        if self.len == 0 {
            self.mask = 0;
        }
    }

    /// Moves rows along cycles. Stores the value once if all rows have become the same.
    pub(crate) fn permute(&mut self, cycles: &Cycles) {
        if self.mask != 0 && self.all_same() {
            self.values.truncate(1);
            self.values.shrink_to_fit();
            self.mask = 0;
        } else if self.mask != 0 {
            cycles.turn(&mut self.values);
        }
    }

    /// Stores a separate value for each row.
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
    /// Returns the values of consecutive rows as a SIMD vector, at most as many as its width.
    #[inline(always)]
    pub(crate) fn lanes<S: Simd>(&self, simd: S, rows: Range<usize>) -> S::f32s {
        match self.uniform() {
            Some(value) => S::f32s::splat(simd, value),
            None => from_side_by_side(simd, &self.values[rows]),
        }
    }

    /// Returns the values of some rows as a SIMD vector, at most as many as its width.
    #[inline(always)]
    pub(crate) fn simd_of<S: Simd>(&self, simd: S, rows: &[u32]) -> S::f32s {
        match self.uniform() {
            Some(value) => S::f32s::splat(simd, value),
            None => S::f32s::from_fn(simd, |lane| rows.get(lane).map_or(0.0, |&row| self.values[row as usize])),
        }
    }
}

impl<T: ColumnValue> Index<usize> for Column<T> {
    type Output = T;

    #[inline]
    fn index(&self, row: usize) -> &T {
        debug_assert!(row < self.len, "row {row} of {}", self.len);
        &self.values[row & self.mask]
    }
}

impl<T: ColumnValue + PartialEq> PartialEq for Column<T> {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl<T: ColumnValue> FromIterator<T> for Column<T> {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        let mut column = Self::default();
        values.into_iter().for_each(|value| column.push(value));
        column
    }
}

/// A column in a file: one value if all are the same, whether or not that was known.
#[derive(Serialize, Deserialize)]
struct SavedColumn<T> {
    len: usize,
    values: Vec<T>,
}

impl<T: ColumnValue> From<Column<T>> for SavedColumn<T> {
    fn from(mut column: Column<T>) -> Self {
        if column.all_same() {
            column.values.truncate(1);
        }
        Self { len: column.len, values: column.values }
    }
}

impl<T: ColumnValue> TryFrom<SavedColumn<T>> for Column<T> {
    type Error = String;

    fn try_from(SavedColumn { len, values }: SavedColumn<T>) -> Result<Self, String> {
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
    enum ColumnChange {
        Push(f32),
        Set(usize, f32),
        SetAll(f32),
        Remove(usize),
        Reserve(usize),
        Rotate(usize),
        Truncate(usize),
        SaveAndLoad,
    }

    /// Few different values, so that columns become and stay uniform; two of them are equal, but not the same to the
    /// bit.
    fn value() -> impl Strategy<Value = f32> {
        prop_oneof![6 => Just(0.0f32), 1 => Just(-0.0f32), 2 => Just(1.5f32)]
    }

    fn change() -> impl Strategy<Value = ColumnChange> {
        prop_oneof![
            4 => value().prop_map(ColumnChange::Push),
            4 => (any::<usize>(), value()).prop_map(|(row, value)| ColumnChange::Set(row, value)),
            1 => value().prop_map(ColumnChange::SetAll),
            2 => any::<usize>().prop_map(ColumnChange::Remove),
            1 => (0usize..9).prop_map(ColumnChange::Reserve),
            1 => any::<usize>().prop_map(ColumnChange::Rotate),
            1 => (0usize..20).prop_map(ColumnChange::Truncate),
            1 => Just(ColumnChange::SaveAndLoad),
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
                    ColumnChange::Push(value) => {
                        column.push(value);
                        plain.push(value);
                    }
                    ColumnChange::Set(row, value) if !plain.is_empty() => {
                        let row = row % plain.len();
                        column.set(row, value);
                        plain[row] = value;
                    }
                    ColumnChange::SetAll(value) => {
                        column.values_mut().fill(value);
                        plain.fill(value);
                    }
                    ColumnChange::Remove(row) if !plain.is_empty() => {
                        let row = row % plain.len();
                        column.swap_remove(row);
                        plain.swap_remove(row);
                    }
                    ColumnChange::Reserve(rows) => column.reserve(rows),
                    ColumnChange::Rotate(by) => {
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
                    ColumnChange::Truncate(rows) => {
                        column.truncate(rows);
                        plain.truncate(rows);
                    }
                    ColumnChange::SaveAndLoad => {
                        let bytes = postcard::to_stdvec(&column).unwrap();
                        let fresh: Column<f32> = plain.iter().copied().collect();
                        prop_assert_eq!(&bytes, &postcard::to_stdvec(&fresh).unwrap());
                        column = postcard::from_bytes(&bytes).unwrap();
                    }
                    ColumnChange::Set(..) | ColumnChange::Remove(_) => {}
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
        assert_eq!(column.values.capacity(), 2000, "exactly the reserved number");
    }

    #[test]
    fn a_saved_column_of_the_wrong_length_is_refused() {
        for (len, values) in [(3, vec![1.0f32, 2.0]), (0, vec![1.0]), (2, vec![])] {
            let bytes = postcard::to_stdvec(&SavedColumn { len, values }).unwrap();
            assert!(postcard::from_bytes::<Column<f32>>(&bytes).is_err(), "{len} rows");
        }
    }
}
