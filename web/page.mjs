// Serves the folder that web/build made, and opens it in a headless Chromium.
//
// Needs playwright-core (in the folder that PLAYWRIGHT names, else resolved as usual), and Chromium (CHROMIUM, else
// /usr/bin/chromium).
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';
import { createRequire } from 'node:module';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm', '.mp4': 'video/mp4' };
// no requests to other hosts; rendering in software
const flags = [
  '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--force-color-profile=srgb',
  '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run',
];

const kept = new Map();

/** Returns a compressed file. */
function packed(file) {
  if (!kept.has(file)) kept.set(file, zlib.gzipSync(fs.readFileSync(file), { level: 6 }));
  return kept.get(file);
}

/** Starts a server and a browser; `open` opens a page, `close` ends both. Errors of pages are added to `wrong`. */
export async function studio(folder, { width = 1280, height = 800, scale = 1 } = {}) {
  const require = createRequire(process.env.PLAYWRIGHT ? path.resolve(process.env.PLAYWRIGHT, 'x') : import.meta.url);
  const { chromium } = require('playwright-core');
  const server = http.createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://page').pathname);
    response.setHeader('content-type', types[path.extname(name)] ?? 'text/html');
    if (name === '/blank') return response.end('<!doctype html><link rel="icon" href="data:,">');
    try {
      const file = path.join(folder, name.endsWith('/') ? `${name}index.html` : name);
      // films are compressed already
      if (name.endsWith('.mp4')) return response.end(fs.readFileSync(file));
      response.setHeader('content-encoding', 'gzip');
      response.end(packed(file));
    } catch {
      response.removeHeader('content-encoding');
      response.statusCode = 404;
      response.end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'throng-'));
  const browser = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true, args: flags,
    viewport: { width, height }, deviceScaleFactor: scale, acceptDownloads: true,
  });
  const wrong = [];
  return {
    wrong,
    /**
     * Opens the address with this hash; resolves when `until`, a function of `globalThis.throng`, holds. `search` is the
     * part of the address after `?`, `before` changes the page before the address is opened.
     */
    async open(hash, until, { search = '', before = async () => {} } = {}) {
      const page = await browser.newPage();
      await before(page);
      page.on('pageerror', (error) => wrong.push(`the page says: ${error.message}`));
      page.on('console', (line) => { if (line.type() === 'error') console.log(line.text()); });
      // a new user: empty storage
      const place = `http://127.0.0.1:${server.address().port}`;
      await page.goto(`${place}/blank`);
      await page.evaluate(() => localStorage.clear());
      await page.goto(`${place}/${search && `?${search}`}#${hash}`);
      await shows(page, until);
      return page;
    },
    async close() {
      await browser.close();
      server.close();
      fs.rmSync(profile, { recursive: true, force: true });
    },
  };
}

/** Returns the state of the page once `until` holds: a function of the state without references to its scope. */
export async function shows(page, until = () => true) {
  await page.waitForFunction(`globalThis.throng && (${until})(globalThis.throng)`, null, { timeout: 120_000, polling: 100 });
  return page.evaluate(() => globalThis.throng);
}

/** Presses Tab until the control with this name has the focus. */
export async function focused(page, name) {
  for (let tabs = 0; tabs < 80; tabs += 1) {
    const says = await page.evaluate(() => document.getElementById('focus').textContent);
    if (says.startsWith(`${name} `)) return;
    await page.keyboard.press('Tab');
    await page.waitForTimeout(80);
  }
  throw new Error(`Tab does not reach ${name}`);
}
