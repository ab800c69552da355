// Makes the pictures of docs/studio.md: operates the page that web/build made in a headless Chromium.
//
// usage: node web/pictures.mjs FOLDER [OUT_DIR]      (default: docs/studio; requirements: see page.mjs)
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { shows, studio } from './page.mjs';

const [folder, out = fileURLToPath(new URL('../docs/studio', import.meta.url))] = process.argv.slice(2);
const { wrong, open, close } = await studio(folder, { width: 1280, height: 720 });
fs.mkdirSync(out, { recursive: true });

/** Opens an address, acts on the page, and writes a screenshot. */
async function picture(name, address, act = async () => {}) {
  const page = await open(address);
  const step = Number(address.split('@')[1]?.split('&')[0] ?? 0);
  await page.waitForFunction((step) => globalThis.throng.step === step, step, { timeout: 120_000 });
  await page.waitForTimeout(1500);
  await act(page);
  await page.mouse.move(640, 715);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: path.join(out, `${name}.png`) });
  await page.close();
  console.log(name);
}

async function drag(page, points) {
  await page.mouse.move(...points[0]);
  await page.mouse.down();
  for (const point of points.slice(1)) await page.mouse.move(...point, { steps: 8 });
  await page.mouse.up();
}

const bare = 'panels.gallery=false&panels.summary=false';

await picture('start', 'street@225&start');
await picture('gallery', 'doorway@150', async (page) => {
  await page.mouse.click(120, 58);
  await page.keyboard.type('boids');
});
await picture('annotations', `circle@95&select=0&${bare}&panels.why=true`, async (page) => {
  // moves the window aside by its title bar, then zooms into the ring
  await drag(page, [[583, 81], [400, 84], [353, 84]]);
  await page.mouse.move(1150, 400);
  await page.mouse.wheel(0, 200);
});
await picture('boids', `boids-in-sphere@400&${bare}&dark=true&select=3`, async (page) => {
  await page.mouse.move(660, 360);
  await page.mouse.wheel(0, -60);
});
await picture('swarm', `swarm-aggregation@250&${bare}&dark=true&trails=0.2`, async (page) => {
  await page.mouse.move(655, 330);
  await page.mouse.wheel(0, -330);
});
await picture('heat', `gathering@400&${bare}&layers.heat=Density`);
await picture('beside', `circle@110&beside=rvo&${bare}`);
await picture('painting', `field-paint@0&${bare}&layers.streams=Arrows&layers.stream_speed=true`, async (page) => {
  await page.mouse.click(640, 60);
  await page.keyboard.press('q');
  await drag(page, [[420, 620], [520, 560], [640, 600], [760, 520], [860, 440]]);
  await shows(page, (now) => now.unsaved);
  await page.keyboard.press('Space');
  await shows(page, (now) => now.step > 60);
  await page.keyboard.press('Space');
});
await picture('filming', `circle@20&${bare}&camera=orbit`, async (page) => {
  for (const [to, steps] of [[660, 40], [760, 60], [560, 0]]) {
    await page.keyboard.press('Insert');
    for (let step = 0; step < steps; step += 1) await page.keyboard.press('ArrowRight');
    await drag(page, [[660, 300], [to, 310]]);
  }
});
await picture('plots', `doorway@0&${bare}&panels.plots=true`, async (page) => {
  await page.mouse.click(640, 300);
  await page.keyboard.press('Space');
  await shows(page, (now) => now.step > 400);
  await page.keyboard.press('Space');
});
await picture('error', `crossing@120&${bare}&panels.text=true`, async (page) => {
  await page.mouse.click(1050, 300);
  await page.keyboard.press('Control+End');
  await page.keyboard.type('spede = 2.0');
});

await close();
wrong.forEach((says) => console.error(`wrong: ${says}`));
process.exit(wrong.length ? 1 : 0);
