"""Statistics of a run."""

from __future__ import annotations

from typing import Any


class Summary(dict[str, Any]):
    """Statistics by name, which are also attributes.

    >>> Summary(agents=3, arrived=3).arrived
    3
    """

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no statistic `{name}`; there are: {', '.join(self)}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]
