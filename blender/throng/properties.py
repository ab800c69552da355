"""What users set: of a scene, of collections, and of objects."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

ROLES = [
    ("INHERIT", "As its collection", "The role of the innermost collection with one; none without"),
    ("NONE", "None", "No part of the simulation"),
    ("GROUND", "Ground", "People walk on its faces that look up"),
    ("OBSTACLE", "Obstacle", "People walk around what of it is lower than 2 m above the ground"),
    ("START", "Start", "People start on its outline, seen from above"),
    ("GOAL", "Goal", "People go to its outline, seen from above"),
]
LEVELS = [
    ("fine", "Fine", "1104 vertices"),
    ("medium", "Medium", "704 vertices"),
    ("coarse", "Coarse", "352 vertices"),
    ("blocks", "Blocks", "128 vertices"),
]


class ThrongCollection(bpy.types.PropertyGroup):
    """The part of a collection's objects in the simulation."""

    role: EnumProperty(
        name="Role", description="What the objects of the collection are to the crowd", items=ROLES, default="INHERIT"
    )


class ThrongObject(bpy.types.PropertyGroup):
    """The part of an object in the simulation."""

    role: EnumProperty(name="Role", description="What the object is to the crowd", items=ROLES, default="INHERIT")
    people: IntProperty(name="People", description="How many people start here", default=20, min=1, soft_max=1000)
    speed: FloatProperty(
        name="Speed", description="Mean of the preferred speeds", default=1.3, min=0.1, max=5, unit="VELOCITY"
    )
    spread: FloatProperty(
        name="Spread",
        description="Standard deviation of the preferred speeds",
        default=0.2,
        min=0,
        max=1,
        unit="VELOCITY",
    )
    radius: FloatProperty(
        name="Radius", description="Radius of the bodies: no two overlap", default=0.2, min=0.1, max=0.5, unit="LENGTH"
    )
    goal: PointerProperty(
        name="Goal",
        description="The object to which people go from here; none: the nearest of all goals",
        type=bpy.types.Object,
    )
    leaves: BoolProperty(name="People leave", description="People leave the scene at this goal", default=True)


class ThrongScene(bpy.types.PropertyGroup):
    """How a crowd is brought into a scene."""

    scene: StringProperty(
        name="Scene",
        description="A scene file or floor plan, or the name of a scene of the gallery, such as doorway",
        default="doorway",
        subtype="FILE_PATH",
    )
    seconds: FloatProperty(
        name="Duration",
        description="The run ends at the latest then",
        default=20,
        min=0.1,
        soft_max=600,
        unit="TIME_ABSOLUTE",
    )
    seed: IntProperty(name="Seed", description="Seed of all random numbers of a run", default=1, min=0)
    start: IntProperty(name="First frame", description="The frame of the first moment", default=1, min=0)
    fit_range: BoolProperty(
        name="Set the frame range", description="The frame range of the scene becomes that of the crowd", default=True
    )
    armatures: IntProperty(
        name="Armatures",
        description="Up to this number of people have an armature each; more people are one mesh together",
        default=200,
        min=0,
        soft_max=1000,
    )
    level: EnumProperty(
        name="Detail", description="Level of detail of people with armatures", items=LEVELS, default="fine"
    )
    crowd_level: EnumProperty(
        name="Detail of the crowd",
        description="Level of detail of people without armatures",
        items=LEVELS,
        default="coarse",
    )
    pose_rate: FloatProperty(
        name="Poses a second",
        description="Stored poses of people without armatures; between them poses are interpolated",
        default=25,
        min=1,
        max=120,
    )
    wall_height: FloatProperty(
        name="Wall height",
        description="Height of obstacles and walls",
        default=2.5,
        min=0.01,
        soft_max=20,
        unit="LENGTH",
    )
    has_stage: BoolProperty(
        name="Camera and light",
        description="Adds a camera that frames the crowd, a sun and a sky, where the scene has none",
        default=True,
    )


GROUPS = (ThrongCollection, ThrongObject, ThrongScene)


def register() -> None:
    """Adds the properties to Blender's types."""
    for group in GROUPS:
        bpy.utils.register_class(group)
    bpy.types.Collection.throng = PointerProperty(type=ThrongCollection)
    bpy.types.Object.throng = PointerProperty(type=ThrongObject)
    bpy.types.Scene.throng = PointerProperty(type=ThrongScene)


def unregister() -> None:
    """Removes them."""
    del bpy.types.Scene.throng, bpy.types.Object.throng, bpy.types.Collection.throng
    for group in reversed(GROUPS):
        bpy.utils.unregister_class(group)
