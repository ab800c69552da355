//! A target that breaks every limit, for the tests of the driver. It is not among [`TARGETS`](super::TARGETS).

use super::{Target, plain};

/// Breaks the limit that its input names.
pub(super) const FAULTY: Target =
    plain("faulty", "faulty", "txt", "a target that breaks every limit", |bytes| match bytes {
        b"refuse" => Err("refused on request".into()),
        b"ramble" => Err("words ".repeat(1000)),
        b"panic" => panic!("on purpose"),
        b"abort" => std::process::abort(),
        b"memory" => Err(format!("{} bytes", vec![1u8; 4 << 30].len())),
        b"stack" => Err(format!("{} deep", deep(1))),
        b"time" => loop {
            std::hint::spin_loop();
        },
        _ => Ok(()),
    });

/// Recurses without end.
fn deep(depth: u64) -> u64 {
    let here = std::hint::black_box([depth; 64]);
    if depth == 0 { 0 } else { deep(depth + 1) + here[(depth % 64) as usize] }
}
