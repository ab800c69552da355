"""The people of a .glb by the specification of glTF: where their joints are, and where their skin is.

Used by bvh.py, usda_people.py and blender_people.py. Everything is in the axes of the scene (z up), metres.
"""
import json
import struct

import numpy as np

WIDTH = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}
KIND = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


def matrix(translation, rotation, scale):
    x, y, z, w = rotation / np.linalg.norm(rotation)
    m = np.eye(4)
    m[:3, :3] = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]) * scale
    m[:3, 3] = translation
    return m


def slerp(a, b, t):
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    if a @ b < 0:
        b = -b
    angle = 2 * np.arcsin(min(1, np.linalg.norm(a - b) / 2))
    return a if angle < 1e-6 else (np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / np.sin(angle)


def to_scene(points):
    points = np.asarray(points)
    return np.stack([points[..., 0], -points[..., 2], points[..., 1]], -1)


class Skins:
    def __init__(self, path):
        data = open(path, "rb").read()
        length = struct.unpack_from("<I", data, 12)[0]
        self.file, self.blob = json.loads(data[20:20 + length]), data[28 + length:]
        self.nodes, animation = self.file["nodes"], self.file["animations"][0]
        self.curves = {}
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            target = channel["target"]
            self.curves[target["node"], target["path"]] = (
                self.numbers(sampler["input"])[:, 0], self.numbers(sampler["output"]), sampler.get("interpolation") == "STEP")
        view = self.file["bufferViews"][self.file["asset"]["extras"]["throng.times"]]
        self.times = np.frombuffer(self.blob, "<f8", view["byteLength"] // 8, view.get("byteOffset", 0))
        parents = {child: at for at, node in enumerate(self.nodes) for child in node.get("children", [])}
        self.above = {}
        for at in range(len(self.nodes)):
            chain = [at]
            while chain[-1] in parents:
                chain.append(parents[chain[-1]])
            self.above[at] = chain[::-1]
        self.people = {}
        for at, node in enumerate(self.nodes):
            if "skin" in node:
                skin = self.file["skins"][node["skin"]]
                number = self.nodes[parents[skin["joints"][0]]]["extras"]["number"]
                self.people[number] = (at, skin)

    def numbers(self, at):
        accessor = self.file["accessors"][at]
        view = self.file["bufferViews"][accessor["bufferView"]]
        kind, width = KIND[accessor["componentType"]], WIDTH[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        values = np.frombuffer(self.blob, kind, accessor["count"] * width, start).reshape(-1, width).astype(float)
        top = {"<i2": 32767, "u1": 255}.get(kind, 1) if accessor.get("normalized") else 1
        return values / top

    def value(self, at, path, second):
        default = {"translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]}[path]
        if (at, path) not in self.curves:
            return np.array(self.nodes[at].get(path, default), float)
        times, values, steps = self.curves[at, path]
        behind = np.searchsorted(times, second, "right")
        if behind in (0, len(times)):
            return values[min(behind, len(times) - 1)]
        a, b = values[behind - 1], values[behind]
        if steps:
            return a
        t = (second - times[behind - 1]) / (times[behind] - times[behind - 1])
        return slerp(a, b, t) if path == "rotation" else a + (b - a) * t

    def there(self, number, time):
        node = self.above[self.people[number][1]["joints"][0]][-2]
        return self.value(node, "scale", np.float32(time - self.times[0])).max() > 0

    def matrices(self, number, time):
        """The matrix of each joint in the file, by name."""
        second, known = np.float32(time - self.times[0]), {}

        def world(at):
            if at not in known:
                local = matrix(*(self.value(at, path, second) for path in ("translation", "rotation", "scale")))
                above = self.above[at][:-1]
                known[at] = world(above[-1]) @ local if above else local
            return known[at]

        return {self.nodes[at]["name"]: world(at) for at in self.people[number][1]["joints"]}

    def joints(self, number, time):
        """Where each joint is in the scene, by name."""
        return {name: to_scene(m[:3, 3]) for name, m in self.matrices(number, time).items()}

    def skin(self, number, time):
        """Where each vertex of the body is in the scene."""
        at, skin = self.people[number]
        attributes = self.file["meshes"][self.nodes[at]["mesh"]]["primitives"][0]["attributes"]
        points, joints, weights = (self.numbers(attributes[name]) for name in ("POSITION", "JOINTS_0", "WEIGHTS_0"))
        binds = self.numbers(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
        moved = np.array(list(self.matrices(number, time).values())) @ binds
        points = np.concatenate([points, np.ones((len(points), 1))], 1)
        each = np.einsum("vkij,vj->vki", moved[joints.astype(int)], points)[..., :3]
        return to_scene((each * weights[..., None]).sum(1))
