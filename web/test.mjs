// Operates the page that web/build made in a headless Chromium, and checks what it shows.
//
// usage: node web/test.mjs FOLDER [PICTURE.png]      (requirements: see page.mjs)
//
// With PROGRAM=..., scenes of every kind must reach the same state as in that program (`throng run SCENE --json`), bit
// for bit.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { shows, studio } from './page.mjs';

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

await close();
wrong.forEach((says) => console.error(`wrong: ${says}`));
process.exit(wrong.length ? 1 : 0);
