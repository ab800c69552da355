"""Throng in Blender: crowds from trajectories, scenes, and the objects of the file."""

from . import operators, panel, properties

PARTS = (properties, operators, panel)


def register() -> None:
    """Adds properties, operators and panels."""
    for part in PARTS:
        part.register()


def unregister() -> None:
    """Removes them."""
    for part in reversed(PARTS):
        part.unregister()
