"""Python values as TOML text."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from . import _geometry


def value(given: Any) -> str:
    """Returns a value as TOML writes it on one line.

    >>> value({"at": (1, 2.5), "name": "a"})
    '{ "at" = [1, 2.5], "name" = "a" }'
    """
    match given:
        case bool():
            return "true" if given else "false"
        case str():
            # a JSON text is a TOML text, except for characters beyond the basic plane
            return json.dumps(given, ensure_ascii=False)
        case int() | np.integer():
            return str(int(given))
        case float() | np.floating():
            number = float(given)
            return {"inf": "inf", "-inf": "-inf", "nan": "nan"}.get(repr(number), repr(number))
        case Mapping():
            inside = ", ".join(f"{json.dumps(str(key))} = {value(item)}" for key, item in given.items())
            return f"{{ {inside} }}" if inside else "{}"
        case _ if _geometry.is_geometry(given):
            return value(_geometry.area(given))
        case np.ndarray():
            return value(given.tolist())
        case Iterable():
            return "[" + ", ".join(value(item) for item in given) + "]"
    raise TypeError(f"a {type(given).__name__} cannot be a value of a scene: give numbers, texts, lists or dicts")


def document(given: Mapping[str, Any]) -> str:
    """Returns a table as a TOML document, with a line for each key."""
    return "".join(f"{json.dumps(str(key))} = {value(item)}\n" for key, item in given.items())
