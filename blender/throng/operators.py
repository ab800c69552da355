"""The operators: open a trajectory, run a scene, frame the crowd, render a frame."""

from collections.abc import Iterator
from pathlib import Path

import bpy
import numpy as np
import throng_sim as tg
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from . import crowds, simulation, stage
from .task import Progress, Task

ENDINGS = ("csv", "parquet", "rec", "sqlite", "usda", "glb", "txt", "traj", "h5")
"""Endings of the files that the package reads."""


class OpenTrajectory(Task, bpy.types.Operator):
    """Bring a recorded crowd into the scene: people with skeletons, and the floor plan"""

    bl_idname = "throng.open_trajectory"
    bl_label = "Open trajectory"

    filepath: StringProperty(name="File", subtype="FILE_PATH", options={"SKIP_SAVE"})
    filter_glob: StringProperty(default=";".join(f"*.{ending}" for ending in ENDINGS), options={"HIDDEN"})
    frame_rate: FloatProperty(
        name="Frames a second", description="Of a file that numbers frames; 0: as the file says", default=0, min=0
    )
    unit: FloatProperty(
        name="Unit", description="Metres for each unit of length of the file; 0: as the file says", default=0, min=0
    )
    waits: BoolProperty(description="Ends only when all is done", default=True, options={"HIDDEN", "SKIP_SAVE"})

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Asks for the file."""
        self.waits = False
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Opens the file."""
        return super().execute(context) if self.waits else self.start(context)

    def work(self, context: bpy.types.Context) -> Iterator[Progress]:
        """Reads the file and adds the crowd."""
        path = Path(bpy.path.abspath(self.filepath))
        yield Progress(0, f"Reading {path.name}")
        crowd = tg.Trajectories.read(path, frame_rate=self.frame_rate or None, unit=self.unit or None)
        yield from crowds.build(context, crowd, path.stem)
        for note in crowd.notes:
            self.report({"WARNING"}, note)
        self.report({"INFO"}, f"{len(crowd)} agents, {crowd.times[0]:.2f} to {crowd.times[-1]:.2f} s")


class RunScene(Task, bpy.types.Operator):
    """Run a scene, and bring its crowd into the scene"""

    bl_idname = "throng.run_scene"
    bl_label = "Run scene"

    source: EnumProperty(
        name="Source",
        items=[
            ("FILE", "Scene", "The scene file, floor plan or scene of the gallery that is chosen in the sidebar"),
            ("OBJECTS", "Objects", "The objects of this file with a role: ground, obstacles, starts and goals"),
        ],
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Runs while the window reacts."""
        return self.start(context)

    def work(self, context: bpy.types.Context) -> Iterator[Progress]:
        """Runs the scene and adds the crowd."""
        settings, level, has_objects = context.scene.throng, 0.0, self.source == "OBJECTS"
        if has_objects:
            scene, level = simulation.scene_of_objects(context)
        else:
            scene = simulation.scene_of_file(settings.scene)
        run = yield from simulation.run(scene, settings)
        title = scene.title or ("Crowd" if has_objects else Path(settings.scene).stem)
        yield from crowds.build(context, run.trajectories(), title, level, has_place=not has_objects)
        for note in scene.notes:
            self.report({"WARNING"}, note)
        self.report(
            {"INFO"}, f"{run.summary.arrived} of {run.summary.agents} agents arrived in {run.summary.time:.1f} s"
        )


class FrameCrowd(bpy.types.Operator):
    """Move the camera so that it sees the whole crowd"""

    bl_idname = "throng.frame_crowd"
    bl_label = "Frame crowd"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether there are a camera and a crowd."""
        cls.poll_message_set("Open a trajectory or run a scene first")
        return context.scene.camera is not None and any(crowds.SEEN in thing for thing in context.scene.objects)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Moves the camera."""
        if context.scene.camera.data.type != "PERSP":
            name = context.scene.camera.name
            self.report({"ERROR"}, f"{name} is not in perspective: choose the lens type Perspective, or another camera")
            return {"CANCELLED"}
        roots = [thing for thing in context.scene.objects if crowds.SEEN in thing]
        seen = [np.array(root[crowds.SEEN]).reshape(-1, 3) + root.location for root in roots]
        stage.frame(context.scene.camera, np.concatenate(seen))
        return {"FINISHED"}


class RenderFrame(bpy.types.Operator):
    """Render the current frame, and write it to the output path"""

    bl_idname = "throng.render_frame"
    bl_label = "Render frame"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether there is a camera."""
        cls.poll_message_set("The scene has no camera: open a trajectory or run a scene first")
        return context.scene.camera is not None

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Renders while the window shows the picture."""
        return bpy.ops.render.render("INVOKE_DEFAULT", write_still=True)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Renders, and returns when the picture is written."""
        return bpy.ops.render.render(write_still=True)


OPERATORS = (OpenTrajectory, RunScene, FrameCrowd, RenderFrame)


def _menu(menu: bpy.types.Menu, context: bpy.types.Context) -> None:
    menu.layout.operator(OpenTrajectory.bl_idname, text="Crowd trajectory (.rec, .csv, .parquet, ...)")


def register() -> None:
    """Adds the operators, and an entry of the menu File > Import."""
    for operator in OPERATORS:
        bpy.utils.register_class(operator)
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister() -> None:
    """Removes them."""
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    for operator in reversed(OPERATORS):
        bpy.utils.unregister_class(operator)
