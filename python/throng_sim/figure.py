"""The bodies of people: 19 joints, skeletons and meshes, as arrays.

`Trajectories.poses` moves them. [docs/characters.md](../docs/characters.md) describes skeleton and body. At rest a person
faces along x, with y to the left and z up, and no joint is turned.

>>> from throng_sim import figure
>>> figure.JOINTS[0], figure.PARENTS[0], len(figure.JOINTS)
('Hips', -1, 19)
>>> figure.mesh("woman", "blocks").positions.shape
(162, 3)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _throng

__all__ = ["BUILDS", "JOINTS", "LEVELS", "PARENTS", "REGIONS", "Mesh", "colors", "mesh", "skeleton", "worn"]

JOINTS, PARENTS = _throng.joints()
"""The names of the joints, those of Mixamo's rigs, and the number of the parent of each: -1 for the hips."""

BUILDS = _throng.builds()
"""The names of the builds."""

LEVELS = ["fine", "medium", "coarse", "blocks"]
"""The levels of detail: bodies of 1104, 704, 352 and 128 vertices, and their clothes."""

REGIONS = _throng.regions()
"""The regions of a body, each with one colour: from `skirt` on, only some looks wear them."""


@dataclass(frozen=True)
class Mesh:
    """A closed body for a height of 1 m, in the pose at rest."""

    positions: npt.NDArray[np.float32]
    """Positions of the vertices: (n, 3)."""
    normals: npt.NDArray[np.float32]
    """Unit normals, outward: (n, 3)."""
    joints: npt.NDArray[np.uint8]
    """The joints that move each vertex: (n, 4), of which at most two have a weight."""
    weights: npt.NDArray[np.float32]
    """The weights of these joints, (n, 4), with the sum 1."""
    triangles: npt.NDArray[np.uint32]
    """Vertices of the triangles, counter-clockwise from outside."""
    regions: npt.NDArray[np.uint8]
    """The region of each vertex: an index into `REGIONS`."""

    def triangles_of(self, look: int) -> npt.NDArray[np.uint32]:
        """Returns the triangles of what a look wears, which are closed surfaces."""
        return self.triangles[np.isin(self.regions[self.triangles], worn(look)).all(axis=1)]


def skeleton(build: str) -> npt.NDArray[np.float64]:
    """Returns the offset of each joint from its parent at rest, for a height of 1 m; of the hips, from the ground."""
    return _throng.skeleton(build)


def mesh(build: str, level: str = "fine") -> Mesh:
    """Returns the body of a build at a level of detail. All looks share its vertices; `Mesh.triangles_of` is what one wears."""
    return Mesh(**_throng.mesh(build, level))


def colors(look: int) -> npt.NDArray[np.uint8]:
    """Returns the colours of a look, 0 to 15: a row for each region, sRGB from 0 to 255; black for what it does not wear."""
    return _throng.look_colors(look)


def worn(look: int) -> list[int]:
    """Returns the regions that a look, 0 to 15, wears: indices into `REGIONS`."""
    return _throng.look_worn(look)
