// three.js plays what throng wrote, in a headless Chromium: node glb.mjs RUN.glb RUN.csv PICTURE.png (of the same run).
//
// Needs three and playwright-core, in the folders `node_modules` that THREE and PLAYWRIGHT name (else found as usual), and Chromium
// (CHROMIUM, else /usr/bin/chromium). The picture is of the middle moment.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { createRequire } from 'node:module';

const [glb, table, picture] = process.argv.slice(2);
const from = (folder) => createRequire(folder ? path.resolve(folder, 'x') : import.meta.url);
const { chromium } = from(process.env.PLAYWRIGHT)('playwright-core');
const three = path.resolve(path.dirname(from(process.env.THREE).resolve('three')), '..');

const page = `<!doctype html><body style="margin:0"><script type="importmap">
{ "imports": { "three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/" } }</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
const gltf = await new GLTFLoader().loadAsync('/run.glb');
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xdfe6ee);
scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0x8888aa, 2));
const sun = new THREE.DirectionalLight(0xffffff, 2.5);
sun.position.set(-3, 10, 4);
scene.add(sun);
const mixer = new THREE.AnimationMixer(gltf.scene);
for (const clip of gltf.animations) {
  const action = mixer.clipAction(clip);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
}
const agents = [];
gltf.scene.traverse((node) => { if (node.userData.number !== undefined) agents.push(node); });
globalThis.run = {
  agents: agents.length,
  lasts: Math.max(...gltf.animations.map((clip) => clip.duration)),
  tracks: gltf.animations[0].tracks.length,
  /** Where everybody is after so many seconds, and which way it faces, in the scene's axes. */
  at(second) {
    mixer.setTime(second);
    gltf.scene.updateMatrixWorld(true);
    return agents.map((node) => {
      const [place, turn, scale] = [new THREE.Vector3(), new THREE.Quaternion(), new THREE.Vector3()];
      node.matrixWorld.decompose(place, turn, scale);
      const ahead = new THREE.Vector3(0, 0, 1).applyQuaternion(node.quaternion);
      return { ...node.userData, place: [place.x, -place.z, place.y], ahead: [ahead.x, -ahead.z, ahead.y], there: node.scale.x > 0 };
    });
  },
  picture(second) {
    const places = this.at(second).filter(({ there }) => there).map(({ place: [x, y, z] }) => new THREE.Vector3(x, z, -y));
    const box = new THREE.Box3().setFromPoints(places), middle = box.getCenter(new THREE.Vector3());
    const wide = places.map((place) => place.distanceTo(middle)).sort((a, b) => a - b)[places.length >> 1] + 2;
    const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.1, 1000);
    camera.position.copy(middle).add(new THREE.Vector3(-0.4, 1.1, 1.6).multiplyScalar(wide));
    camera.lookAt(middle);
    const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setSize(innerWidth, innerHeight);
    document.body.append(renderer.domElement);
    renderer.render(scene, camera);
    return renderer.info.render.triangles;
  },
};
</script>`;

const server = http.createServer((request, response) => {
  const name = new URL(request.url, 'http://page').pathname;
  const file = name === '/run.glb' ? glb : name.startsWith('/three/') ? path.join(three, path.normalize(name.slice(6))) : null;
  if (!file) return response.setHeader('content-type', 'text/html').end(name === '/' ? page : '');
  response.setHeader('content-type', name.endsWith('.js') ? 'text/javascript' : 'application/octet-stream');
  fs.createReadStream(file).on('error', () => response.writeHead(404).end()).pipe(response);
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));

const [head, ...lines] = fs.readFileSync(table, 'utf8').trim().split(/\r?\n/).map((line) => line.split(','));
const moments = new Map();
for (const line of lines) {
  const row = Object.fromEntries(head.map((name, k) => [name, line[k]]));
  if (!moments.has(Number(row.time))) moments.set(Number(row.time), new Map());
  moments.get(Number(row.time)).set(Number(row.number), row);
}
const times = [...moments.keys()].sort((a, b) => a - b);

/** The seconds of the animation are singles. */
const seconds = (time) => Math.fround(time - times[0]);
const check = (holds, what) => { if (!holds) throw new Error(JSON.stringify(what)); };
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking'],
});
try {
  const view = await browser.newPage({ viewport: { width: 800, height: 450 } });
  const wrong = [];
  view.on('pageerror', (error) => wrong.push(error.message));
  view.on('console', (line) => { if (line.type() === 'error' || line.type() === 'warning') console.log(line.text()); });
  await view.goto(`http://127.0.0.1:${server.address().port}/`);
  await view.waitForFunction(() => globalThis.run, null, { timeout: 60000 }).catch((error) => { throw new Error(wrong.join() || error); });
  let compared = 0, worst = 0;
  for (let k = 0; k < times.length; k += Math.max(1, Math.floor(times.length / 40))) {
    const there = moments.get(times[k]);
    for (const agent of await view.evaluate((second) => globalThis.run.at(second), seconds(times[k]))) {
      const row = there.get(agent.number);
      check(agent.there === Boolean(row), { time: times[k], agent, row });
      if (!row) continue;
      const off = Math.hypot(agent.place[0] - row.x, agent.place[1] - row.y, agent.place[2] - (row.z ?? 0));
      const turn = Math.atan2(agent.ahead[1], agent.ahead[0]) - row.heading;
      const turned = Math.abs(Math.atan2(Math.sin(turn), Math.cos(turn))) * Math.hypot(agent.ahead[0], agent.ahead[1]);
      check(off < 2e-3 && turned < 0.01 && agent.group === row.group, { time: times[k], agent, row, off, turned });
      compared += 1;
      worst = Math.max(worst, off);
    }
  }
  const { agents, lasts, tracks } = await view.evaluate(() => ({ agents: run.agents, lasts: run.lasts, tracks: run.tracks }));
  const middle = times[times.length >> 1];
  const triangles = await view.evaluate((second) => globalThis.run.picture(second), seconds(middle));
  await view.screenshot({ path: picture });
  check(wrong.length === 0, wrong);
  console.log(`${agents} agents, ${tracks} tracks, ${lasts.toFixed(2)} s; ${compared} places within ${(1e3 * worst).toFixed(2)} mm; ${triangles} triangles`);
} finally {
  await browser.close();
  server.close();
}
