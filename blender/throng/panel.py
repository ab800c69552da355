"""The panels of the 3D view's sidebar."""

import bpy

from .operators import FrameCrowd, OpenTrajectory, RenderFrame, RunScene


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Throng"


class THRONG_PT_crowd(_Panel, bpy.types.Panel):
    """Trajectories and runs"""

    bl_label = "Crowd"

    def draw(self, context: bpy.types.Context) -> None:
        """Draws the operators."""
        settings, layout = context.scene.throng, self.layout
        layout.operator(OpenTrajectory.bl_idname, icon="IMPORT")
        box = layout.column(align=True)
        box.prop(settings, "scene", text="")
        row = box.row(align=True)
        row.prop(settings, "seconds")
        row.prop(settings, "seed")
        row = box.row(align=True)
        for source, text in (("FILE", "Run scene"), ("OBJECTS", "Run objects")):
            row.operator(RunScene.bl_idname, text=text, icon="PLAY").source = source
        row = layout.row(align=True)
        row.operator(FrameCrowd.bl_idname, icon="CAMERA_DATA")
        row.operator(RenderFrame.bl_idname, icon="RENDER_STILL")


class THRONG_PT_options(_Panel, bpy.types.Panel):
    """How crowds are brought into the scene"""

    bl_label = "Options"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draws the options."""
        layout = self.layout
        layout.use_property_split = True
        names = ("armatures", "level", "crowd_level", "pose_rate", "wall_height", "start", "fit_range", "has_stage")
        for name in names:
            layout.prop(context.scene.throng, name)


class THRONG_PT_object(_Panel, bpy.types.Panel):
    """What the active object and its collection are to the crowd"""

    bl_label = "Object"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether an object is active."""
        return context.object is not None

    def draw(self, context: bpy.types.Context) -> None:
        """Draws the role and what belongs to it."""
        layout, own = self.layout, context.object.throng
        layout.use_property_split = True
        layout.prop(own, "role")
        if own.role == "START":
            for name in ("people", "speed", "spread", "radius", "goal"):
                layout.prop(own, name)
        if own.role == "GOAL":
            layout.prop(own, "leaves")
        layout.prop(context.collection.throng, "role", text=f"Role of {context.collection.name}")


PANELS = (THRONG_PT_crowd, THRONG_PT_options, THRONG_PT_object)


def register() -> None:
    """Adds the panels."""
    for panel in PANELS:
        bpy.utils.register_class(panel)


def unregister() -> None:
    """Removes them."""
    for panel in reversed(PANELS):
        bpy.utils.unregister_class(panel)
