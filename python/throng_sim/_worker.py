"""A model in Python for the program: `python -m throng_sim._worker FILE [NAME]`.

The program runs the world. It writes what the agents see to standard input, once a sub-step, and reads their velocities
from standard output. Numbers have the byte order of the machine.

At the start the worker writes a line of JSON: the number of this protocol and the options of the model, or `{"error": ".."}`.
The program writes a head (`HEAD`) and the arrays (`ARRAYS`). The worker answers with a byte 0 and a velocity for each agent, two
`float32`, or with a byte 1, the length of a text (`uint32`), and the text, which says what went wrong.
"""

from __future__ import annotations

import importlib.util
import json
import math
import os
import signal
import struct
import sys
import traceback
from pathlib import Path
from types import SimpleNamespace
from typing import Any, BinaryIO

import numpy as np

from ._model import Model, model

PROTOCOL = 1
"""The program refuses a worker with another number."""

HEAD = struct.Struct("=QQQdf")
"""The numbers of agents, neighbours and walls; the time and the duration of the sub-step, seconds."""

ARRAYS = [
    ("ids", "u4", "agents", ()),
    ("positions", "f8", "agents", (2,)),
    ("velocities", "f4", "agents", (2,)),
    ("preferred", "f4", "agents", (2,)),
    ("radii", "f4", "agents", ()),
    ("max_speeds", "f4", "agents", ()),
    ("headings", "f4", "agents", ()),
    ("near_start", "i8", "ends", ()),
    ("near_ids", "u4", "near", ()),
    ("near_offsets", "f4", "near", (2,)),
    ("near_velocities", "f4", "near", (2,)),
    ("near_radii", "f4", "near", ()),
    ("near_shares", "f4", "near", ()),
    ("wall_start", "i8", "ends", ()),
    ("walls", "f4", "walls", (4,)),
]
"""Name, type, what there is a row for, and shape of a row. `ends`: a row for each agent, and one more."""


def main(arguments: list[str]) -> None:
    """Serves the model of a file until the input ends."""
    # what the model prints is not an answer
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    # at the first Ctrl-C the program completes its files, and closes the input
    signal.signal(signal.SIGINT, lambda *_: signal.signal(signal.SIGINT, signal.SIG_DFL))
    path = Path(arguments[0])
    try:
        served = find(path, *arguments[1:])
    except Exception as error:
        say(answers, {"error": told(error, path)})
        return
    options = {"sees": served.sees, "reach": served.reach, "neighbors": served.neighbors}
    say(answers, {"protocol": PROTOCOL, **options})
    while (view := read(sys.stdin.buffer)) is not None:
        try:
            velocities = served.called(view)
        except Exception as error:
            text = told(error, path).encode()
            answers.write(b"\1" + struct.pack("=I", len(text)) + text)
        else:
            answers.write(b"\0" + velocities.astype("f4").tobytes())
        answers.flush()


def say(answers: BinaryIO, line: dict[str, Any]) -> None:
    """Writes the first line."""
    answers.write(json.dumps(line).encode() + b"\n")
    answers.flush()


def find(path: Path, name: str | None = None) -> Model:
    """Returns the model of a file: the one with this name, or the only one."""
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is not a file of Python")
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    models = {key: value for key, value in vars(module).items() if isinstance(value, Model)}
    if name is not None:
        if not callable(given := getattr(module, name, None)):
            raise LookupError(f"{path} has no model `{name}`{_which(models)}")
        return given if isinstance(given, Model) else model(given)
    if not models:
        raise LookupError(f"{path} has no model: write @throng_sim.model above the function that chooses velocities")
    if len(models) > 1:
        raise LookupError(f"{path} has several models: name one, {path}:{next(iter(models))}{_which(models)}")
    return next(iter(models.values()))


def _which(models: dict[str, Model]) -> str:
    return f"; its models are {', '.join(models)}" if models else ""


def read(stream: BinaryIO) -> SimpleNamespace | None:
    """Reads what the agents see; `None` at the end of the input."""
    head = stream.read(HEAD.size)
    if len(head) < HEAD.size:
        return None
    agents, near, walls, time, dt = HEAD.unpack(head)
    rows = {"agents": agents, "ends": agents + 1, "near": near, "walls": walls}
    view = SimpleNamespace(time=time, dt=dt)
    for name, kind, of, shape in ARRAYS:
        size = rows[of] * math.prod(shape) * np.dtype(kind).itemsize
        # arrays of a bytearray can be written, as those of the package
        data = bytearray(stream.read(size))
        if len(data) < size:
            return None
        array = np.frombuffer(data, kind).reshape(rows[of], *shape)
        setattr(view, name, array)
    return view


def told(error: BaseException, path: Path) -> str:
    """Returns what an error says, and the line of the user's file that it comes from."""
    told = traceback.TracebackException.from_exception(error)
    text = "".join(told.format_exception_only()).strip()
    places = [frame for frame in told.stack if Path(frame.filename).resolve() == path.resolve()]
    return f"{text}\nin {path}, line {places[-1].lineno}: {places[-1].line}" if places else text


if __name__ == "__main__":
    main(sys.argv[1:])
