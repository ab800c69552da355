"""Runs the labs' four scenes and rings of many sizes with RVO2, and with throng beside it; prints Markdown tables.

RVO2 is the ORCA library of ORCA's authors. It is driven through the Python package `pyrvo`, which contains it and
brings numpy along. How to set it up, what is measured and what came out: docs/peers.md. Examples:

    python docs/peers/rvo2_lab_scenes.py --throng target/release/throng
    python docs/peers/rvo2_lab_scenes.py --throng target/release/throng --only-throng
    python docs/peers/rvo2_lab_scenes.py circle --settings 2 2.5 3 --approach slow
    python docs/peers/rvo2_lab_scenes.py --rings --seeds 1 --throng target/release/throng

Scenes are read from scenes/*.toml (Python 3.11 or later); the script knows only what those four use. The preferred
velocity is, as in RVO2's examples, towards the goal (or towards the next corner of the shortest way, see `--ways`)
plus a random vector. An agent has arrived once it was within the goal's tolerance; it still wants to be at its goal
afterwards. A scene ends when all have arrived.
"""

import argparse
import itertools
import json
import math
import os
import statistics
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import NamedTuple

import numpy as np

os.environ.setdefault("OMP_NUM_THREADS", "1")  # RVO2's threads: the scenes are too small for more
ROOT = Path(__file__).resolve().parents[2]
LABS = ["columns", "circle", "box", "pillars"]
RINGS = [2, 3, 4, 6, 8, 12, 16, 24, 36, 60]  # people on the ring of scenes/circle.toml
STEPS = {"1/60": 1 / 60, "1/25": 1 / 25, "1/10": 1 / 10, "1/4": 1 / 4}  # seconds
HORIZONS = [1, 2, 5]  # seconds
CIRCLE_CORNERS = 16
ROADMAP_MARGIN = 0.05  # metres between a body at a corner of the roadmap and the obstacle
ROADMAP_CLEARANCE = 0.95  # of the radius: lets agents see along a wall that they touch


class Outcome(NamedTuple):
    """What a run showed. Separations are the least ones of the run; below 1 there was an overlap."""

    end: float  # seconds, of the last arrival
    missing: int  # agents that had not arrived at the limit
    separation: float  # of two centres, over the sum of the radii
    wall: float  # of a centre and an obstacle, over the radius; infinite without obstacles


# Scenes ---------------------------------------------------------------------------------------------------------------


class Scene:
    """Who is where, where they go, and what is in the way. Metres, seconds."""

    def __init__(self, name, count=None, step=None):
        """Reads a scene file. `count` replaces the number of people of each group, `step` the time step."""
        with open(ROOT / "scenes" / f"{name}.toml", "rb") as file:
            data = tomllib.load(file)
        self.step = step or data["time"]["step"]
        self.obstacles = [outline(obstacle["shape"]) for obstacle in data.get("obstacle", [])]
        columns = []
        for group in data["group"]:
            speed, radius = group["speed"], group["body"]["radius"]
            for start in places(group["place"], count or group["count"]):
                goal, tolerance = goal_of(group["goal"], start)
                columns.append((start, goal, tolerance, radius, speed["preferred"], speed["max"]))
        self.start, self.goal, self.tolerance, self.radius, self.preferred, self.fastest = map(np.array, zip(*columns))


def outline(shape):
    """Corners of an obstacle, counter-clockwise. The corners of a circle's polygon lie on the circle."""
    (kind, sizes), = shape.items()
    if kind == "circle":
        turns = 2 * math.pi * np.arange(CIRCLE_CORNERS) / CIRCLE_CORNERS
        return np.array(sizes["center"]) + sizes["radius"] * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    if kind == "rectangle":
        turn = math.radians(sizes.get("rotation", 0.0))
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.array(sizes["size"]) / 2
        rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
        return corners @ rotation.T + np.array(sizes["center"])
    raise SystemExit(f"this script does not know shape.{kind}")


def places(place, count):
    """Where the agents of a group start."""
    (kind, where), = place.items()
    if kind == "line":
        return np.linspace(where["from"], where["to"], count)
    if kind == "ring":
        turns = 2 * math.pi * np.arange(count) / count
        return where["radius"] * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    raise SystemExit(f"this script does not know place.{kind}")


def goal_of(goal, start):
    """Where an agent goes, and the distance that counts as there."""
    (kind, where), = goal.items()
    if kind == "shift":
        return start + np.array(where["by"]), where["tolerance"]
    if kind == "opposite":
        return -start, where["tolerance"]
    raise SystemExit(f"this script does not know goal.{kind}")


# Ways round obstacles -------------------------------------------------------------------------------------------------


class Roadmap:
    """A visibility graph of the corners round the obstacles, used as RVO2's example Roadmap.cc uses its own.

    An agent heads for the visible corner that is on the shortest way to its goal. What is visible is what RVO2 says.
    """

    def __init__(self, simulator, scene):
        self.simulator = simulator
        self.clearance = ROADMAP_CLEARANCE * scene.radius.max()
        self.goals = scene.goal
        margin = scene.radius.max() + ROADMAP_MARGIN
        self.nodes = nodes = np.concatenate([grown(corners, margin) for corners in scene.obstacles])
        ways = np.full((len(nodes), len(nodes)), np.inf)
        for a in range(len(nodes)):
            ways[a, a] = 0.0
            for b in range(a):
                if self.sees(nodes[a], nodes[b]):
                    ways[a, b] = ways[b, a] = math.dist(nodes[a], nodes[b])
        for k in range(len(nodes)):  # Floyd and Warshall
            ways = np.minimum(ways, ways[:, k, None] + ways[None, k, :])
        self.to_goal = []
        for goal in scene.goal:
            last = [math.dist(node, goal) if self.sees(node, goal) else np.inf for node in nodes]
            self.to_goal.append((ways + np.array(last)).min(axis=1))

    def sees(self, a, b, share=1.0):
        return self.simulator.query_visibility(tuple(a), tuple(b), share * self.clearance)

    def next(self, agent, position):
        """The point to head for, and whether it is the goal."""
        goal = self.goals[agent]
        to_node = np.linalg.norm(self.nodes - position, axis=1)
        way = np.where(to_node < ROADMAP_MARGIN, np.inf, to_node + self.to_goal[agent])
        order = np.argsort(way)
        for share in (1.0, 0.5, 0.0):  # an agent pressed against a wall sees nothing with its full width
            if self.sees(position, goal, share):
                return goal, True
            for node in order:
                if math.isfinite(way[node]) and self.sees(position, self.nodes[node], share):
                    return self.nodes[node], False
        return goal, True


def grown(corners, by):
    """The corners of a convex polygon (counter-clockwise) whose edges were moved out."""
    before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)

    def normal(edge):
        return np.stack([edge[:, 1], -edge[:, 0]], axis=1) / np.linalg.norm(edge, axis=1, keepdims=True)

    a, b = normal(corners - before), normal(after - corners)
    return corners + by * (a + b) / (1.0 + (a * b).sum(axis=1, keepdims=True))


# A run ----------------------------------------------------------------------------------------------------------------


def run_rvo2(scene, seed, horizon, wall_horizon, ways, arguments):
    """Runs a scene with RVO2; horizons in seconds. Returns the outcome."""
    import pyrvo  # here, so that --only-throng does without

    dice = np.random.default_rng(seed)
    simulator = pyrvo.RVOSimulator()
    simulator.set_time_step(scene.step)
    for start, radius, fastest in zip(scene.start, scene.radius, scene.fastest):
        simulator.add_agent(tuple(start), arguments.neighbour_distance, arguments.neighbours, horizon, wall_horizon,
                            radius, fastest)
    for corners in scene.obstacles:
        simulator.add_obstacle([tuple(corner) for corner in corners])
    simulator.process_obstacles()
    roadmap = Roadmap(simulator, scene) if ways == "corners" else None

    agents = range(len(scene.start))
    position, target, at_goal = scene.start, scene.goal, np.full(len(agents), True)
    arrived = np.full(len(agents), False)
    separation, wall = math.inf, math.inf
    for step in range(1, math.floor(arguments.limit / scene.step + 1e-9) + 1):
        if roadmap:
            target, at_goal = map(np.array, zip(*(roadmap.next(k, position[k]) for k in agents)))
        wish = preferred(scene, position, target, at_goal, arguments.approach)
        turn, size = 2 * math.pi * dice.random(len(agents)), arguments.perturbation * dice.random(len(agents))
        wish += (size * np.array([np.cos(turn), np.sin(turn)])).T
        for k, velocity in enumerate(wish.tolist()):
            simulator.set_agent_pref_velocity(k, velocity)
        simulator.do_step()
        moved = np.array([simulator.get_agent_position(k).to_tuple() for k in agents])
        separation = min(separation, least_separation(position, moved, scene.radius))
        wall = min(wall, least_wall_separation(moved, scene))
        position = moved
        arrived |= np.linalg.norm(position - scene.goal, axis=1) <= scene.tolerance
        if arrived.all():
            break
    return Outcome(step * scene.step, int((~arrived).sum()), separation, wall)


def preferred(scene, position, target, at_goal, approach):
    """Straight to the target at the preferred speed; at the goal not past it, or slower as in RVO2's examples."""
    offset = target - position
    distance = np.linalg.norm(offset, axis=1)
    last = distance / scene.step if approach == "full" else distance
    speed = np.where(at_goal, np.minimum(scene.preferred, last), scene.preferred)
    return offset * (speed / np.maximum(distance, 1e-9))[:, None]


def least_separation(before, after, radius):
    """The least distance of two centres over the sum of their radii while all move straight from before to after."""
    a, b = np.triu_indices(len(before), 1)
    offset = before[b] - before[a]
    change = (after[b] - after[a]) - offset
    when = np.clip(-(offset * change).sum(axis=1) / np.maximum((change**2).sum(axis=1), 1e-12), 0.0, 1.0)
    nearest = np.linalg.norm(offset + when[:, None] * change, axis=1)
    return (nearest / (radius[a] + radius[b])).min()


def least_wall_separation(position, scene):
    """The least distance of a centre to an obstacle's outline over the radius; 0 inside."""
    least = math.inf
    for corners in scene.obstacles:
        edge = np.roll(corners, -1, axis=0) - corners
        offset = position[:, None, :] - corners[None]
        along = np.clip((offset * edge).sum(axis=2) / (edge**2).sum(axis=1), 0.0, 1.0)
        distance = np.linalg.norm(offset - along[..., None] * edge, axis=2).min(axis=1)
        inside = (edge[:, 0] * offset[..., 1] - edge[:, 1] * offset[..., 0] > 0).all(axis=1)
        least = min(least, (np.where(inside, 0.0, distance) / scene.radius).min())
    return least


def run_throng(name, seed, arguments, **changes):
    """Runs a scene file with throng, as it stands but for the changes. Returns the outcome."""
    command = [arguments.throng, "run", str(ROOT / "scenes" / f"{name}.toml"), "--no-files", "--no-expect", "--quiet",
               "--json", "--seed", str(seed), "--limit", str(arguments.limit)]
    command += [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run(command, capture_output=True, text=True)
    if not done.stdout:
        raise SystemExit(done.stderr)
    found = json.loads(done.stdout)
    least = [math.inf if found[key] is None else found[key] for key in ("least_separation", "least_wall_separation")]
    return Outcome(found["time"], found["agents"] - found["arrived"], *least)


# Tables ---------------------------------------------------------------------------------------------------------------


def spread(values, digits):
    """Median and range; one value where all are the same, a dash where there is none."""
    if not values or math.isinf(max(values)):
        return "–"
    low, middle, high = (f"{v:.{digits}f}" for v in (min(values), statistics.median(values), max(values)))
    return middle if low == high else f"{middle} ({low} to {high})"


def scene_table(arguments):
    """A row for each scene and way to run it, over all seeds."""
    print("| scene | who | all arrive, seeds | last arrival, s | not arrived | least separation | to walls |")
    print("|---|---|---|---|---|---|---|")

    def row(scene, who, run):
        runs = [run(seed) for seed in range(1, arguments.seeds + 1)]
        ends = [found.end for found in runs if not found.missing]
        cells = [scene, who, f"{len(ends)} of {len(runs)}", spread(ends, 2), spread([r.missing for r in runs], 0),
                 spread([r.separation for r in runs], 3), spread([r.wall for r in runs], 3)]
        print(f"| {' | '.join(cells)} |", flush=True)

    for name in arguments.scenes:
        scene, rows = Scene(name), {}
        for horizon, wall_horizon in [] if arguments.only_throng else arguments.settings:
            if not scene.obstacles:
                rows[f"RVO2, {horizon:g} s"] = (horizon, wall_horizon, "straight")
                continue
            for ways in ["straight", "corners"] if arguments.ways == "both" else [arguments.ways]:
                rows[f"RVO2, {horizon:g} s, walls {wall_horizon:g} s, {ways}"] = (horizon, wall_horizon, ways)
        for who, how in rows.items():
            row(name, who, lambda seed: run_rvo2(scene, seed, *how, arguments))
        if arguments.throng:
            row(name, "throng", lambda seed: run_throng(name, seed, arguments))


def ring_table(arguments):
    """Rings of all sizes with all steps and horizons, summed up by each of the three."""
    runners = {}
    if not arguments.only_throng:
        runners["RVO2"] = lambda seed, count, step, horizon: run_rvo2(
            Scene("circle", count, step), seed, horizon, horizon, "straight", arguments)
    if arguments.throng:
        runners["throng"] = lambda seed, count, step, horizon: run_throng("circle", seed, arguments, **{
            "count": count, "time.step": step, "avoid.orca.time_horizon": horizon})
    sums = {}  # label of a row -> program -> outcomes
    for count, step, horizon in itertools.product(RINGS, STEPS, HORIZONS):
        for who, run in runners.items():
            found = [run(seed, count, STEPS[step], horizon) for seed in range(1, arguments.seeds + 1)]
            for label in (f"{count} people", f"step {step} s", f"horizon {horizon} s", "all"):
                sums.setdefault(label, {}).setdefault(who, []).extend(found)

    print("| runs | " + " | ".join(f"{who}: all arrive | longest, s | least separation" for who in runners) + " |")
    print("|---|" + "---|---|---|" * len(runners))
    labels = [f"{n} people" for n in RINGS] + [f"step {t} s" for t in STEPS] + [f"horizon {h} s" for h in HORIZONS]
    for label in labels + ["all"]:
        cells = [label]
        for found in sums[label].values():
            ends, least = [run.end for run in found if not run.missing], min(run.separation for run in found)
            cells += [f"{len(ends)} of {len(found)}", f"{max(ends):.1f}" if ends else "–", f"{least:.3f}"]
        print(f"| {' | '.join(cells)} |")


def horizons(text):
    """Reads `2/0.7`, the horizon of others and that of walls, or `2`, the same for both. Seconds."""
    horizon, _, wall_horizon = text.partition("/")
    return float(horizon), float(wall_horizon or horizon)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    add = parser.add_argument
    add("scenes", nargs="*", default=LABS, help=f"which of {', '.join(LABS)} (default: all)")
    add("--rings", action="store_true", help="instead of these: rings of 2 to 60 people, steps of 1/60 to 1/4 s, "
        "horizons of 1 to 5 s (the same for RVO2 and throng)")
    add("--seeds", type=int, default=11, metavar="N", help="how many seeds, from 1 (default: %(default)s)")
    add("--limit", type=float, default=120.0, metavar="SECONDS", help="when a run ends (default: %(default)s)")
    add("--throng", metavar="PROGRAM", help="runs this throng too")
    add("--only-throng", action="store_true", help="leaves RVO2 out; needs --throng, not pyrvo")
    add("--settings", nargs="+", type=horizons, default=[(2, 0.7), (2, 2), (5, 5)], metavar="S/W",
        help="RVO2: time horizons in seconds, for others and for walls (default: 2/0.7 2/2 5/5)")
    add("--ways", choices=["straight", "corners", "both"], default="both", help="RVO2, where there are obstacles: head "
        "straight for the goal, or for the next corner of the shortest way (default: %(default)s)")
    add("--approach", choices=["full", "slow"], default="full", help="RVO2: full speed up to the goal, or slower once "
        "it is less than 1 s away, as in RVO2's examples (default: %(default)s)")
    add("--perturbation", type=float, default=1e-4, metavar="SPEED",
        help="RVO2: greatest length of the random vector, m/s (default: %(default)s, as in RVO2's examples)")
    add("--neighbours", type=int, default=10, metavar="N", help="RVO2: at most so many (default: %(default)s)")
    add("--neighbour-distance", type=float, default=5.0, metavar="METRES", help="RVO2 (default: %(default)s)")
    arguments = parser.parse_args()
    if arguments.only_throng and not arguments.throng:
        parser.error("--only-throng needs --throng")
    if unknown := set(arguments.scenes) - set(LABS):
        parser.error(f"not one of the labs' scenes: {', '.join(sorted(unknown))}")
    (ring_table if arguments.rings else scene_table)(arguments)


if __name__ == "__main__":
    sys.exit(main())
