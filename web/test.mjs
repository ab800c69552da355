// Operates the page that web/build made in a headless Chromium, and checks what it shows.
//
// usage: node web/test.mjs FOLDER [PICTURE.png]      (requirements: see page.mjs)
//
// With AXE=.../axe.min.js (npm package axe-core), the page must have no serious findings of accessibility. With
// PROGRAM=..., scenes of every kind must reach the same state as in that program (`throng run SCENE --json`), bit for bit.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { shows, studio } from './page.mjs';
import { Visitor, tasksByKeyboard, tasksOfVisitors } from './visitor.mjs';

const [folder, picture] = process.argv.slice(2);
const { wrong, open, close } = await studio(folder);
const expect = (holds, says) => { if (!holds) wrong.push(says); };
const middle = [640, 420];

async function checked(what, check) {
  const before = wrong.length;
  try {
    await check();
  } catch (error) {
    wrong.push(`${what}: ${error.message.split('\n')[0]}`);
  }
  console.log(`${what}: ${wrong.length === before ? 'ok' : 'WRONG'}`);
}

await checked('circle runs to its end, and the page draws it', async () => {
  const page = await open('circle', (now) => now.over);
  const end = await shows(page);
  expect(end.agents === 36 && end.arrived === 36, `${end.arrived} of ${end.agents} arrived`);
  await page.waitForTimeout(500);
  const png = await page.screenshot(picture ? { path: picture } : {});
  // an empty page is a few kilobytes
  expect(png.length > 30_000, `the picture has only ${png.length} bytes`);
  // a click gives the canvas the keyboard focus
  await page.mouse.click(...middle);
  await page.keyboard.press('r');
  const { playing } = await shows(page, (now) => now.step < 100);
  if (!playing) {
    await page.keyboard.press('Space');
    await shows(page, (now) => now.playing);
  }
  await page.keyboard.press('Space');
  const { step } = await shows(page, (now) => !now.playing);
  await page.keyboard.press('ArrowRight');
  const next = await shows(page);
  expect(next.step === step || next.step === step + 1, `a single step went from ${step} to ${next.step}`);
  await page.keyboard.press('s');
  await shows(page, (now) => now.selected !== null);
  await page.keyboard.press('Tab');
  await shows(page, (now) => now.scene !== 'circle');
  await page.close();
});

/** Scenes with a number of steps and the length of a step, seconds. */
const same = {
  circle: [500, 0.04], office: [150, 0.04], maze: [150, 0.04], 'mixed-sizes': [150, 0.04], 'field-goal': [150, 0.04],
  sphere: [150, 0.04], 'boids-in-box': [150, 0.04], 'swarm-aggregation': [150, 0.016666667],
};

await checked('the same bits as the program', async () => {
  for (const [scene, [steps, step]] of Object.entries(same)) {
    const page = await open(`${scene}@${steps}`, `(now) => now.step === ${steps}`);
    const { hash } = await shows(page);
    await page.close();
    console.log(`${scene} after ${steps} steps: ${hash}`);
    if (!process.env.PROGRAM) continue;
    const run = ['run', scene, '-q', '--json', '--no-files', '--no-expect', '--set', 'time.until=limit', '--set', `time.limit=${steps * step}`];
    const program = JSON.parse(execFileSync(process.env.PROGRAM, run)).state_hash;
    expect(hash === program, `${scene}: ${hash} is not the program's ${program}`);
  }
});

await checked('the text is checked, kept when the page is reloaded, and downloaded', async () => {
  const page = await open('circle@0&panels.text=true', (now) => now.step === 0);
  await page.waitForTimeout(1000);
  await page.mouse.click(1050, 400);
  await page.keyboard.press('Control+End');
  await page.keyboard.type('what = is this\n');
  const { trouble } = await shows(page, (now) => now.trouble);
  expect(/:\d+:\d+: /.test(trouble), `the error names no position: ${trouble}`);
  // the draft is stored every 3 s
  await page.waitForTimeout(4000);
  await page.reload();
  const again = await shows(page, (now) => now.unsaved);
  expect(again.trouble, 'the draft is not restored');
  const asked = page.waitForEvent('download', { timeout: 20_000 });
  await page.mouse.click(...middle);
  await page.keyboard.press('Control+s');
  const download = await asked;
  const text = fs.readFileSync(await download.path(), 'utf8');
  expect(download.suggestedFilename() === 'circle.toml', `the file is called ${download.suggestedFilename()}`);
  expect(text.includes('what = is this'), 'the file does not contain the text');
  await shows(page, (now) => !now.unsaved);
  await page.close();
});

await checked('a picked file of trajectories is replayed, with the surroundings of the scene file beside it', async () => {
  const page = await open('box@0', (now) => now.step === 0);
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'throng-'));
  const walk = Array.from({ length: 30 }, (_, k) => `${k / 10},7,${k / 10},2,a\n${k / 10},9,${3 - k / 10},4,a\n`);
  const files = [['walk.csv', `time,number,x,y,group\n${walk.join('')}`], ['walk.toml', 'title = "A walk"\n[[group]]\nname = "a"\nplace.point = [0, 0]\n']];
  files.forEach(([name, text]) => fs.writeFileSync(path.join(folder, name), text));
  await page.waitForTimeout(1000);
  await page.mouse.click(...middle);
  // a browser opens the file chooser only shortly after a key press; slow drawing may need another attempt
  let asked;
  for (let k = 0; k < 6 && !asked; k += 1) {
    const asking = page.waitForEvent('filechooser', { timeout: 10_000 }).catch(() => undefined);
    await page.keyboard.press('Control+o');
    asked = await asking;
  }
  await asked.setFiles(files.map(([name]) => path.join(folder, name)));
  const film = await shows(page, (now) => now.scene === 'walk' && now.over);
  expect(film.agents === 2 && film.step === 29 && film.title === 'A walk', `it shows ${JSON.stringify(film)}`);
  fs.rmSync(folder, { recursive: true });
  await page.close();
});

/** A part of the view, without panels and messages. */
const view = { x: 330, y: 200, width: 300, height: 300 };

/** Returns how many pixels of two pictures differ. */
async function differing(page, ...pictures) {
  return page.evaluate(async (sources) => {
    const pixels = await Promise.all(sources.map(async (source) => {
      const image = new Image();
      image.src = `data:image/png;base64,${source}`;
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }));
    let count = 0;
    for (let k = 0; k < pixels[0].length; k += 4) {
      count += [0, 1, 2].some((c) => Math.abs(pixels[0][k + c] - pixels[1][k + c]) > 24) ? 1 : 0;
    }
    return count;
  }, pictures.map((picture) => picture.toString('base64')));
}

/** Returns the picture of the view once it has not changed for a second. */
async function settled(page) {
  for (let before = Buffer.alloc(0), tries = 0; tries < 40; tries += 1) {
    await page.waitForTimeout(1000);
    const now = await page.screenshot({ clip: view });
    if (now.equals(before)) return now;
    before = now;
  }
  throw new Error('the view does not come to rest');
}

await checked('a shared address opens exactly this view', async () => {
  const settings = 'panels.gallery=false&panels.summary=false&panels.plots=true&layers.heat=Density&coloring=Speed';
  const page = await open(`circle@60&select=3&camera=orbit&beside=rvo&${settings}`, (now) => now.step === 60);
  await page.waitForTimeout(1500);
  await page.mouse.move(200, 300);
  await page.mouse.down();
  await page.mouse.move(320, 260, { steps: 4 });
  await page.mouse.up();
  await new Visitor(page).click('button', 'Share');
  await page.waitForFunction(() => location.hash.includes('eye='), null, { timeout: 30_000 });
  const hash = await page.evaluate(() => location.hash.slice(1));
  await shows(page, (now) => now.step === 60 && now.beside === 60);
  await page.mouse.move(640, 795);
  const shared = await settled(page);
  if (picture) await page.screenshot({ path: picture.replace('.png', '-shared.png') });
  await page.close();
  const visitor = await open(`box&dark=true`, (now) => now.step > 0);
  await visitor.evaluate((hash) => { location.hash = hash; }, hash);
  const now = await shows(visitor, (now) => now.scene === 'circle' && now.step === 60 && now.beside === 60);
  expect(now.selected === 3 && !now.playing, `it shows ${JSON.stringify(now)}`);
  await visitor.mouse.move(640, 795);
  const seen = await settled(visitor);
  if (picture) await visitor.screenshot({ path: picture.replace('.png', '-visited.png') });
  const differ = await differing(visitor, shared, seen);
  expect(differ < 100, `${differ} pixels of the views differ: ${hash}`);
  await visitor.evaluate(() => { location.hash = 'box@5&select=2'; });
  await shows(visitor, (now) => now.scene === 'box' && now.step === 5 && now.selected === 2);
  await visitor.close();
});

await checked('a visitor sees motion, first of a film', async () => {
  // the program arrives after the film plays, as over a slow connection: else a fast machine needs no film
  let plays = false;
  const hold = (page) => page.route('**/*.wasm', async (route) => {
    const film = () => document.querySelector('video')?.currentTime > 0;
    plays ||= await page.waitForFunction(film, null, { timeout: 60_000 }).then(() => true, () => false);
    await route.continue();
  });
  const page = await open('', (now) => now.playing && now.step > 3, { before: hold });
  if (picture) await page.screenshot({ path: picture.replace('.png', '-start.png') });
  expect(plays, 'the film does not play');
  expect(await page.evaluate(() => !document.querySelector('video')), 'the film is still there');
  await page.close();
});

await checked('a new visitor needs few clicks', () => tasksOfVisitors(folder, expect));

await checked('a visitor without a mouse does the same', () => tasksByKeyboard(open));

await checked('a lesson pauses for its question, and goes on', async () => {
  const page = await open('', (now) => now.step > 0 && !now.playing, { search: 'lesson-avoidance' });
  const visitor = new Visitor(page);
  const { step } = await shows(page);
  await visitor.click('button', 'Both pass each other smoothly');
  await visitor.click('button', 'Go on and see');
  await page.waitForFunction((step) => globalThis.throng.step > step, step, { timeout: 30_000 });
  await visitor.click('button', 'Next');
  await page.getByText('2 of 6', { exact: true }).waitFor({ state: 'attached', timeout: 30_000 });
  await page.close();
});

await checked('an embedded scene waits for a click, and reduced motion for the user', async () => {
  const page = await open('circle', (now) => !now.playing, { search: 'embed' });
  await page.waitForTimeout(1000);
  expect((await shows(page)).step === 0, 'it plays without a click');
  await page.mouse.click(...middle);
  await shows(page, (now) => now.playing && now.step > 0);
  await page.close();
  const still = await open('', () => true, { before: (page) => page.emulateMedia({ reducedMotion: 'reduce' }) });
  await still.waitForTimeout(1000);
  expect((await shows(still)).step === 0, 'it plays in spite of reduced motion');
  await still.close();
});

await checked('a screen with two pixels a point shows the same as another', async () => {
  const fine = await studio(folder, { scale: 2 });
  const page = await fine.open('circle@60', (now) => now.step === 60);
  const sizes = await page.evaluate(() => [document.querySelector('canvas').width, innerWidth]);
  expect(sizes.join() === '2560,1280', `the canvas has ${sizes[0]} pixels for ${sizes[1]} points`);
  await page.waitForTimeout(1000);
  const asked = page.waitForEvent('download', { timeout: 20_000 });
  await new Visitor(page).click('button', 'Picture');
  const png = fs.readFileSync(await (await asked).path());
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
  expect(width > 1200 && width < 2560 && height < 1600, `the picture of the view has ${width} by ${height} pixels`);
  await page.close();
  await fine.close();
});

if (process.env.AXE) {
  await checked('axe finds nothing serious', async () => {
    for (const [hash, search] of [['circle@0', ''], ['', 'start'], ['', 'lesson-boids']]) {
      const page = await open(hash, () => true, { search });
      await page.addScriptTag({ path: process.env.AXE });
      const { violations } = await page.evaluate(() => globalThis.axe.run());
      for (const { id, impact, help } of violations) {
        expect(!['serious', 'critical'].includes(impact), `${hash}${search}: ${id} (${impact}): ${help}`);
      }
      await page.close();
    }
  });
}

await close();
wrong.forEach((says) => console.error(`wrong: ${says}`));
process.exit(wrong.length ? 1 : 0);
