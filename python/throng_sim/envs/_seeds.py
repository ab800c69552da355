"""Seeds of episodes."""

from __future__ import annotations

import numpy as np


def episode(given: int | None, generator: np.random.Generator) -> int:
    """Returns the seed of the scene for an episode: that of `reset`, or the next of the generator."""
    return int(generator.integers(1 << 32)) if given is None else given
