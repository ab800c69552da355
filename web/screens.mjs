// Takes pictures of every panel of the page that web/build made, at four widths, light and dark, to look at.
//
// usage: node web/screens.mjs FOLDER OUT [NAME ...]      (requirements: see page.mjs)
//
// Without names, all of them. OUT gets NAME-WIDTH-THEME.png.
import fs from 'node:fs';
import path from 'node:path';
import { shows, studio } from './page.mjs';
import { Visitor } from './visitor.mjs';

const sizes = [[390, 844], [800, 600], [1440, 900], [2560, 1440]];
const panels = ['gallery', 'tuning', 'look', 'text', 'summary', 'plots'];
/** Each screen: its name, the part of the address after `?`, settings, and the names of buttons to press. */
const screens = [
  ['start', 'start', '', []],
  ['topic', 'crowds', '', []],
  ['lesson', 'lesson-avoidance', '', []],
  ...panels.map((panel) => [panel, '', `circle@60&panels.${panel}=true`, []]),
  ['why', '', 'circle@60&select=3&panels.why=true', []],
  ['beside', '', 'circle@60&beside=rvo', []],
  ['view', '', 'circle@60', ['View']],
  ['export', '', 'circle@60', ['Export']],
  ['help', '', 'circle@60', ['?']],
];

const [folder, out, ...names] = process.argv.slice(2);
fs.mkdirSync(out, { recursive: true });
for (const [width, height] of sizes) {
  const { open, close } = await studio(folder, { width, height });
  for (const [name, search, settings, buttons] of screens.filter(([name]) => !names.length || names.includes(name))) {
    for (const theme of ['light', 'dark']) {
      const others = panels.filter((panel) => panel !== name).map((panel) => `panels.${panel}=false`);
      const hash = [settings, `dark=${theme === 'dark'}`, ...(settings ? others : [])].filter(Boolean).join('&');
      const page = await open(settings ? hash : `&${hash}`, () => true, { search });
      await shows(page, (now) => now.step > 0);
      for (const button of buttons) {
        const there = await page.getByRole('button', { name: button, exact: true }).count();
        const visitor = new Visitor(page);
        if (!there) await visitor.click('button', 'More');
        await visitor.click('button', button);
      }
      await page.waitForTimeout(1500);
      await page.screenshot({ path: path.join(out, `${name}-${width}-${theme}.png`) });
      await page.close();
    }
  }
  await close();
}
