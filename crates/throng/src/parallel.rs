//! Running a stage over all agents: on the threads of the current rayon pool, or on this one.
//!
//! Work is divided into contiguous ranges of rows; each writes its own part of the output and reads only the frozen
//! present, so the result does not depend on the division.

/// Rows a thread takes at a time.
#[cfg(feature = "parallel")]
const CHUNK: usize = 128;

/// Calls `work(scratch, row, out)` for every row, where `out` is the row's `stride` elements of `all`.
pub(crate) fn rows<T: Send, S>(
    all: &mut [T],
    stride: usize,
    scratch: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize, &mut [T]) + Sync,
) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        if rayon::current_num_threads() > 1 && all.len() > CHUNK * stride {
            all.par_chunks_mut(CHUNK * stride).enumerate().for_each_init(&scratch, |scratch, (chunk, part)| {
                for (at, out) in part.chunks_mut(stride).enumerate() {
                    work(scratch, chunk * CHUNK + at, out);
                }
            });
            return;
        }
    }
    let mut scratch = scratch();
    for (row, out) in all.chunks_mut(stride).enumerate() {
        work(&mut scratch, row, out);
    }
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
