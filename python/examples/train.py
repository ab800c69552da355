"""Trains an agent to find its way around a wall and through a crowd, with NumPy only.

The agent walks to a goal behind a wall. People cross its way. Its local model is `none`: only the guard keeps it off
the people and the wall. An agent that goes straight to the goal ends at the wall. A small network observes the velocity
of the agent, its goal, the three nearest people, and the walls along eight rays, and chooses a velocity. An evolution
strategy improves the network: it tries pairs of opposite random changes of the weights, each in its own world, and
moves the weights towards the changes with the higher rewards (Salimans et al. 2017, arXiv:1703.03864).

    python examples/train.py

Prints the mean time to the goal before and after, over seeds that the training has not seen.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterable

import numpy as np
import numpy.typing as npt
import throng_sim as tg
from throng_sim.envs import CrowdVectorEnv, vector

Array = npt.NDArray[np.float64]

LIMIT = 15.0
"""Seconds of an episode."""
OBSERVE = "nearest-3+walls-8"
INPUTS = 4 + 5 * 3 + 8
HIDDEN = 8
PARAMETERS = (INPUTS + 1 + 2) * HIDDEN
SPREAD = 0.2
"""Size of the random changes of weights."""
RATE = 4.0
"""Size of the steps towards better changes."""
UNSEEN = 1_000_000
"""The first seed of the test."""


def yard() -> tg.Scene:
    """Returns the scene: a yard of 16 by 10 m with a wall in its middle, a walker, and people that cross."""
    outline = [[-8.0, -5.0], [8.0, -5.0], [8.0, 5.0], [-8.0, 5.0]]
    wall = [[-0.3, -1.8], [-0.3, 1.8], [0.3, 1.8], [0.3, -1.8]]
    scene = tg.Scene(walkable={"type": "Polygon", "coordinates": [outline, wall]}, limit=LIMIT)
    scene["time.sub_steps"] = 1  # fast, and fine enough for people
    left = {"rectangle": {"center": [-6.0, 0.0], "size": [1.0, 7.0]}}
    goal = {"point": {"at": [6.0, 0.0], "tolerance": 1.0}}
    scene.group("walker", n=1, place=left, goal=goal, model="none", look_ahead=False, keep_right=0)
    for name, side in [("up", -1.0), ("down", 1.0)]:
        place = {"rectangle": {"center": [0.0, 3.4 * side], "size": [10.0, 2.5], "gap": 0.1}}
        scene.group(name, n=6, place=place, goal={"shift": {"by": [0.0, -6.8 * side]}}, preset="animation")
    return scene


def environment(worlds: int, threads: int) -> CrowdVectorEnv:
    """Returns the walker of the yard in several worlds."""
    return vector(yard(), worlds, control=0, observe=OBSERVE, sight=8.0, threads=threads, copy=False)


class Policy:
    """Networks with one hidden layer: a row of weights for each world, or one row for all."""

    def __init__(self, weights: Array, scale: Array) -> None:
        inner, bias, outer = np.split(weights, [INPUTS * HIDDEN, (INPUTS + 1) * HIDDEN], axis=1)
        self.inner, self.bias, self.outer = inner.reshape(-1, INPUTS, HIDDEN), bias, outer.reshape(-1, HIDDEN, 2)
        self.scale = scale

    def __call__(self, seen: Array) -> Array:
        """Returns actions, (n, 2), for observations, (n, INPUTS)."""
        hidden = np.tanh(((seen / self.scale)[:, None] @ self.inner)[:, 0] + self.bias)
        return np.tanh((hidden[:, None] @ self.outer)[:, 0])


def straight(seen: Array) -> Array:
    """Returns the actions that go straight to the goal."""
    goal = seen[:, 2:4]
    ahead: Array = goal / np.maximum(np.linalg.norm(goal, axis=1, keepdims=True), 1e-6)
    return ahead


def episodes(envs: CrowdVectorEnv, policy: Callable[[Array], Array], seeds: Iterable[int]) -> tuple[Array, Array]:
    """Runs an episode in each world. Returns the sums of rewards, and the seconds to the goal, at most `LIMIT`."""
    seen, _ = envs.reset(seed=list(seeds))
    total, seconds = np.zeros(envs.num_envs), np.full(envs.num_envs, LIMIT)
    running = np.ones(envs.num_envs, dtype=bool)
    while running.any():
        seen, rewards, arrived, late, infos = envs.step(policy(seen.astype(float)))
        total += rewards * running
        seconds[running & arrived] = infos["time"][running & arrived]
        running &= ~(arrived | late)
    return total, seconds


def train(envs: CrowdVectorEnv, weights: Array, scale: Array, generations: int, rng: np.random.Generator) -> Array:
    """Returns the weights after the training. Two opposite changes are tried with the same seed."""
    pairs, direction = envs.num_envs // 2, np.zeros(PARAMETERS)
    for generation in range(generations):
        change = rng.standard_normal((pairs, PARAMETERS))
        tried = weights + SPREAD * np.concatenate([change, -change])
        seeds = [generation * pairs + pair for pair in range(pairs)]
        total, seconds = episodes(envs, Policy(tried, scale), seeds + seeds)
        rank = total.argsort().argsort() / (len(total) - 1) - 0.5
        direction = 0.8 * direction + 0.2 * (rank[:pairs] - rank[pairs:]) @ change / pairs
        weights = weights + RATE * SPREAD * direction
        if generation % 10 == 9:
            print(f"generation {generation + 1:3}: {total.mean():6.2f} reward, {seconds.mean():5.2f} s", flush=True)
    return weights


def main() -> None:
    """Trains and tests."""
    parser = argparse.ArgumentParser(description="Trains an agent to find its way around a wall and through a crowd.")
    parser.add_argument("--generations", type=int, default=60)
    parser.add_argument("--pairs", type=int, default=32, help="pairs of worlds in a generation")
    parser.add_argument("--tests", type=int, default=100, help="seeds of the test")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()

    begin, rng = time.perf_counter(), np.random.default_rng(given.seed)
    envs = environment(2 * given.pairs, given.threads)
    scale = envs.single_observation_space.high.astype(float)  # type: ignore[attr-defined]
    before = 0.3 * rng.standard_normal(PARAMETERS)
    after = train(envs, before, scale, given.generations, rng)
    print(f"trained for {time.perf_counter() - begin:.0f} s")

    test, seeds = environment(given.tests, given.threads), range(UNSEEN, UNSEEN + given.tests)
    policies: dict[str, Callable[[Array], Array]] = {
        "before": Policy(before[None], scale),
        "after": Policy(after[None], scale),
        "straight": straight,
    }
    for name, policy in policies.items():
        _, seconds = episodes(test, policy, seeds)
        print(f"{name:8}: {seconds.mean():5.2f} s to the goal, {np.mean(seconds < LIMIT):4.0%} arrive in {LIMIT:.0f} s")


if __name__ == "__main__":
    main()
