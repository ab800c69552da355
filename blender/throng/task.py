"""Operators that take a while: with progress, and Esc to cancel."""

import time
from collections.abc import Iterator
from dataclasses import dataclass

import bpy

SLICE = 0.1
"""Seconds of work between two looks at the keyboard."""


USERS = (ValueError, OSError, RuntimeError)
"""Errors that users can fix: of files, scenes and values."""


@dataclass(frozen=True)
class Progress:
    """How far a task is."""

    share: float
    text: str


class Task:
    """An operator whose work is a generator, `work`, that yields its progress.

    An error that users can fix is a report. The work leaves nothing behind when it fails or is cancelled.
    """

    bl_options = {"REGISTER", "UNDO"}

    def work(self, context: bpy.types.Context) -> Iterator[Progress]:
        """Does the work, and yields its progress."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Does all work at once."""
        try:
            for _ in self.work(context):
                pass
        except USERS as error:
            return self.fail(error)
        return {"FINISHED"}

    def start(self, context: bpy.types.Context) -> set[str]:
        """Does the work in slices, between which the window reacts."""
        self._work = self.work(context)
        self._timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Does the next slice."""
        if event.type == "ESC":
            self._work.close()
            self.end(context)
            self.report({"WARNING"}, "Cancelled; nothing was added")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        until = time.monotonic() + SLICE
        try:
            while time.monotonic() < until:
                now = next(self._work)
                context.window_manager.progress_update(round(now.share * 100))
                context.workspace.status_text_set(f"{now.text}: {now.share:.0%}    Esc: cancel")
        except StopIteration:
            self.end(context)
            return {"FINISHED"}
        except Exception as error:
            self.end(context)
            if isinstance(error, USERS):
                return self.fail(error)
            raise
        return {"RUNNING_MODAL"}

    def end(self, context: bpy.types.Context) -> None:
        """Removes timer and progress."""
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)

    def fail(self, error: Exception) -> set[str]:
        """Reports an error."""
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}
