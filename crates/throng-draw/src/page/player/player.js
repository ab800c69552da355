"use strict";
// The player: all runs on one clock, which starts at data.start. Words of trajectories are described in tracks.rs.
const data = JSON.parse(document.getElementById("data").textContent);
const { tracks, place, view } = data;
const slots = tracks.radius.length;
const find = id => document.getElementById(id);
const runs = tracks.runs.map(run => {
  const bytes = Uint8Array.from(atob(run.words), c => c.charCodeAt(0));
  return { ...run, words: new Uint32Array(bytes.buffer) };
});
const end = Math.max(...runs.map(run => run.end));
const panels = [...document.querySelectorAll(".panel")].map((element, k) => ({
  run: runs[k], canvas: element.querySelector("canvas"), says: element.querySelector("span"), ground: null,
}));
// plots over time
const timed = [...document.querySelectorAll(".plot svg[data-end]")];
let time = 0, playing = false, trails = true, speed = 1, last = null;
let colors = {};

// Where frames are.
const frameTime = (run, k) => k >= run.frames - 1 ? run.end : k * tracks.seconds;
function frameAt(run, t) {
  if (t >= run.end) return [run.frames - 1, 0];
  const k = Math.min(Math.floor(t / tracks.seconds + 1e-6), run.frames - 1);
  const length = frameTime(run, k + 1) - frameTime(run, k);
  return [k, length > 0 ? Math.min(Math.max((t - frameTime(run, k)) / length, 0), 1) : 0];
}
const word = (run, k, slot) => run.words[Math.min(k, run.frames - 1) * slots + slot];
const wordX = w => (w & 4095) * tracks.quantum + tracks.corner[0];
const wordY = w => (w >>> 12 & 4095) * tracks.quantum + tracks.corner[1];
const wordTurn = w => (w >>> 24 & 63) / 64 * 2 * Math.PI;
const wordStatus = w => w >>> 30;

// The picture is as large as the panel is wide; y points up in the world and down on the canvas.
function fit(panel) {
  const [x0, y0, x1, y1] = view, canvas = panel.canvas, ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, shape = (y1 - y0) / (x1 - x0);
  // all rows and the controls are on the screen at once, unless that makes them small
  const rows = Math.ceil(panels.length / data.columns), room = Math.max(0.78 * window.innerHeight / rows - 36, 240);
  const height = Math.round(Math.min(Math.max((width - 24) * shape + 24, 60), width, room));
  canvas.style.height = height + "px";
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const edge = 12 * ratio;
  const scale = Math.min((canvas.width - 2 * edge) / (x1 - x0), (canvas.height - 2 * edge) / (y1 - y0));
  panel.scale = scale;
  panel.x = x => canvas.width / 2 + (x - (x0 + x1) / 2) * scale;
  panel.y = y => canvas.height / 2 - (y - (y0 + y1) / 2) * scale;
  panel.unit = ratio;
  panel.ground = paintGround(panel);
}

function path(context, panel, rings, closed) {
  context.beginPath();
  for (const ring of rings) {
    ring.forEach(([x, y], k) => k ? context.lineTo(panel.x(x), panel.y(y)) : context.moveTo(panel.x(x), panel.y(y)));
    if (closed) context.closePath();
  }
}

// What does not move.
function paintGround(panel) {
  const ground = document.createElement("canvas");
  [ground.width, ground.height] = [panel.canvas.width, panel.canvas.height];
  const context = ground.getContext("2d"), unit = panel.unit;
  context.fillStyle = place.walkable.length ? colors.outside : colors.card;
  context.fillRect(0, 0, ground.width, ground.height);
  context.lineJoin = context.lineCap = "round";
  for (const rings of place.walkable) {
    path(context, panel, rings, true);
    context.fillStyle = colors.card;
    context.fill("evenodd");
    [context.strokeStyle, context.lineWidth] = [colors.edge, 1.2 * unit];
    context.stroke();
  }
  for (const [kind, tint] of [["areas", 0.1], ["exits", 0.24]]) for (const ring of place[kind]) {
    path(context, panel, [ring], true);
    context.fillStyle = context.strokeStyle = colors.goal;
    context.globalAlpha = tint;
    context.fill();
    context.globalAlpha = 0.8;
    context.setLineDash([4 * unit, 4 * unit]);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  }
  for (const [kind, closed] of [["marked", true], ["counted", false]]) for (const ring of place[kind]) {
    path(context, panel, [ring], closed);
    [context.strokeStyle, context.lineWidth] = [colors.accent, 1.5 * unit];
    context.setLineDash(closed ? [5 * unit, 4 * unit] : []);
    context.stroke();
    context.setLineDash([]);
  }
  context.lineWidth = unit;
  for (const [x, y, r] of place.circles) {
    context.beginPath();
    context.arc(panel.x(x), panel.y(y), r * panel.scale, 0, 7);
    [context.fillStyle, context.strokeStyle] = [colors.obstacle, colors.edge];
    context.fill();
    context.stroke();
  }
  for (const ring of place.polygons) {
    path(context, panel, [ring], true);
    [context.fillStyle, context.strokeStyle] = [colors.obstacle, colors.edge];
    context.fill();
    context.stroke();
  }
  for (const line of place.walls) {
    path(context, panel, [line], false);
    [context.strokeStyle, context.lineWidth] = [colors.edge, 2 * unit];
    context.stroke();
  }
  const many = place.points.length > 40;
  context.globalAlpha = many ? 0.35 : 0.8;
  context.strokeStyle = colors.goal;
  context.lineWidth = unit;
  for (const [x, y, r] of place.points) {
    context.beginPath();
    context.arc(panel.x(x), panel.y(y), Math.max(Math.min(r, 0.3) * panel.scale, 2 * unit), 0, 7);
    context.stroke();
  }
  return ground;
}

// Where an agent is between two frames; null where it is not.
function agent(run, k, part, slot) {
  const a = word(run, k, slot);
  if (!wordStatus(a)) return null;
  const b = word(run, k + 1, slot), gone = !wordStatus(b), t = gone ? 0 : part;
  const mix = (from, to) => from + (to - from) * t;
  let turned = gone ? 0 : wordTurn(b) - wordTurn(a);
  turned -= Math.round(turned / (2 * Math.PI)) * 2 * Math.PI;
  return {
    x: mix(wordX(a), wordX(b)), y: mix(wordY(a), wordY(b)), heading: wordTurn(a) + turned * t, status: wordStatus(a),
  };
}

function paintTrails(context, panel, now, k) {
  const run = panel.run, pieces = 12, first = Math.max(0, now - data.trails);
  const step = Math.max(1, Math.round(data.trails / tracks.seconds / pieces));
  const byGroup = data.colors.map(() => []);
  for (let slot = 0; slot < slots; slot++) byGroup[tracks.group[slot] % byGroup.length].push(slot);
  context.lineCap = "butt";
  for (let to = k; to > 0 && frameTime(run, to) > first; to -= step) {
    const from = Math.max(0, to - step), fresh = 1 - (now - frameTime(run, to)) / data.trails;
    context.globalAlpha = 0.45 * fresh * Math.sqrt(Math.max(fresh, 0));
    byGroup.forEach((members, group) => {
      context.strokeStyle = data.colors[group];
      context.beginPath();
      let width = 1;
      for (const slot of members) {
        const a = word(run, from, slot), b = word(run, to, slot);
        if (!wordStatus(a) || !wordStatus(b)) continue;
        width = Math.max(width, tracks.radius[slot] * panel.scale * (0.3 + 0.5 * fresh));
        context.moveTo(panel.x(wordX(a)), panel.y(wordY(a)));
        context.lineTo(panel.x(wordX(b)), panel.y(wordY(b)));
      }
      context.lineWidth = width;
      context.stroke();
    });
  }
  context.globalAlpha = 1;
}

function paint(panel) {
  const { canvas, run } = panel, context = canvas.getContext("2d"), now = Math.min(time, run.end);
  const [k, part] = frameAt(run, time);
  context.globalAlpha = 1;
  context.drawImage(panel.ground, 0, 0);
  if (trails && data.trails > 0) paintTrails(context, panel, now, k);
  for (let slot = 0; slot < slots; slot++) {
    const one = agent(run, k, part, slot);
    if (!one) continue;
    const x = panel.x(one.x), y = panel.y(one.y), r = Math.max(tracks.radius[slot] * panel.scale, 1.5 * panel.unit);
    // half extents of what is rounded; zero for a disc
    const [length, width] = tracks.core[slot].map(metres => metres * panel.scale), girth = r + Math.min(length, width);
    const [c, s] = [Math.cos(one.heading), -Math.sin(one.heading)];
    const color = data.colors[tracks.group[slot] % data.colors.length] || colors.goal, edge = Math.min(Math.max(0.13 * r, 0.6), 3);
    context.beginPath();
    if (length + width === 0) context.arc(x, y, Math.max(r - edge / 2, 0.5), 0, 7);
    else {
      const inner = Math.max(r - edge / 2, 0.5);
      context.setTransform(c, s, -s, c, x, y);
      context.roundRect(-length - inner, -width - inner, 2 * (length + inner), 2 * (width + inner), inner);
      context.setTransform(1, 0, 0, 1, 0, 0);
    }
    if (one.status === 2) {
      // those who have arrived step back
      context.fillStyle = colors.card;
      context.fill();
      context.globalAlpha = 0.45;
    }
    context.fillStyle = one.status === 3 ? colors.card : color;
    context.strokeStyle = one.status === 3 ? color : colors.rim;
    context.lineWidth = edge;
    context.fill();
    if (girth > 3) {
      context.globalAlpha *= one.status === 3 ? 1 : 0.5;
      context.stroke();
    }
    context.globalAlpha = one.status === 2 ? 0.5 : 0.92;
    if (girth > 3.5 * panel.unit && one.status !== 3) {
      const front = length - Math.min(length, width), from = front + 0.36 * girth, to = front + 0.82 * girth;
      context.beginPath();
      context.moveTo(x + from * c, y + from * s);
      context.lineTo(x + to * c, y + to * s);
      [context.strokeStyle, context.lineWidth, context.lineCap] = [colors.notch, 0.28 * girth, "round"];
      context.stroke();
    }
    context.globalAlpha = 1;
  }
  const there = run.arrived[Math.min(k, run.frames - 1)], all = data.agents;
  panel.says.textContent = `${there} of ${all} ${data.gone} · ${clock(now)}`;
  panel.says.className = time >= run.end ? "done" : "";
}

// The clock.
const clock = t => (t + data.start).toFixed(2) + " s";
function show() {
  panels.forEach(paint);
  find("clock").value = end > 0 ? time / end : 0;
  find("time").textContent = clock(time);
  find("play").textContent = playing ? "pause" : "play";
  timed.forEach(plot => {
    const { left, right, start, end } = plot.dataset, x = +left + (time + data.start - start) / (end - start) * (right - left);
    plot.querySelector(".now").setAttribute("transform", `translate(${x - left} 0)`);
  });
}
function set(t) {
  time = Math.min(Math.max(t, 0), end);
  show();
}
function tick(stamp) {
  if (!playing) return;
  if (last !== null) time += Math.min(stamp - last, 250) / 1000 * speed;
  last = stamp;
  if (time >= end) playing = false;
  set(time);
  if (playing) requestAnimationFrame(tick);
}
function play(on) {
  playing = on;
  last = null;
  if (on && time >= end) time = 0;
  if (on) requestAnimationFrame(tick);
  show();
}
function step(count) {
  play(false);
  set((Math.round(time / tracks.seconds) + count) * tracks.seconds);
}
find("play").onclick = () => play(!playing);
find("back").onclick = () => step(-1);
find("forth").onclick = () => step(1);
find("clock").oninput = event => set(event.target.value * end);
find("speed").onchange = event => { speed = +event.target.value; };
find("trails").onchange = event => { trails = event.target.checked; show(); };
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
  const keys = {
    " ": () => play(!playing), ArrowLeft: () => step(-1), ArrowRight: () => step(1),
    Home: () => set(0), End: () => set(end), t: () => find("trails").click(),
  };
  const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (act) {
    event.preventDefault();
    act();
  }
});
timed.forEach(plot => {
  const seek = event => {
    const box = plot.getBoundingClientRect(), { left, right, start, end } = plot.dataset;
    const x = (event.clientX - box.left) / box.width * plot.viewBox.baseVal.width;
    set(+start + (x - left) / (right - left) * (end - start) - data.start);
  };
  plot.addEventListener("pointerdown", event => { play(false); seek(event); });
  plot.addEventListener("pointermove", event => { if (event.buttons & 1) seek(event); });
});

// page.html#t=12.5 opens at 12.5 s; #t=12.5&play plays from there.
function fromHash() {
  const parts = new URLSearchParams(location.hash.slice(1)), t = parseFloat(parts.get("t"));
  if (Number.isFinite(t)) set(t);
  if (parts.has("play")) play(true);
}
function dress() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["card", "outside", "obstacle", "edge", "goal", "notch", "rim", "accent"]) colors[name] = style.getPropertyValue("--" + name).trim();
  panels.forEach(fit);
  show();
}
document.querySelector(".panels").style.setProperty("--columns", data.columns);
if (data.groups.length > 1) data.groups.slice(0, 12).forEach((name, k) => {
  const entry = document.createElement("span"), dot = document.createElement("i");
  dot.style.background = data.colors[k];
  entry.append(dot, name);
  document.querySelector(".groups").append(entry);
});
let waiting = null;
const again = () => { cancelAnimationFrame(waiting); waiting = requestAnimationFrame(dress); };
new ResizeObserver(again).observe(document.querySelector(".panels"));
addEventListener("resize", again);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", dress);
addEventListener("hashchange", fromHash);
dress();
fromHash();
