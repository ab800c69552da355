"""People as armatures with skinned meshes and an action each."""

from collections.abc import Iterator

import bpy
import numpy as np
from throng_sim import figure

from . import actions, bodies, keys, quaternions
from .clip import Clip

MAIN = {"Hips": "Spine", "Spine": "Spine1", "Spine1": "Neck"}
"""The child to which the bone of a joint with several children points."""
END = {"Head": (0, 0, 0.13), "LeftHand": (0, 0.06, -0.06), "RightHand": (0, -0.06, -0.06)}
"""Where bones without children point to, for a height of 1 m; others point ahead."""
AHEAD = (0.05, 0, 0)
LEGS = {"Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg", "RightFoot"}
TOLERANCE, LEG_TOLERANCE = 1.2e-3, 2e-4
"""Greatest distance of a quaternion from its curve; half an angle in radians. Legs carry feet, which must not slide."""
PLACE = 2e-4
"""Greatest distance of a position from its curve, metres."""
TURN = 2e-3
"""Greatest error of the heading, radians."""


class Cast:
    """The armatures and meshes that people share."""

    def __init__(self, level: str) -> None:
        self.level = level
        self._rigs: dict[str, tuple[bpy.types.Armature, np.ndarray]] = {}
        self._meshes: dict[tuple[str, int], bpy.types.Mesh] = {}
        self._skins: dict[tuple[str, tuple[int, ...]], bpy.types.Mesh] = {}

    def rig(self, build: str) -> tuple[bpy.types.Armature, np.ndarray]:
        """Returns the armature of a build of height 1 m, and how its bones are turned at rest: (19, 4)."""
        if build not in self._rigs:
            made = _armature(build)
            turns = [made.bones[joint].matrix_local.to_quaternion() for joint in figure.JOINTS]
            self._rigs[build] = made, np.array(turns)
        return self._rigs[build]

    def mesh(self, build: str, look: int) -> bpy.types.Mesh:
        """Returns the mesh of a build with a look."""
        if (build, look) not in self._meshes:
            body = figure.mesh(build, self.level)
            cut = build, tuple(region for region in figure.worn(look) if region in body.regions)
            made = self._skins[cut].copy() if cut in self._skins else _skin(build, body, body.triangles_of(look))
            self._skins.setdefault(cut, made)
            made.name = f"{build.capitalize()} {look}"
            bodies.paint(made, bodies.colors(body, look))
            self._meshes[build, look] = made
        return self._meshes[build, look]


def people(clip: Clip, rows: list[int], parent: bpy.types.Object, into: bpy.types.Collection) -> Iterator[float]:
    """Adds a person for each row. Yields the share that is done."""
    level = bpy.context.scene.throng.level
    cast, origin = Cast(level), clip.origin()
    for done, row in enumerate(rows):
        frames = clip.present(row)
        if len(frames):
            armature = _person(clip, row, cast, into)
            armature.parent = parent
            _animate(armature, clip, row, frames, cast.rig(clip.trajectories.builds[row])[1], origin)
        yield (done + 1) / len(rows)


def _person(clip: Clip, row: int, cast: Cast, into: bpy.types.Collection) -> bpy.types.Object:
    """Adds the objects of a person."""
    crowd = clip.trajectories
    build, number = crowd.builds[row], int(crowd.ids[row])
    rig, _ = cast.rig(build)
    armature = bpy.data.objects.new(f"Agent_{number}", rig)
    armature["number"], armature["group"] = number, crowd.group_names[crowd.groups[row]]
    body = bpy.data.objects.new(f"Body_{number}", cast.mesh(build, int(crowd.looks[row])))
    body.parent = armature
    skin = body.modifiers.new("Armature", "ARMATURE")
    skin.object = armature
    for made in (armature, body):
        into.objects.link(made)
    return armature


def _animate(
    armature: bpy.types.Object, clip: Clip, row: int, frames: np.ndarray, at_rest: np.ndarray, origin: np.ndarray
) -> None:
    """Gives a person its motion: the object moves on the ground and turns, the bones move relative to it."""
    crowd = clip.trajectories
    times = clip.times_within(row, frames)
    number = crowd.ids[[row]]
    positions, headings = (array[0] for array in crowd.states(times, ids=number))
    hips, turns = (array[0].astype(float) for array in crowd.poses(times, ids=number))
    height = float(crowd.heights[row])
    headings = np.unwrap(headings)
    places = positions - origin
    back = quaternions.inverse(quaternions.about_z(headings))
    # from the world into the object, and into the axes of the bones at rest
    hips = quaternions.rotated(back, hips - positions) / height - bodies.rest(crowd.builds[row])[0]
    hips = quaternions.rotated(quaternions.inverse(at_rest[0]), hips)
    turns[:, 0] = quaternions.product(back, turns[:, 0])
    turns = quaternions.product(quaternions.inverse(at_rest), quaternions.product(turns, at_rest))
    turns = quaternions.continuous(turns)

    curves = actions.Curves(armature, f"Agent_{int(number[0])}")
    curves.add("location", frames, places[:, None], np.array([PLACE]))
    curves.add("rotation_euler", frames, headings[:, None, None], np.array([TURN]), first=2)
    curves.add('pose.bones["Hips"].location', frames, hips[:, None], np.array([PLACE / height]))
    tolerances = np.array([LEG_TOLERANCE if joint in LEGS else TOLERANCE for joint in figure.JOINTS])
    paths = [f'pose.bones["{joint}"].rotation_quaternion' for joint in figure.JOINTS]
    curves.add_all(paths, frames, turns, keys.needed(turns, tolerances))
    armature.scale = (height,) * 3
    # before and after its time a person has no size
    steps = [(frames[0], height)]
    if frames[0] > clip.start:
        steps.insert(0, (clip.start, 0.0))
    if frames[-1] < clip.end:
        steps.append((frames[-1] + 1, 0.0))
    if len(steps) > 1:
        curves.step("scale", steps, 3)


def _armature(build: str) -> bpy.types.Armature:
    """Returns the armature of a build."""
    made = bpy.data.armatures.new(build.capitalize())
    made.display_type = "STICK"
    holder = bpy.data.objects.new(made.name, made)
    layer, scene = bpy.context.view_layer, bpy.context.scene
    before = layer.objects.active
    if before is not None and before.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    scene.collection.objects.link(holder)
    layer.objects.active = holder
    bpy.ops.object.mode_set(mode="EDIT")
    places = bodies.rest(build)
    for joint, (name, parent) in enumerate(zip(figure.JOINTS, figure.PARENTS, strict=True)):
        bone = made.edit_bones.new(name)
        children = [child for child, above in enumerate(figure.PARENTS) if above == joint]
        main = figure.JOINTS.index(MAIN[name]) if name in MAIN else next(iter(children), None)
        bone.head = places[joint]
        bone.tail = places[joint] + END.get(name, AHEAD) if main is None else places[main]
        if parent >= 0:
            bone.parent = made.edit_bones[figure.JOINTS[parent]]
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(holder)
    layer.objects.active = before
    return made


def _skin(build: str, body: figure.Mesh, triangles: np.ndarray) -> bpy.types.Mesh:
    """Returns the mesh of some triangles of a build with the weights of the joints."""
    mesh = bodies.shape(build, body.positions, triangles)
    mesh.materials.append(bodies.material("People"))
    holder = bpy.data.objects.new(build, mesh)
    for joint, name in enumerate(figure.JOINTS):
        group = holder.vertex_groups.new(name=name)
        part = np.where(body.joints == joint, body.weights, 0).sum(axis=1)
        for weight in np.unique(part[part > 0]):
            group.add(np.flatnonzero(part == weight).tolist(), float(weight), "REPLACE")
    bpy.data.objects.remove(holder)
    return mesh
