// The page of examples/baked draws what throng wrote, in a headless Chromium: node baked.mjs BAKED.glb SKINS.glb PICTURE.png
// (the same run with `--figures baked` and `--figures skins`; few people, so that each is large in the picture).
//
// The pictures of the baked people and of the skins, which three.js bends itself, are the same.
// Needs three and playwright-core, in the folders `node_modules` that THREE and PLAYWRIGHT name (else found as usual), and Chromium
// (CHROMIUM, else /usr/bin/chromium).
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { createRequire } from 'node:module';

const [baked, skins, picture] = process.argv.slice(2);
const from = (folder) => createRequire(folder ? path.resolve(folder, 'x') : import.meta.url);
const { chromium } = from(process.env.PLAYWRIGHT)('playwright-core');
const three = path.resolve(path.dirname(from(process.env.THREE).resolve('three')), '..');
const example = path.resolve(import.meta.dirname, '../../../../examples/baked');

const kinds = { html: 'text/html', mjs: 'text/javascript', js: 'text/javascript', glb: 'application/octet-stream' };
const server = http.createServer((request, response) => {
  const name = path.normalize(new URL(request.url, 'http://page').pathname);
  const local = name === '/baked.glb' ? baked : name === '/skins.glb' ? skins : name.startsWith('/node_modules/three/') ? path.join(three, name.slice(20)) : path.join(example, name);
  response.setHeader('content-type', kinds[name.split('.').at(-1)] ?? 'text/plain');
  fs.createReadStream(local).on('error', () => response.writeHead(404).end()).pipe(response);
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));

const check = (holds, what) => { if (!holds) throw new Error(JSON.stringify(what)); };
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking'],
});
try {
  const page = await browser.newPage({ viewport: { width: 800, height: 450 } });
  const wrong = [];
  page.on('pageerror', (error) => wrong.push(error.message));
  page.on('console', (line) => { if (line.type() === 'error' && !line.text().includes('favicon')) wrong.push(line.text()); });
  await page.goto(`http://127.0.0.1:${server.address().port}/index.html?file=baked.glb`);
  await page.waitForFunction(() => globalThis.page, null, { timeout: 60000 }).catch((error) => { throw new Error(wrong.join() || error); });
  const { people, share, duration, triangles, calls } = await page.evaluate(async () => {
    const { scene, world, camera, controls, renderer, crowd } = globalThis.page, { duration } = crowd;
    renderer.setAnimationLoop(null);
    // all people in the level of skins, the finest
    crowd.levels[0] = Infinity;
    const { center } = crowd.ball(0.5 * duration);
    controls.target.copy(center);
    camera.position.copy(center).add({ x: -3, y: 3, z: 9 });
    const pixels = () => {
      const gl = renderer.getContext(), data = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, data);
      return data;
    };
    const people = globalThis.page.draw(0.5 * duration), { triangles, calls } = renderer.info.render, ofBaked = pixels();
    crowd.visible = false;
    globalThis.page.draw(0.5 * duration);
    const ofNothing = pixels();
    const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js'), { AnimationMixer } = await import('three');
    const gltf = await new GLTFLoader().loadAsync('skins.glb'), mixer = new AnimationMixer(gltf.scene);
    mixer.clipAction(gltf.animations[0]).play();
    mixer.setTime(0.5 * duration);
    gltf.scene.traverse((node) => { node.frustumCulled = false; });
    scene.remove(world);
    scene.add(gltf.scene);
    globalThis.page.draw(0.5 * duration);
    const ofSkins = pixels(), far = (a, b, k) => Math.max(...[0, 1, 2].map((part) => Math.abs(a[k + part] - b[k + part]))) > 24;
    let [different, covered] = [0, 0];
    for (let k = 0; k < ofSkins.length; k += 4) {
      covered += far(ofSkins, ofNothing, k);
      different += far(ofSkins, ofBaked, k);
    }
    scene.remove(gltf.scene);
    scene.add(world);
    crowd.visible = true;
    globalThis.page.draw(0.5 * duration);
    return { people, share: different / covered, duration, triangles, calls };
  });
  await page.screenshot({ path: picture });
  check(wrong.filter((line) => !line.includes('404')).length === 0, wrong);
  // the edges of bodies fall on other pixels where a joint is off by millimetres
  check(people > 0 && share < 0.03, { people, share });
  console.log(`${people} baked people after ${(duration / 2).toFixed(1)} s: ${calls} draw calls, ${triangles} triangles; ${(100 * share).toFixed(2)} % of the `
    + 'pixels of people differ from the skins of three.js');
} finally {
  await browser.close();
  server.close();
}
