"""A live view of a world in a notebook."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _throng

if TYPE_CHECKING:
    from ._world import World

SCRIPT = """
function render({ model, el }) {
  const canvas = document.createElement("canvas");
  const button = document.createElement("button");
  const clock = document.createElement("span");
  canvas.style.width = "100%";
  button.textContent = "play";
  button.style.marginRight = "1em";
  el.append(canvas, document.createElement("br"), button, clock);
  const draw = () => {
    const view = model.get("frame");
    const [x0, y0, x1, y1] = model.get("bounds");
    const width = canvas.clientWidth || 800;
    const scale = width / (x1 - x0);
    const ratio = window.devicePixelRatio || 1;
    canvas.width = width * ratio;
    canvas.height = (y1 - y0) * scale * ratio;
    const pen = canvas.getContext("2d");
    pen.setTransform(scale * ratio, 0, 0, -scale * ratio, -x0 * scale * ratio, y1 * scale * ratio);
    const rows = new Float32Array(view.buffer, view.byteOffset, view.byteLength / 4);
    const palette = model.get("palette");
    for (let k = 0; k + 4 < rows.length; k += 5) {
      const [x, y, heading, radius, group] = rows.subarray(k, k + 5);
      pen.fillStyle = palette[group % palette.length];
      pen.beginPath();
      pen.arc(x, y, radius, 0, 2 * Math.PI);
      pen.fill();
      pen.strokeStyle = "#222";
      pen.lineWidth = 0.2 * radius;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + radius * Math.cos(heading), y + radius * Math.sin(heading));
      pen.stroke();
    }
    clock.textContent = model.get("time").toFixed(2) + " s";
  };
  let wanted = false;
  let timer = 0;
  const next = () => { if (wanted) { model.send({ step: true }); } };
  button.onclick = () => {
    wanted = !wanted;
    button.textContent = wanted ? "pause" : "play";
    next();
  };
  model.on("change:frame", () => { draw(); clearTimeout(timer); timer = setTimeout(next, 15); });
  draw();
  return () => { wanted = false; clearTimeout(timer); };
}
export default { render };
"""


def frame(world: World) -> bytes:
    """Returns x, y, heading, radius and group of each agent as float32."""
    columns = [*world.positions.T, world.headings, world.radii, world.groups]
    return np.stack([np.asarray(column, dtype=np.float32) for column in columns], axis=1).tobytes()


def widget(world: World) -> Any:
    """Returns a widget that plays a world, a frame of 0.04 s at a time."""
    try:
        import anywidget
        import traitlets
    except ImportError:
        raise ImportError("a live view needs anywidget: pip install anywidget") from None

    steps = max(round(0.04 / world.dt), 1)

    class WorldWidget(anywidget.AnyWidget):
        _esm = SCRIPT
        frame = traitlets.Bytes().tag(sync=True)
        time = traitlets.Float().tag(sync=True)
        bounds: Any = traitlets.List().tag(sync=True)
        palette = traitlets.List(_throng.palette(12)).tag(sync=True)

    shown = WorldWidget(frame=frame(world), time=world.time, bounds=world.bounds.ravel().tolist())

    def answer(_: Any, content: dict[str, Any], __: Any) -> None:
        if content.get("step") and not world.finished:
            world.step(steps)
            # the time is sent first: the frame draws both
            shown.time = world.time
            shown.frame = frame(world)

    shown.on_msg(answer)
    return shown
