"""Sweeps: the runs of a plan, in threads or on a cluster of Ray, and one table of the results.

The plan and the table are those of `throng sweep` (docs/sweeps.md), to the byte, and finished runs are kept in the same
folder: a sweep that one began the other continues.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _throng


@dataclass(frozen=True)
class Results:
    """The results of a sweep."""

    path: Path
    """The table, Parquet."""
    runs: int
    """The number of runs in the table."""
    failed: int
    """The number of runs that could not be made; the column `error` says why."""

    def table(self) -> Any:
        """Returns the table of pyarrow: a row for each run."""
        import pyarrow.parquet

        return pyarrow.parquet.read_table(self.path)

    def to_pandas(self) -> Any:
        """Returns the table as a data frame of pandas."""
        return self.table().to_pandas()


def sweep(
    plan: str | os.PathLike[str],
    output: str | os.PathLike[str] | None = None,
    *,
    workers: int = 0,
    ray: bool | str = False,
    progress: Callable[[int, int], None] | None = None,
) -> Results:
    """Makes the runs of a plan that are not yet made, and writes the table of all.

    `plan` is a file, or the text of one. `output` is the table, a name in .parquet: by default that of the plan.
    `workers` threads make the runs; 0: one for each core. With `ray=True` the runs are tasks of Ray, on the cluster that
    is connected or a local one; a text is the address of a cluster. The workers need this package, and scene files under
    the same names. `progress` is called with the numbers of made and of all missing runs.

    Ctrl-C stops it; the next call goes on. The results are the same to the byte, whoever makes the runs.
    """
    source, text, folder = _read(plan)
    read = _throng.Plan.parse(source.name if source else "plan", text, folder)
    if output is None:
        if source is None:
            raise ValueError("a plan that is a text needs an `output`: the name of the table, in .parquet")
        output = source.with_suffix(".parquet")
    path = Path(output)
    if path.suffix != ".parquet":
        raise ValueError(f"{path}: the table of a sweep ends in .parquet")
    kept = path.with_suffix(".runs")
    missing = read.missing(kept)
    made = _on_ray(text, folder, missing, ray) if ray else _in_threads(read, missing, workers)
    for count, (index, results) in enumerate(made, 1):
        read.keep(index, results, kept)
        if progress is not None:
            progress(count, len(missing))
    runs, failed = read.write(kept, [path])
    return Results(path, runs, failed)


def _read(plan: str | os.PathLike[str]) -> tuple[Path | None, str, Path]:
    if isinstance(plan, str) and ("\n" in plan or "=" in plan):
        return None, plan, Path.cwd()
    source = Path(plan)
    return source, source.read_text(encoding="utf-8"), source.resolve().parent


def _in_threads(plan: Any, missing: list[int], workers: int) -> Iterator[tuple[int, str]]:
    """Makes runs in threads: a run does not hold the global lock."""
    with ThreadPoolExecutor(workers or os.cpu_count()) as pool:
        waiting = {pool.submit(plan.make, index): index for index in missing}
        try:
            while waiting:
                done, _ = wait(waiting, timeout=0.2, return_when=FIRST_COMPLETED)
                for future in sorted(done, key=waiting.__getitem__):
                    yield waiting.pop(future), future.result()
        except BaseException:
            plan.stop()
            pool.shutdown(cancel_futures=True)
            raise


@functools.lru_cache(maxsize=1)
def _plan(text: str, folder: str) -> Any:
    return _throng.Plan.parse("plan", text, Path(folder))


def make_run(text: str, folder: str, index: int) -> tuple[int, str]:
    """Makes one run of a plan: the task of a worker. Returns the number of the run and its results, as JSON."""
    return index, _plan(text, folder).make(index)


def _on_ray(text: str, folder: Path, missing: list[int], address: bool | str) -> Iterator[tuple[int, str]]:
    try:
        import ray
    except ImportError:
        raise ImportError("a sweep on Ray needs it: pip install ray") from None
    cluster: Any = ray
    if not ray.is_initialized():
        ray.init(address=address if isinstance(address, str) else None, log_to_driver=False)
    task = ray.remote(num_cpus=1)(make_run)
    # a bounded number of tasks waits, so that a sweep of a million runs does not fill the cluster's memory
    resources: dict[str, float] = cluster.cluster_resources()
    most = max(4 * int(resources.get("CPU", 1)), 8)
    left = iter(missing)
    waiting = [task.remote(text, str(folder), index) for _, index in zip(range(most), left)]
    while waiting:
        done, waiting = ray.wait(waiting)
        yield from ray.get(done)
        waiting += [task.remote(text, str(folder), index) for _, index in zip(range(len(done)), left)]
