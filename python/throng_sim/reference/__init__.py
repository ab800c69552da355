"""Readable NumPy versions of the models of the papers, to compare yours with.

Local models are functions of a `View`: `scene.build(model=throng_sim.reference.orca)`. The rules and behaviours are
pure functions of arrays.

>>> import throng_sim as tg
>>> from throng_sim import reference
>>> world = tg.Scene("circle").build(model=reference.orca)
>>> world.step(5)
>>> reference.seek([[0.0, 0.0]], [5.0, 0.0], 1.3)
array([[1.3, 0. ]])
"""

from ._boids import alignment, allocated, boids, cohesion, flocking, separation
from ._cones import in_cone, in_truncated_cone, legs, time_to_collision, time_to_wall
from ._curl_noise import curl, curl_noise, potential, ramp
from ._orca import half_plane, linear_program, orca, wall_half_plane
from ._rbf import rbf, thin_plate, wendland
from ._steering import (
    arrive,
    evade,
    flee,
    follow_flow,
    follow_path,
    nearest_on_path,
    point_on_path,
    predicted,
    pursue,
    seek,
    steered,
    wander,
)
from ._velocity_obstacles import candidates, hrvo, rvo, rvo_penalty, vo

__all__ = [
    "alignment",
    "allocated",
    "arrive",
    "boids",
    "candidates",
    "cohesion",
    "curl",
    "curl_noise",
    "evade",
    "flee",
    "flocking",
    "follow_flow",
    "follow_path",
    "half_plane",
    "hrvo",
    "in_cone",
    "in_truncated_cone",
    "legs",
    "linear_program",
    "nearest_on_path",
    "orca",
    "point_on_path",
    "potential",
    "predicted",
    "pursue",
    "ramp",
    "rbf",
    "rvo",
    "rvo_penalty",
    "seek",
    "separation",
    "steered",
    "thin_plate",
    "time_to_collision",
    "time_to_wall",
    "vo",
    "wall_half_plane",
    "wander",
    "wendland",
]
