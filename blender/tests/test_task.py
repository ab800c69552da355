"""Operators that work in slices: progress, Esc, errors. A window is missing here, so its manager is a substitute."""

from collections.abc import Iterator
from types import SimpleNamespace
from unittest.mock import MagicMock

import pytest
from throng.task import Progress, Task


class Counting(Task):
    """Counts to ten."""

    def __init__(self, fails: Exception | None = None) -> None:
        self.reports, self.closed, self.fails = [], False, fails

    def report(self, kind: set[str], text: str) -> None:
        self.reports.append((*kind, text))

    def work(self, context: object) -> Iterator[Progress]:
        try:
            for k in range(10):
                if self.fails and k == 5:
                    raise self.fails
                yield Progress(k / 10, "Counting")
        except GeneratorExit:
            self.closed = True
            raise


@pytest.fixture
def context(monkeypatch: pytest.MonkeyPatch) -> MagicMock:
    # a slice is over after one piece of work
    clock = iter(range(10_000))
    monkeypatch.setattr("throng.task.time", SimpleNamespace(monotonic=lambda: next(clock) * 0.06))
    return MagicMock()


TIMER, ESC, MOUSE = (SimpleNamespace(type=kind) for kind in ("TIMER", "ESC", "MOUSEMOVE"))


def test_slices(context: MagicMock) -> None:
    task = Counting()
    assert task.start(context) == {"RUNNING_MODAL"}
    assert task.modal(context, MOUSE) == {"RUNNING_MODAL"}
    results = [task.modal(context, TIMER) for _ in range(11)]
    assert results[:-1] == [{"RUNNING_MODAL"}] * 10 and results[-1] == {"FINISHED"}
    shares = [call.args[0] for call in context.window_manager.progress_update.call_args_list]
    assert shares == [0, 10, 20, 30, 40, 50, 60, 70, 80, 90]
    assert context.workspace.status_text_set.call_args_list[3].args == ("Counting: 30%    Esc: cancel",)
    ended(context)


def ended(context: MagicMock) -> None:
    """Timer, progress and status are gone."""
    context.window_manager.event_timer_remove.assert_called_once_with(
        context.window_manager.event_timer_add.return_value
    )
    context.window_manager.progress_end.assert_called_once_with()
    assert context.workspace.status_text_set.call_args.args == (None,)


def test_escape(context: MagicMock) -> None:
    task = Counting()
    task.start(context)
    task.modal(context, TIMER)
    assert task.modal(context, ESC) == {"CANCELLED"}
    assert task.closed and task.reports == [("WARNING", "Cancelled; nothing was added")]
    ended(context)


def test_errors_of_users_are_reports(context: MagicMock) -> None:
    task = Counting(ValueError("choose another file"))
    task.start(context)
    assert [task.modal(context, TIMER) for _ in range(6)][-1] == {"CANCELLED"}
    assert task.reports == [("ERROR", "choose another file")]
    ended(context)
    assert Counting(OSError("no file")).execute(context) == {"CANCELLED"}


def test_other_errors_end_the_task(context: MagicMock) -> None:
    task = Counting(TypeError("a defect"))
    task.start(context)
    with pytest.raises(TypeError, match="a defect"):
        for _ in range(6):
            task.modal(context, TIMER)
    ended(context)
