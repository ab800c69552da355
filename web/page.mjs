// Serves the folder that web/build made, and opens it in a headless Chromium.
//
// Needs playwright-core (in the folder that PLAYWRIGHT names, else resolved as usual), and Chromium (CHROMIUM, else
// /usr/bin/chromium).
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { createRequire } from 'node:module';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
// no requests to other hosts; rendering in software
const flags = [
  '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--force-color-profile=srgb',
  '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run',
];

/** Starts a server and a browser; `open` opens a page, `close` ends both. Errors of pages are added to `wrong`. */
export async function studio(folder, { width = 1280, height = 800, scale = 1 } = {}) {
  const require = createRequire(process.env.PLAYWRIGHT ? path.resolve(process.env.PLAYWRIGHT, 'x') : import.meta.url);
  const { chromium } = require('playwright-core');
  const server = http.createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://page').pathname);
    response.setHeader('content-type', types[path.extname(name)] ?? 'text/html');
    if (name === '/blank') return response.end('<!doctype html>');
    fs.readFile(path.join(folder, name.endsWith('/') ? `${name}index.html` : name), (error, bytes) => {
      response.statusCode = error ? 404 : 200;
      response.end(bytes);
    });
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
    /** Opens the address with this hash; resolves when `until`, a function of `globalThis.throng`, holds. */
    async open(hash, until) {
      const page = await browser.newPage();
      page.on('pageerror', (error) => wrong.push(`the page says: ${error.message}`));
      page.on('console', (line) => { if (line.type() === 'error') console.log(line.text()); });
      // a new user: empty storage
      const place = `http://127.0.0.1:${server.address().port}`;
      await page.goto(`${place}/blank`);
      await page.evaluate(() => localStorage.clear());
      await page.goto(`${place}/#${hash}`);
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
