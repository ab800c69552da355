"""Several models on the same scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from ._model import Model, named_or_python
from ._scene import Scene


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
        return self.to_pandas().to_html()

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        lines = ["model            seed  arrived    time  overlaps  turning"]
        for row in self.rows:
            lines.append(
                f"{row['model']:16} {row['seed']:4}  {row['arrived']:7}  {row['time']:6.2f}  {row['overlaps']:8}"
                f"  {row['course_change_deg_per_s']:7.1f}"
            )
        return "\n".join(lines)


def compare(
    scene: Scene | str,
    models: Iterable[str | Model | Callable[..., Any]],
    *,
    seeds: Sequence[int] | None = None,
    until: float | None = None,
    threads: int = 1,
) -> Comparison:
    """Runs a scene with several models and seeds.

    >>> import throng_sim as tg
    >>> [row["model"] for row in tg.compare("headon", ["orca", "rvo"]).rows]
    ['orca', 'rvo']
    """
    scene = scene if isinstance(scene, Scene) else Scene(scene)
    rows = []
    for given in models:
        name, python = named_or_python(given)
        for seed in seeds if seeds is not None else [scene.seed]:
            world = scene.build(seed=seed, threads=threads, model=given)  # type: ignore[arg-type]
            summary = world.run(until)
            label = name if python is None else python.name
            passed = world.expectations.passed
            rows.append({"model": label, "seed": seed, **summary, "passed": passed, "hash": world.hash()})
    return Comparison(rows)
