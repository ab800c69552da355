//! Runs a stage over all agents: on the threads of the current rayon pool, or on this thread.
//!
//! Work is divided into contiguous ranges of rows. Each range writes its own part of the output and reads only the
//! state at the start of the stage, so the result does not depend on the division.

use std::ops::Range;

/// Least number of rows that a thread takes at a time: a multiple of the SIMD width and of the rows of a word.
const CHUNK: usize = 256;
/// The same for work of half a microsecond a row or more, so that small crowds use several threads.
const COSTLY_CHUNK: usize = 64;
/// Number of parts for each thread, if there are enough rows: idle threads can take parts of busy threads.
#[cfg(feature = "parallel")]
const PARTS: usize = 8;

/// Columns of equal length that are divided at the same rows.
pub trait Parts: Send + Sized {
    /// Returns the number of rows.
    fn rows(&self) -> usize;
    /// Returns the columns before a row, and the columns from that row on.
    fn split(self, row: usize) -> (Self, Self);
}

impl<T: Send> Parts for &mut [T] {
    fn rows(&self) -> usize {
        self.len()
    }

    fn split(self, row: usize) -> (Self, Self) {
        self.split_at_mut(row)
    }
}

/// A list of `stride` values for each row.
pub(crate) struct RowLists<'a, T> {
    pub all: &'a mut [T],
    pub stride: usize,
}

impl<T: Send> Parts for RowLists<'_, T> {
    fn rows(&self) -> usize {
        self.all.len() / self.stride
    }

    fn split(self, row: usize) -> (Self, Self) {
        let (before, after) = self.all.split_at_mut(row * self.stride);
        (Self { all: before, stride: self.stride }, Self { all: after, stride: self.stride })
    }
}

/// A column with one value for each word of 64 rows.
pub(crate) struct Words<'a, T>(pub &'a mut [T]);

/// Rows in a word, one bit for each row.
pub(crate) const WORD: usize = u64::BITS as usize;

impl<T: Send> Parts for Words<'_, T> {
    fn rows(&self) -> usize {
        self.0.len() * WORD
    }

    fn split(self, row: usize) -> (Self, Self) {
        let (before, after) = self.0.split_at_mut(row / WORD);
        (Self(before), Self(after))
    }
}

macro_rules! tuple {
    ($($name:ident: $column:tt),*) => {
        impl<$($name: Parts),*> Parts for ($($name,)*) {
            fn rows(&self) -> usize {
                self.0.rows()
            }

            fn split(self, row: usize) -> (Self, Self) {
                let both = ($(self.$column.split(row),)*);
                (($(both.$column.0,)*), ($(both.$column.1,)*))
            }
        }
    };
}

tuple!(A: 0, B: 1);
tuple!(A: 0, B: 1, C: 2);

/// Calls `work(rows, part)` for ranges of rows that together cover all rows, each with its part of the columns.
pub fn ranges<P: Parts>(all: P, work: impl Fn(Range<usize>, P) + Sync) {
    ranges_with(all, &mut Vec::<()>::new(), |(), rows, part| work(rows, part));
}

/// Calls `work(scratch, rows, part)`: as [`ranges`], with scratch memory that is kept between calls, one for each
/// range.
pub fn ranges_with<P: Parts, S: Default + Send>(
    all: P,
    scratch: &mut Vec<S>,
    work: impl Fn(&mut S, Range<usize>, P) + Sync,
) {
    let busy = all.rows();
    divide_all(all, (busy, CHUNK), scratch, &work);
}

/// As [`ranges_with`], for costly work: threads take fewer rows at a time.
pub(crate) fn costly_ranges_with<P: Parts, S: Default + Send>(
    all: P,
    scratch: &mut Vec<S>,
    work: impl Fn(&mut S, Range<usize>, P) + Sync,
) {
    let busy = all.rows();
    divide_all(all, (busy, COSTLY_CHUNK), scratch, &work);
}

/// As [`ranges_with`], if only `busy` of the rows need work: few busy rows are not divided among threads.
pub(crate) fn ranges_if_busy<P: Parts, S: Default + Send>(
    all: P,
    busy: usize,
    scratch: &mut Vec<S>,
    work: impl Fn(&mut S, Range<usize>, P) + Sync,
) {
    divide_all(all, (busy, CHUNK), scratch, &work);
}

fn divide_all<P: Parts, S: Default + Send>(
    all: P,
    (busy, least): (usize, usize),
    scratch: &mut Vec<S>,
    work: &(impl Fn(&mut S, Range<usize>, P) + Sync),
) {
    let rows = 0..all.rows();
    let chunk = chunk(rows.len(), busy, least);
    let ranges = rows.len().div_ceil(chunk).max(1);
    scratch.resize_with(scratch.len().max(ranges), S::default);
    divide(all, rows, chunk, scratch, work);
}

/// Returns the number of rows in a range: a multiple of `least`, or all rows.
#[cfg_attr(not(feature = "parallel"), expect(unused_variables, reason = "one thread does all"))]
fn chunk(rows: usize, busy: usize, least: usize) -> usize {
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 && busy > least {
        return (rows / (PARTS * rayon::current_num_threads())).next_multiple_of(least).max(least);
    }
    rows.max(1)
}

fn divide<P: Parts, S: Send>(
    all: P,
    rows: Range<usize>,
    chunk: usize,
    scratch: &mut [S],
    work: &(impl Fn(&mut S, Range<usize>, P) + Sync),
) {
    if rows.len() <= chunk {
        return work(&mut scratch[0], rows, all);
    }
    let half = (rows.len() / 2).next_multiple_of(chunk);
    let (middle, (before, after)) = (rows.start + half, all.split(half));
    let (first, others) = scratch.split_at_mut(half / chunk);
    join(
        || divide(before, rows.start..middle, chunk, first, work),
        || divide(after, middle..rows.end, chunk, others, work),
    );
}

fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    rayon::join(a, b);
    #[cfg(not(feature = "parallel"))]
    {
        a();
        b();
    }
}

/// Calls `work(scratch, row, out)` for every row of a column.
pub fn rows<T: Send, S: Default + Send>(all: &mut [T], work: impl Fn(&mut S, usize, &mut T) + Sync) {
    ranges_with(all, &mut Vec::new(), |scratch, rows, part| {
        for (row, out) in rows.zip(part) {
            work(scratch, row, out);
        }
    });
}
