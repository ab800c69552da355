// Opens the page that web/build made in a headless Chromium, and looks at what it shows.
//
// usage: node web/test.mjs FOLDER [PICTURE.png]
//
// `circle` runs to its end: everybody has arrived, and there is something to see. Needs playwright-core (in the folder
// that PLAYWRIGHT names, else found as usual), and Chromium (CHROMIUM, else /usr/bin/chromium).
// With HASH=..., the state after 500 steps must have that hash: the program's (`throng run`, `World::state_hash`).
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { createRequire } from 'node:module';

const [folder, picture] = process.argv.slice(2);
const require = createRequire(process.env.PLAYWRIGHT ? path.resolve(process.env.PLAYWRIGHT, 'x') : import.meta.url);
const { chromium } = require('playwright-core');

const types = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
const server = http.createServer((request, response) => {
  const name = decodeURIComponent(new URL(request.url, 'http://page').pathname);
  fs.readFile(path.join(folder, name.endsWith('/') ? `${name}index.html` : name), (error, bytes) => {
    response.writeHead(error ? 404 : 200, { 'content-type': types[path.extname(name)] ?? 'text/html' });
    response.end(bytes);
  });
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const page_at = (hash) => `http://127.0.0.1:${server.address().port}/#${hash}`;

const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'throng-'));
const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--force-color-profile=srgb'];
const browser = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true, args: flags, viewport: { width: 1280, height: 800 },
});
const wrong = [];
const expect = (holds, says) => { if (!holds) wrong.push(says); };

async function open(hash, until) {
  const page = await browser.newPage();
  page.on('pageerror', (error) => wrong.push(`the page says: ${error.message}`));
  page.on('console', (line) => { if (line.type() === 'error') console.log(line.text()); });
  await page.goto(page_at(hash));
  await page.waitForFunction(until, null, { timeout: 120_000, polling: 200 });
  const state = await page.evaluate(() => globalThis.throng);
  console.log(JSON.stringify(state));
  return [page, state];
}

try {
  const [page, end] = await open('circle', () => globalThis.throng?.over);
  expect(end.agents === 36 && end.arrived === 36, `${end.arrived} of ${end.agents} arrived`);
  await page.waitForTimeout(500);
  const png = await page.screenshot(picture ? { path: picture } : {});
  // an empty page is a few kilobytes
  expect(png.length > 30_000, `the picture has only ${png.length} bytes`);
  // keys are for who has the focus
  await page.mouse.click(640, 600);
  await page.keyboard.press('r');
  await page.waitForFunction(() => globalThis.throng.step < 100, null, { timeout: 20_000 });
  await page.close();

  const [, at] = await open('circle@500', () => globalThis.throng?.step === 500);
  expect(!process.env.HASH || at.hash === process.env.HASH, `the hash after 500 steps is ${at.hash}, the program's ${process.env.HASH}`);
} finally {
  await browser.close();
  server.close();
  fs.rmSync(profile, { recursive: true, force: true });
}
wrong.forEach((says) => console.error(`wrong: ${says}`));
process.exit(wrong.length ? 1 : 0);
