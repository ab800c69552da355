"""Trains an agent to find its way through a crowd, with NumPy only.

The agent crosses a stream of people. Nothing avoids them for it (its local model is `none`): the guard only stops it. A
small network sees its velocity, its goal and its nearest neighbours, and chooses a velocity. An evolution strategy improves
it: it tries random changes of the weights in pairs, one in each world of a vector environment, and moves the weights along
those that did better (Salimans et al. 2017).

    python examples/train.py

Prints the mean time to the goal, before and after, over seeds that the training has not seen.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import throng_sim as tg
import throng_sim.envs

Array = npt.NDArray[np.float64]

LIMIT = 30.0
"""Seconds for one episode."""
NEIGHBOURS = 5
INPUTS = 4 + 5 * NEIGHBOURS
HIDDEN = 16
PARAMETERS = (INPUTS + 1 + 2) * HIDDEN
SPREAD = 0.1
"""Size of the random changes of weights."""
RATE = 0.3
"""Size of the steps along the better changes."""
UNSEEN = 1_000_000
"""The first seed of the test."""


def street() -> tg.Scene:
    """Returns a scene: one agent crosses a stream of people."""
    scene = tg.Scene(limit=LIMIT)
    scene.group("walker", at=[(-7.0, 0.0)], goal=(7.0, 0.0), model="none")
    scene.group(
        "stream", n=40, area="POLYGON ((-4 0, 4 0, 4 16, -4 16))", gap=0.1, goal={"shift": {"by": [0.0, -40.0]}}, speed=(1.0, 0.2)
    )
    return scene


def environment(worlds: int, threads: int) -> throng_sim.envs.CrowdVectorEnv:
    """Returns the walker of the street in several worlds."""
    return throng_sim.envs.vector(
        street(), worlds, control=0, observe=f"nearest-{NEIGHBOURS}", threads=threads, copy=False
    )


class Policy:
    """Networks with one hidden layer: a row of weights for each world."""

    def __init__(self, weights: Array) -> None:
        inner, bias, outer = np.split(weights, [INPUTS * HIDDEN, (INPUTS + 1) * HIDDEN], axis=1)
        self.inner, self.bias, self.outer = inner.reshape(-1, INPUTS, HIDDEN), bias, outer.reshape(-1, HIDDEN, 2)

    def __call__(self, seen: Array) -> Array:
        """Returns actions, (n, 2), for observations, (n, INPUTS)."""
        hidden = np.tanh((seen[:, None] @ self.inner)[:, 0] + self.bias)
        return np.tanh((hidden[:, None] @ self.outer)[:, 0])


def straight(seen: Array) -> Array:
    """Returns the actions that go straight to the goal."""
    goal = seen[:, 2:4]
    ahead: Array = goal / np.maximum(np.linalg.norm(goal, axis=1, keepdims=True), 1e-6)
    return ahead


def episodes(
    envs: throng_sim.envs.CrowdVectorEnv, policy: Callable[[Array], Array], seeds: list[int]
) -> tuple[Array, Array]:
    """Runs an episode in each world. Returns the sums of rewards, and the seconds to the goal; `LIMIT` if it is missed."""
    seen, _ = envs.reset(seed=seeds)
    total, seconds = np.zeros(envs.num_envs), np.full(envs.num_envs, LIMIT)
    running = np.ones(envs.num_envs, dtype=bool)
    while running.any():
        seen, rewards, arrived, late, infos = envs.step(policy(seen.astype(float)))
        total += rewards * running
        seconds[running & arrived] = infos["time"][running & arrived]
        running &= ~(arrived | late)
    return total, seconds


def train(generations: int, pairs: int, threads: int, seed: int) -> tuple[Array, Array]:
    """Returns the weights of a network before and after the training.

    The two worlds of a pair have the same seed and opposite changes.
    """
    envs, rng = environment(2 * pairs, threads), np.random.default_rng(seed)
    before = 0.3 * rng.standard_normal(PARAMETERS)
    weights, direction = before, np.zeros(PARAMETERS)
    for generation in range(generations):
        change = rng.standard_normal((pairs, PARAMETERS))
        tried = weights + SPREAD * np.concatenate([change, -change])
        seeds = [generation * pairs + pair for pair in range(pairs)]
        total, seconds = episodes(envs, Policy(tried), seeds + seeds)
        rank = total.argsort().argsort() / (len(total) - 1) - 0.5
        direction = 0.8 * direction + 0.2 * (rank[:pairs] - rank[pairs:]) @ change / pairs
        weights = weights + RATE * direction
        if generation % 10 == 0:
            print(f"generation {generation:3}: reward {total.mean():6.2f}, {seconds.mean():5.2f} s to the goal", flush=True)
    return before, weights


def main() -> None:
    """Trains and tests."""
    parser = argparse.ArgumentParser(description="Trains an agent to find its way through a crowd.")
    parser.add_argument("--generations", type=int, default=100)
    parser.add_argument("--pairs", type=int, default=32, help="pairs of worlds in a generation")
    parser.add_argument("--tests", type=int, default=100, help="seeds of the test")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    begin = time.perf_counter()
    before, after = train(given.generations, given.pairs, given.threads, given.seed)
    print(f"trained for {time.perf_counter() - begin:.0f} s")
    envs, seeds = environment(given.tests, given.threads), [UNSEEN + k for k in range(given.tests)]
    policies: dict[str, Callable[[Array], Array]] = {"before": Policy(before[None]), "after": Policy(after[None]), "straight": straight}
    for name, policy in policies.items():
        total, seconds = episodes(envs, policy, seeds)
        print(
            f"{name:8}: reward {total.mean():6.2f}, {seconds.mean():5.2f} s to the goal,"
            f" {np.mean(seconds < LIMIT):4.0%} arrive within {LIMIT:.0f} s"
        )


if __name__ == "__main__":
    main()
