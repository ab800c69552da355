"""RVO2, through pyrvo, on the reference works. Told by the program beside it what to do, on standard input.

Arguments: the length of a step and the radius of the agents. Standard input: for each agent its position and preferred
speed, then for each agent the corners of its path, then rings of walls: first the boundary of the walkable area, then
obstacles; two corners are a thin wall.

What is measured is RVO2's step alone. It plans no paths. Without walls the preferred velocities are set once: goals are
so far away that they hardly change. With walls they are set before each step, which is not measured: toward the last
corner that the agent sees. Agents at the end of their path stay there.
"""

import math
import sys
import time
from importlib.metadata import version

from pyrvo import RVOSimulator

WARM_UP = 20
STEP, RADIUS = map(float, sys.argv[1:])


def read():
    """Reads a list of lines of numbers."""
    return [tuple(map(float, sys.stdin.readline().split())) for _ in range(int(sys.stdin.readline()))]


def points(numbers):
    """Returns pairs of numbers."""
    return list(zip(numbers[::2], numbers[1::2]))


def area(ring):
    """Returns twice the area of a ring, positive if it is counterclockwise."""
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))


people = read()
paths = [points(numbers) for numbers in read()]
rings = [points(numbers) for numbers in read()]
# neighbour distance, most neighbours, time horizons for agents and walls, radius, greatest speed
simulator = RVOSimulator(STEP, 5.0, 10, 2.0, 2.0, RADIUS, 2.0)
for index, ring in enumerate(rings):
    # obstacles are counterclockwise, the boundary clockwise
    if len(ring) > 2 and (area(ring) > 0.0) == (index == 0):
        ring.reverse()
    simulator.add_obstacle(ring)
if rings:
    simulator.process_obstacles()
for x, y, _ in people:
    simulator.add_agent((x, y))
corner = [0] * len(people)


def steer():
    """Sets the preferred velocities."""
    for agent, (_, _, speed) in enumerate(people):
        position = simulator.get_agent_position(agent)
        path, at = paths[agent], corner[agent]
        x, y = position.x, position.y
        while at + 1 < len(path) and simulator.query_visibility((x, y), path[at + 1], 0.0):
            at += 1
        corner[agent] = at
        off_x, off_y = path[at][0] - x, path[at][1] - y
        away = math.hypot(off_x, off_y)
        scale = min(speed / away, 1.0 / STEP) if away > 0.0 else 0.0
        simulator.set_agent_pref_velocity(agent, (off_x * scale, off_y * scale))


def steps(count):
    """Makes steps; returns the processor time of RVO2."""
    took = 0.0
    for _ in range(count):
        if rings:
            steer()
        begin = time.process_time()
        simulator.do_step()
        took += time.process_time() - begin
    return took


steer()
steps(WARM_UP)
warm = [
    tuple((v.x, v.y) for v in (simulator.get_agent_position(agent), simulator.get_agent_velocity(agent)))
    for agent in range(len(people))
]
warm_corner = list(corner)
print(f"pyrvo {version('pyrvo')}, step alone", flush=True)
for line in sys.stdin:
    match line.split():
        case ["restart"]:
            for agent, (position, velocity) in enumerate(warm):
                simulator.set_agent_position(agent, position)
                simulator.set_agent_velocity(agent, velocity)
            corner[:] = warm_corner
            print("done", flush=True)
        case ["steps", count]:
            took = steps(int(count))
            print(int(count) * len(people), took, int(count) * STEP, flush=True)
