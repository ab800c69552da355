// Measures the frames a second of the page that web/build made, or of the window, with 36, 1,000 and 10,000 agents that
// play at their own speed.
//
// usage: node web/frames.mjs FOLDER              (the page; requirements: see page.mjs)
//        node web/frames.mjs --window PROGRAM    (the window of throng-studio; needs a screen, such as of xvfb-run)
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { shows, studio } from './page.mjs';

/** The measured time, and the time before it, milliseconds. */
const LONG = 8000;
const BEFORE = 3000;
/** Two streams of 5,000 agents that meet. */
const many = `time = { step = 0.04, until = "limit", limit = 300 }
${[[-1, 'east'], [1, 'west']].map(([side, name]) => `[[group]]
name = "${name}"
count = 5000
place.rectangle = { center = [${side * 40}, 0], size = [70, 90], gap = 0.2 }
goal.shift = { by = [${-side * 80}, 0] }
`).join('')}`;
const scenes = [['circle', 36], ['ring-1000', 1000], ['many', 10000]];

const [folder, program] = process.argv.slice(2);
const home = fs.mkdtempSync(path.join(os.tmpdir(), 'throng-frames-'));
const file = path.join(home, 'many.toml');
fs.writeFileSync(file, many);
const wait = (time) => new Promise((done) => setTimeout(done, time));
const say = (what, agents, [before, after], seconds) => {
  const rate = ((after.frames - before.frames) / seconds).toFixed(1);
  const pace = ((after.time - before.time) / seconds).toFixed(2);
  console.log(`${what}, ${agents} agents: ${rate} frames a second, ${pace} s of the scene a second`);
};

if (folder === '--window') {
  for (const [name, agents] of scenes) {
    const state = path.join(home, 'state.json');
    const options = [name === 'many' ? file : name, '--state', state, '--size', '1280x800'];
    const running = spawn(program, options, { env: { ...process.env, HOME: home, XDG_DATA_HOME: home }, stdio: 'ignore' });
    // the file is replaced while it is read
    const read = async () => {
      for (let tries = 0; tries < 400; tries += 1) {
        try {
          return JSON.parse(fs.readFileSync(state, 'utf8'));
        } catch {
          await wait(100);
        }
      }
      throw new Error('the window says nothing');
    };
    while ((await read()).step === 0) await wait(100);
    await wait(BEFORE);
    const [before, from] = [await read(), performance.now()];
    await wait(LONG);
    say('window', agents, [before, await read()], (performance.now() - from) / 1000);
    running.kill();
    await wait(500);
    fs.rmSync(state, { force: true });
  }
} else {
  const { open, close } = await studio(folder, { width: 1280, height: 800 });
  for (const [name, agents] of scenes) {
    const page = await open(name === 'many' ? 'circle@0' : name, () => true);
    if (name === 'many') {
      await page.focus('canvas');
      const picked = page.waitForEvent('filechooser');
      await page.keyboard.press('Control+o');
      await (await picked).setFiles(file);
      await shows(page, (now) => now.scene === 'many');
    }
    await shows(page, (now) => now.playing && now.step > 0);
    await wait(BEFORE);
    const [before, from] = [await shows(page), performance.now()];
    await wait(LONG);
    say('page', agents, [before, await shows(page)], (performance.now() - from) / 1000);
    await page.close();
  }
  await close();
}
fs.rmSync(home, { recursive: true, force: true });
