//! Running a stage over all agents: on the threads of the current rayon pool, or on this one.
//!
//! Work is divided into contiguous ranges of rows; each writes its own part of the output and reads only the frozen
//! present, so the result does not depend on the division.

use std::ops::Range;

/// Rows a thread takes at a time, at least: a multiple of the lanes of a vector.
#[cfg(feature = "parallel")]
const CHUNK: usize = 256;
/// Parts that a thread takes at least, if there are rows enough: so that threads that have little to do can help.
#[cfg(feature = "parallel")]
const PARTS: usize = 8;

/// Columns that are divided together.
pub(crate) trait Parts: Send + Sized {
    /// Rows of all of them.
    fn rows(&self) -> usize;
    /// Those before a row, and the others.
    #[cfg_attr(not(feature = "parallel"), allow(dead_code, reason = "one thread does all"))]
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

/// Places of a list a row.
pub(crate) struct Lists<'a, T> {
    pub all: &'a mut [T],
    pub stride: usize,
}

impl<T: Send> Parts for Lists<'_, T> {
    fn rows(&self) -> usize {
        self.all.len() / self.stride
    }

    fn split(self, row: usize) -> (Self, Self) {
        let (before, after) = self.all.split_at_mut(row * self.stride);
        (Self { all: before, stride: self.stride }, Self { all: after, stride: self.stride })
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

/// Calls `work(scratch, rows, part)` for ranges of rows that make up all, each with its part.
pub(crate) fn ranges<P: Parts, S>(
    all: P,
    scratch: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, Range<usize>, P) + Sync,
) {
    let rows = 0..all.rows();
    #[cfg(feature = "parallel")]
    if rayon::current_num_threads() > 1 && rows.len() > CHUNK {
        let chunk = rows.len() / (PARTS * rayon::current_num_threads());
        return divide(all, rows, chunk.next_multiple_of(CHUNK).max(CHUNK), &scratch, &work);
    }
    work(&mut scratch(), rows, all);
}

#[cfg(feature = "parallel")]
fn divide<P: Parts, S>(
    all: P,
    rows: Range<usize>,
    chunk: usize,
    scratch: &(impl Fn() -> S + Sync),
    work: &(impl Fn(&mut S, Range<usize>, P) + Sync),
) {
    if rows.len() <= chunk {
        return work(&mut scratch(), rows, all);
    }
    let half = (rows.len() / 2).next_multiple_of(chunk);
    let (middle, (before, after)) = (rows.start + half, all.split(half));
    rayon::join(
        || divide(before, rows.start..middle, chunk, scratch, work),
        || divide(after, middle..rows.end, chunk, scratch, work),
    );
}

/// Calls `work(scratch, row, out)` for every row of a column.
pub(crate) fn rows<T: Send, S>(
    all: &mut [T],
    scratch: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut T) + Sync,
) {
    ranges(all, scratch, |scratch, rows, part| {
        for (row, out) in rows.zip(part) {
            work(scratch, row, out);
        }
    });
}

/// Calls `work(part, state)` for every part of the rows. `rows`: how many there is work for, which tells whether it is
/// worth dividing.
pub(crate) fn parts<T: Send>(all: &mut [T], rows: usize, work: impl Fn(usize, &mut T) + Sync) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        if rayon::current_num_threads() > 1 && rows > CHUNK {
            all.par_iter_mut().enumerate().for_each(|(part, state)| work(part, state));
            return;
        }
    }
    #[cfg(not(feature = "parallel"))]
    let _ = rows;
    for (part, state) in all.iter_mut().enumerate() {
        work(part, state);
    }
}

/// The same with the `size` elements of `out` that go with each part; of the last there may be fewer.
pub(crate) fn parts_with<T: Send, U: Send>(
    all: &mut [T],
    (out, size): (&mut [U], usize),
    rows: usize,
    work: impl Fn(usize, &mut T, &mut [U]) + Sync,
) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        if rayon::current_num_threads() > 1 && rows > CHUNK {
            let both = all.par_iter_mut().zip(out.par_chunks_mut(size)).enumerate();
            both.for_each(|(part, (state, out))| work(part, state, out));
            return;
        }
    }
    #[cfg(not(feature = "parallel"))]
    let _ = rows;
    for (part, (state, out)) in all.iter_mut().zip(out.chunks_mut(size)).enumerate() {
        work(part, state, out);
    }
}
