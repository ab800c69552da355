"""Several models on the same scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from ._model import Model, named_or_python
from ._scene import Scene

if TYPE_CHECKING:
    from ._world import World


class Comparison:
    """A row for each run: `model`, `seed`, and the statistics of the summary."""

    def __init__(self, rows: list[dict[str, Any]]) -> None:
        self.rows = rows

    def to_pandas(self) -> Any:
        """Returns the rows as a data frame of pandas."""
        try:
            import pandas
        except ImportError:
            raise ImportError("a data frame needs pandas: pip install pandas") from None
        return pandas.DataFrame(self.rows)

    def _repr_html_(self) -> str:
        return str(self.to_pandas().to_html())

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        width = max((len(row["model"]) for row in self.rows), default=5)
        lines = [f"{'model':{width}}  seed  arrived    time  overlaps  turning"]
        for row in self.rows:
            lines.append(
                f"{row['model']:{width}} {row['seed']:4}  {row['arrived']:7}  {row['time']:6.2f}  {row['overlaps']:8}"
                f"  {row['course_change_deg_per_s']:7.1f}"
            )
        return "\n".join(lines)


def compare(
    scene: Scene | str,
    models: Iterable[str | Model | Callable[..., Any]] = (),
    *,
    behaviors: Iterable[Callable[[World], Any]] = (),
    seeds: Sequence[int] | None = None,
    until: float | None = None,
    threads: int = 1,
) -> Comparison:
    """Runs a scene with several models, with several behaviours in Python, and with several seeds.

    >>> import throng_sim as tg
    >>> [row["model"] for row in tg.compare("headon", ["orca", "rvo"]).rows]
    ['orca', 'rvo']
    """
    scene = scene if isinstance(scene, Scene) else Scene(scene)
    kinds: list[dict[str, Any]] = [{"model": given} for given in models]
    kinds += [{"behavior": given} for given in behaviors]
    labels = _distinct([_label(*kind.values()) for kind in kinds])
    rows = []
    for label, kind in zip(labels, kinds, strict=True):
        for seed in seeds if seeds is not None else [scene.seed]:
            world = scene.build(seed=seed, threads=threads, **kind)
            summary = world.run(until)
            passed = world.expectations.passed
            rows.append({"model": label, "seed": seed, **summary, "passed": passed, "hash": world.hash()})
    return Comparison(rows)


def _label(given: str | Model | Callable[..., Any]) -> str:
    name, python = named_or_python(given)
    return name if python is None else python.name  # type: ignore[return-value]


def _distinct(labels: list[str]) -> list[str]:
    """Returns labels that differ: equal ones get a number."""
    return [
        label if labels.count(label) == 1 else f"{label} ({labels[: k + 1].count(label)})" for k, label in enumerate(labels)
    ]
