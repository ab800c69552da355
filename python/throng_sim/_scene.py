"""Scenes: who walks where."""

from __future__ import annotations

import builtins
import json
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _geometry, _throng, _toml
from ._model import Model, named_or_python

if TYPE_CHECKING:
    from ._run import Run
    from ._world import World


class Scene:
    """A scene: ground, obstacles, groups of agents, and what a run of it must show.

    `source` is a name of the gallery, a path of a file, the text of a scene file (TOML), or a dict with the same keys.
    Files: scene files, JuPedSim scenarios, projects of Menge, floor plans (WKT, GeoJSON, DXF, SVG, OBJ).

    Without a source the scene is empty: `walkable` is its ground (a shape of shapely, GeoJSON, or WKT; without it, all
    ground is walkable), `dt` the seconds of a step, `limit` the latest end in seconds. Other keywords are keys of the
    scene file.

    >>> scene = Scene(walkable="POLYGON ((0 0, 20 0, 20 5, 0 5, 0 0))", dt=0.04)
    >>> scene.group("left", n=20, area="POLYGON ((0 0, 5 0, 5 5, 0 5, 0 0))", goal=(19, 2.5), speed=(1.3, 0.2))
    'left'
    >>> len(scene.build())
    20

    Raises `SceneError` with `line`, `column`, `what` is wrong and how to fix it (`hint`).
    """

    def __init__(
        self,
        source: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        *,
        walkable: Any = None,
        obstacles: Iterable[Any] = (),
        dt: float | None = None,
        limit: float | None = None,
        **keys: Any,
    ) -> None:
        self.notes: list[str] = []
        """What an importer left out or changed, a sentence each."""
        if source is not None:
            self._scene = self._open(source)
        else:
            self._scene = _throng.Scene.parse("", "scene", Path.cwd())
        if walkable is not None:
            self["walkable"] = {"polygons": [_area(polygon) for polygon in _geometry.polygons(walkable)]}
        for shape in obstacles:
            for polygon in _geometry.polygons(shape):
                if len(polygon) > 1:
                    raise ValueError("an obstacle has a hole: give its parts as obstacles of their own")
                self._append("obstacle", {"shape": {"polygon": polygon[0]}})
        for key, given in keys.items():
            self[key] = given
        if dt is not None:
            self["time.step"] = dt
        if limit is not None:
            self["time.limit"] = limit

    def _open(self, source: str | os.PathLike[str] | Mapping[str, Any]) -> _throng.Scene:
        if isinstance(source, Mapping):
            return _throng.Scene.parse(_toml.document(source), "scene", Path.cwd())
        if isinstance(source, str) and ("\n" in source or "=" in source):
            return _throng.Scene.parse(source, "scene", Path.cwd())
        scene, self.notes = _throng.Scene.open(Path(source))
        return scene

    @classmethod
    def _of(cls, scene: _throng.Scene, notes: Iterable[str] = ()) -> Scene:
        made = cls.__new__(cls)
        made._scene, made.notes = scene, list(notes)
        return made

    def _append(self, kind: str, table: Mapping[str, Any]) -> None:
        """Adds an item to a list of the scene file."""
        text = f"{self.toml}\n[[{kind}]]\n{_toml.document(table)}"
        self._scene = _throng.Scene.parse(text, "scene", self._scene.folder)

    def group(
        self,
        name: str = "agents",
        *,
        n: int | None = None,
        area: Any = None,
        at: Any = None,
        goal: Any = None,
        exit: Any = None,
        speed: float | tuple[float, float] | Mapping[str, Any] | None = None,
        model: str | None = None,
        gap: float = 0.0,
        parameters: Mapping[str, Any] | None = None,
        **keys: Any,
    ) -> str:
        """Adds a group of agents and returns its name.

        They start at random places of `area` (a shape), at least `gap` metres apart, or at the points `at`, (n, 2). They
        go to `goal`: a point, or an area, or a point for each. They leave at `exit`, an area. `speed` is in m/s: a
        number, mean and standard deviation, or a dict with `preferred` and `max`. `model` is a local model, with `parameters`. Other keywords are keys of a
        group in scene files: `body={"radius": 0.2}`.
        """
        table: dict[str, Any] = {"name": name}
        if area is not None and at is not None:
            raise ValueError("give `area` or `at`, not both")
        if at is not None:
            points = [[float(x), float(y)] for x, y in at]
            if n is not None and n != len(points):
                raise ValueError(f"`n` is {n}, but `at` has {len(points)} points")
            table |= {"count": len(points), "place": {"points": points}}
        elif area is not None:
            found = _geometry.polygons(area)
            if len(found) != 1 or len(found[0]) != 1:
                raise ValueError("`area` must be one polygon without holes: add a group for each")
            table |= {"count": n, "place": {"polygon": {"corners": found[0][0], "gap": gap}}}
        elif n is not None:
            table["count"] = n
        if goal is not None and exit is not None:
            raise ValueError("give `goal` or `exit`, not both")
        if exit is not None:
            table["goal"] = {"exit": _geometry.area(exit)}
        elif goal is not None:
            table["goal"] = _goal(goal)
        match speed:
            case None:
                pass
            case Mapping():
                table["speed"] = speed
            case (mean, deviation):
                table["speed"] = {"preferred": {"normal": {"mean": mean, "deviation": deviation}}}
            case _:
                table["speed"] = {"preferred": speed}
        if model is not None:
            table["avoid"] = {model: dict(parameters or {})}
        elif parameters is not None:
            raise ValueError("`parameters` are those of a `model`: name it")
        table |= keys
        self._append("group", {key: given for key, given in table.items() if given is not None})
        return name

    def __setitem__(self, path: str, value: Any) -> None:
        """Changes a value: `scene["avoid.orca.time_horizon"] = 2.5`. A key of a group changes all groups,
        `group.NAME.` before it one."""
        self._scene = self._scene.set(path, _toml.value(value))

    def __getitem__(self, path: str) -> Any:
        """Returns a value of the scene file: `scene["time.step"]`, `scene["group.0.count"]`."""
        import tomllib

        found: Any = tomllib.loads(self.toml)
        for key in path.split("."):
            match found:
                case list() if key.isdigit() and int(key) < len(found):
                    found = found[int(key)]
                case list():
                    named = [item for item in found if isinstance(item, dict) and item.get("name") == key]
                    if not named:
                        raise KeyError(path)
                    found = named[0]
                case dict() if key in found:
                    found = found[key]
                case _:
                    raise KeyError(path)
        return found

    @property
    def toml(self) -> str:
        """The text of the scene file."""
        return self._scene.toml()

    @property
    def title(self) -> str:
        """A title of one line."""
        return self._scene.title

    @property
    def seed(self) -> int:
        """The seed of all random numbers."""
        return self._scene.seed

    @property
    def dt(self) -> float:
        """Seconds of a step."""
        return self._scene.dt

    @property
    def limit(self) -> float:
        """The latest end, seconds."""
        return self._scene.limit

    @property
    def groups(self) -> list[str]:
        """The names of the groups."""
        return self._scene.groups

    def with_model(self, model: str) -> Scene:
        """Returns the scene with another local model in all groups: `"rvo"`, `"orca:time_horizon=4"`."""
        return self._of(self._scene.with_model(model), self.notes)

    def with_seed(self, seed: int) -> Scene:
        """Returns the scene with another seed."""
        return self._of(self._scene.with_seed(seed), self.notes)

    def build(
        self,
        *,
        seed: int | None = None,
        threads: int = 1,
        model: str | Model | None = None,
        behavior: Callable[[World], Any] | None = None,
    ) -> World:
        """Builds the world. It gets the same bits for any number of `threads`; 0: one for each core.

        `model` replaces the local models of all groups: a name, or a function made with `throng_sim.model`. `behavior`
        is a behaviour in Python, see `World.behavior`.

        >>> def upwards(world):
        ...     return [(0, 1)] * len(world)
        >>> world = Scene("circle").build(behavior=upwards)
        >>> world.step(50)
        >>> bool(world.velocities[:, 1].mean() > 0.9)
        True
        """
        from ._world import World

        scene = self if seed is None else self.with_seed(seed)
        name, python = named_or_python(model)
        if name is not None:
            scene = scene.with_model(name)
        world = World._of(scene._scene.build(threads), scene)
        if python is not None:
            world.set_model(python)
        world.behavior = behavior
        return world

    def run(
        self,
        *,
        seed: int | None = None,
        threads: int = 1,
        model: str | Model | None = None,
        behavior: Callable[[World], Any] | None = None,
        record: float = 10.0,
        until: float | None = None,
    ) -> Run:
        """Runs the scene to its end, or until `until` seconds, and records `record` frames a second."""
        from ._run import Run

        return Run.of(self.build(seed=seed, threads=threads, model=model, behavior=behavior), record=record, until=until)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the scene file."""
        with builtins.open(path, "w", encoding="utf-8") as file:
            file.write(self.toml)

    def copy(self) -> Scene:
        """Returns an equal scene, which can be changed on its own."""
        return self._of(self._scene, self.notes)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and bool(self._scene == other._scene)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickle, (self.toml, str(self._scene.folder), self.notes)

    def __repr__(self) -> str:
        title = f" {json.dumps(self.title)}" if self.title else ""
        return f"<Scene{title}: {', '.join(self.groups) or 'no groups'}>"


def _unpickle(text: str, folder: str, notes: list[str]) -> Scene:
    return Scene._of(_throng.Scene.parse(text, "scene", Path(folder)), notes)


def _area(polygon: list[list[list[float]]]) -> dict[str, Any]:
    outline, *holes = polygon
    return {"outer": outline, "holes": holes} if holes else {"outer": outline}


def _goal(given: Any) -> dict[str, Any]:
    if isinstance(given, str) or hasattr(given, "__geo_interface__"):
        shape = _geometry.mapping(given)
        if shape["type"] == "Point":
            return {"point": [float(number) for number in shape["coordinates"][:2]]}
        return {"area": _geometry.area(given)}
    if isinstance(given, Mapping):
        return {"area": _geometry.area(given)} if "type" in given else dict(given)
    numbers = list(given)
    if numbers and not isinstance(numbers[0], Iterable):
        if len(numbers) != 2:
            raise ValueError(f"the goal has {len(numbers)} numbers, but a point has two: x and y")
        return {"point": [float(number) for number in numbers]}
    return {"points": {"at": [[float(x), float(y)] for x, y in numbers]}}


def open(
    path: str | os.PathLike[str],
    *,
    exit: tuple[float, float, float, float] | None = None,
    people: int | None = None,
    unit: float | None = None,
    level: int | None = None,
) -> Scene:
    """Opens a scene: a name of the gallery, or a file.

    For floor plans: `exit` is x and y of the lower left corner, width and height in metres, in place of the exits of the
    plan; `people` their number; `unit` metres for each unit of the plan; `level` the level of a mesh, from 1.
    """
    if exit is None and people is None and unit is None and level is None:
        return Scene(path)
    scene, notes = _throng.Scene.plan(Path(path), list(exit) if exit else None, people, unit, level)
    return Scene._of(scene, notes)


def ground(outlines: Iterable[Any], solids: Iterable[Any] = ()) -> dict[str, Any]:
    """Returns the ground that outlines make together, without solid outlines, as GeoJSON for `Scene(walkable=...)`.

    An outline is a list of corners, metres, in either orientation; outlines may overlap.

    >>> def square(low, high):
    ...     return [(low, low), (high, low), (high, high), (low, high)]
    >>> [len(area) for area in ground([square(0, 4), square(3, 6)], [square(1, 2)])["coordinates"]]
    [2]
    """
    given = [[[[float(x), float(y)] for x, y in outline] for outline in all] for all in (outlines, solids)]
    return {"type": "MultiPolygon", "coordinates": _throng.cut_ground(*given)}


def gallery() -> dict[str, list[str]]:
    """Returns the names of the gallery's scenes, by group.

    >>> "circle" in sum(gallery().values(), [])
    True
    """
    return dict(_throng.gallery())


def models() -> list[str]:
    """Returns the names of the local models.

    >>> "orca" in models()
    True
    """
    return _throng.models()


def schema() -> dict[str, Any]:
    """Returns the JSON schema of scene files."""
    schema: dict[str, Any] = json.loads(_throng.schema())
    return schema
