// The page of examples/baked draws what throng wrote, in a headless Chromium: node baked.mjs RUN.glb PICTURE.png
//
// Needs three and playwright-core, in the folders `node_modules` that THREE and PLAYWRIGHT name (else found as usual), and Chromium
// (CHROMIUM, else /usr/bin/chromium). The picture shows the middle of the run.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { createRequire } from 'node:module';

const [glb, picture] = process.argv.slice(2);
const from = (folder) => createRequire(folder ? path.resolve(folder, 'x') : import.meta.url);
const { chromium } = from(process.env.PLAYWRIGHT)('playwright-core');
const three = path.resolve(path.dirname(from(process.env.THREE).resolve('three')), '..');
const example = path.resolve(import.meta.dirname, '../../../../examples/baked');

const kinds = { html: 'text/html', mjs: 'text/javascript', js: 'text/javascript', glb: 'application/octet-stream' };
const server = http.createServer((request, response) => {
  const name = path.normalize(new URL(request.url, 'http://page').pathname);
  const local = name === '/run.glb' ? glb : name.startsWith('/node_modules/three/') ? path.join(three, name.slice(20)) : path.join(example, name);
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
  await page.goto(`http://127.0.0.1:${server.address().port}/index.html?file=run.glb`);
  await page.waitForFunction(() => globalThis.crowd, null, { timeout: 60000 }).catch((error) => { throw new Error(wrong.join() || error); });
  const { people, there, duration, triangles, calls } = await page.evaluate(() => {
    globalThis.paused = true;
    const there = crowd.draw(crowd.duration / 2);
    return { people: crowd.people, there, duration: crowd.duration, triangles: crowd.info.render.triangles, calls: crowd.info.render.calls };
  });
  await page.screenshot({ path: picture });
  check(wrong.filter((line) => !line.includes('404')).length === 0, wrong);
  check(there > 0 && triangles > 200 * there * 0.5, { people, there, triangles });
  console.log(`${people} baked people, ${there} of them after ${(duration / 2).toFixed(1)} s; ${calls} draw calls, ${triangles} triangles`);
} finally {
  await browser.close();
  server.close();
}
