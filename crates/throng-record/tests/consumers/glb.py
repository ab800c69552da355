"""pygltflib and trimesh read what throng wrote, and its animation is as glTF says: python glb.py RUN.glb RUN.csv (of the same run)."""
import bisect
import csv
import math
import struct
import sys

import pygltflib
import trimesh

file = pygltflib.GLTF2().load(sys.argv[1])
rows = list(csv.DictReader(open(sys.argv[2], newline="")))
blob = file.binary_blob()
assert file.asset.version == "2.0" and len(file.buffers) == 1 and len(blob) >= file.buffers[0].byteLength


def numbers(at):
    """What an accessor reads, decoded as the specification says."""
    accessor = file.accessors[at]
    view = file.bufferViews[accessor.bufferView]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor.type]
    kind, size = {5126: ("f", 4), 5122: ("h", 2), 5125: ("I", 4)}[accessor.componentType]
    start = (view.byteOffset or 0) + (accessor.byteOffset or 0)
    assert start % size == 0 and (accessor.byteOffset or 0) + accessor.count * width * size <= view.byteLength
    values = struct.unpack_from(f"<{accessor.count * width}{kind}", blob, start)
    if accessor.normalized:
        values = [max(value / 32767, -1.0) for value in values]
    values = [tuple(values[k:k + width]) for k in range(0, len(values), width)]
    if accessor.min:
        for a in range(width):
            low, high = min(value[a] for value in values), max(value[a] for value in values)
            assert abs(low - accessor.min[a]) < 1e-6 * max(1, abs(low)) and abs(high - accessor.max[a]) < 1e-6 * max(1, abs(high))
    return values


def unit(q):
    length = math.sqrt(sum(x * x for x in q))
    return tuple(x / length for x in q)


def slerp(a, b, t):
    # what is rounded to 16 bits is not quite of length 1
    a, b = unit(a), unit(b)
    dot = sum(x * y for x, y in zip(a, b))
    if dot < 0:
        b, dot = tuple(-x for x in b), -dot
    angle = 2 * math.asin(min(1, math.dist(a, b) / 2))
    if angle < 1e-6:
        return a
    return tuple((math.sin((1 - t) * angle) * x + math.sin(t * angle) * y) / math.sin(angle) for x, y in zip(a, b))


def lerp(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


class Curve:
    def __init__(self, sampler, path):
        self.times = [time for (time,) in numbers(sampler.input)]
        self.values = numbers(sampler.output)
        assert len(self.times) == len(self.values) and self.times[0] >= 0
        assert all(a < b for a, b in zip(self.times, self.times[1:]))
        assert file.accessors[sampler.input].min and file.accessors[sampler.input].max
        self.steps = sampler.interpolation == "STEP"
        self.between = slerp if path == "rotation" else lerp

    def at(self, time):
        behind = bisect.bisect_right(self.times, time)
        if behind in (0, len(self.times)):
            return self.values[0 if behind == 0 else -1]
        start, end = self.times[behind - 1], self.times[behind]
        if self.steps:
            return self.values[behind - 1]
        return self.between(self.values[behind - 1], self.values[behind], (time - start) / (end - start))


def turned(q, v):
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]


animation = file.animations[0]
curves = {}
for channel in animation.channels:
    target = channel.target
    curves[target.node, target.path] = Curve(animation.samplers[channel.sampler], target.path)
agents = {node.extras["number"]: at for at, node in enumerate(file.nodes) if node.extras and "number" in node.extras}
origin = file.nodes[file.scenes[0].nodes[0]].translation or [0, 0, 0]
view = file.bufferViews[file.asset.extras["throng.times"]]
times = struct.unpack_from(f"<{view.byteLength // 8}d", blob, view.byteOffset or 0)

moments, last = {}, {}
for row in rows:
    number, time, heading = int(row["number"]), float(row["time"]), float(row["heading"])
    if number in last and file.nodes[agents[number]].mesh is None:
        # the node of a person turns by half a turn in a second at most
        before, most = last[number][1], math.pi * (time - last[number][0])
        turn = (heading - before + math.pi) % (2 * math.pi) - math.pi
        heading = before + max(-most, min(most, turn))
    last[number] = time, heading
    moments.setdefault(time, {})[number] = {**row, "heading": heading}
assert set(moments) <= set(times), "moments are missing"
assert {int(row["number"]) for row in rows} == set(agents)
worst = [0, 0, 0]
for time in times[:: max(1, len(times) // 100)]:
    second, there = struct.unpack("<f", struct.pack("<f", time - times[0]))[0], moments.get(time, {})
    for number, at in agents.items():
        node = file.nodes[at]

        def value(path):
            curve = curves.get((at, path))
            return curve.at(second) if curve else getattr(node, path)

        assert (max(value("scale")) > 0) == (number in there), (time, number, value("scale"))
        if number not in there:
            continue
        row, (x, y, z) = there[number], value("translation")
        place = (x + origin[0], -(z + origin[2]), y + origin[1])
        want = [float(row["x"]), float(row["y"]), float(row.get("z", 0))]
        ahead = turned(value("rotation"), (0, 0, 1))
        off = (math.atan2(-ahead[2], ahead[0]) - float(row["heading"]) + math.pi) % (2 * math.pi) - math.pi
        # for an agent that flies steeply, a small rotation is a large one along the ground
        level = math.hypot(ahead[0], ahead[2])
        worst = [max(a, b) for a, b in zip(worst, (max(abs(a - b) for a, b in zip(place, want)), abs(off) * level, 1))]
        assert worst[0] < 1.1e-3 and worst[1] < math.radians(0.4), (time, row, place, off)
        assert abs(node.extras["radius"] - float(row["radius"])) < 1e-6
        assert node.extras["group"] == row["group"] and node.extras["from"] <= time <= node.extras["to"]
        # the size of a skin is not that of the agent's radius
        assert abs(node.scale[2] - (1 if node.mesh is None else float(row["radius"]))) < 1e-6
scene = trimesh.load(sys.argv[1])
low, high = scene.bounds
assert all(math.isfinite(value) for value in (*low, *high)) and high[1] > low[1]
size = len(open(sys.argv[1], "rb").read())
print(f"{len(agents)} agents, {len(times)} moments, {len(animation.channels)} channels; places within {1e3 * worst[0]:.2f} mm, headings "
      f"{math.degrees(worst[1]):.2f}°; bounds {low.round(2)} to {high.round(2)}; {size / len(rows):.1f} bytes an agent-frame")
