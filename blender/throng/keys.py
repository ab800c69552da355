"""Which frames a curve needs, where Blender puts a line through its keys."""

import numpy as np

BLOCK = 8
"""A stretch of this many frames has 1, 2, 4 or 8 keys."""


def needed(values: np.ndarray, tolerance: np.ndarray) -> np.ndarray:
    """Returns which frames keep their key: (frames, curves).

    `values` are (frames, curves, components), `tolerance` the greatest distance of a curve from its values, (curves,). A
    curve that stays within its tolerance has one key.
    """
    frames, curves, _ = values.shape
    keep = np.ones((frames, curves), bool)
    blocks = (frames - 1) // BLOCK
    if blocks:
        # a view of each stretch with both of its ends
        stretch = np.stack([values[k : k + blocks * BLOCK : BLOCK] for k in range(BLOCK + 1)], axis=1)
        found = np.zeros((blocks, curves), bool)
        for stride in (BLOCK, BLOCK // 2, BLOCK // 4):
            fits = ~found & (_error(stretch, stride) <= tolerance)
            found |= fits
            for k in range(BLOCK):
                if k % stride:
                    keep[k : blocks * BLOCK : BLOCK][fits] = False
    still = np.linalg.norm(values - values[:1], axis=2).max(axis=0) <= tolerance
    keep[1:, still] = False
    return keep


def _error(stretch: np.ndarray, stride: int) -> np.ndarray:
    """Returns the greatest distance of values from lines through every `stride`th one: (blocks, curves)."""
    worst = np.zeros(stretch.shape[:1] + stretch.shape[2:3])
    for first in range(0, BLOCK, stride):
        start, end = stretch[:, first], stretch[:, first + stride]
        for k in range(1, stride):
            line = start + (end - start) * (k / stride)
            worst = np.maximum(worst, np.linalg.norm(stretch[:, first + k] - line, axis=2))
    return worst
