// The tasks of a new visitor, each from the start page, with the number of clicks that it takes.
//
// A click is a press of the mouse on a control or in the view; a drag counts as one. Scrolling is no click.
import { focused, shows, studio } from './page.mjs';

/** The sizes of the page: a desktop, and a phone. */
const sizes = [{ width: 1280, height: 800 }, { width: 390, height: 844 }];

/** A visitor of the page. */
export class Visitor {
  clicks = 0;

  constructor(page) {
    this.page = page;
  }

  /** Moves the mouse along the points with the button pressed. */
  async press(...points) {
    this.clicks += 1;
    await this.page.mouse.move(...points[0]);
    await this.page.waitForTimeout(150);
    await this.page.mouse.down();
    for (const point of points.slice(1)) {
      // a slow page sees the press, the way and the release in frames of their own
      await this.page.waitForTimeout(400);
      await this.page.mouse.move(...point, { steps: 5 });
      await this.page.waitForTimeout(400);
    }
    await this.page.mouse.up();
    await this.page.waitForTimeout(150);
  }

  /** Returns the place of a control on the screen: left, top, width, height. Scrolls to it. */
  async place(role, name) {
    const { width, height } = this.page.viewportSize();
    for (let tries = 0; tries < 12; tries += 1) {
      const control = this.page.getByRole(role, { name, exact: true }).first();
      await control.waitFor({ state: 'attached', timeout: 20_000 });
      const box = await control.boundingBox();
      // the bar of the time line is below the panels
      if (box.y + box.height < height - 90 || role !== 'slider' && box.y + box.height < height) return box;
      await this.page.mouse.move(width < 700 ? width / 2 : Math.min(width - 40, box.x + 10), height - 120);
      await this.page.mouse.wheel(0, 120);
      await this.page.waitForTimeout(300);
    }
    throw new Error(`${name} is out of reach`);
  }

  /** Clicks a control, at a part of its width. */
  async click(role, name, part = 0.5) {
    const box = await this.place(role, name);
    await this.press([box.x + part * box.width, box.y + box.height / 2]);
  }
}

/** Each task: its name, the greatest number of clicks, and what the visitor does. */
const tasks = [
  ['see boids', 1, async (visitor) => {
    await visitor.click('button', 'Flocks');
    await shows(visitor.page, (now) => now.scene === 'boids-in-box' && now.step > 3);
  }],
  ['change the separation of boids', 2, async (visitor) => {
    await visitor.click('button', 'Flocks');
    await shows(visitor.page, (now) => now.scene === 'boids-in-box' && now.step > 3);
    await visitor.click('slider', 'separation', 0.5);
    await shows(visitor.page, (now) => now.unsaved && now.trouble === null && now.step > 3);
  }],
  ['compare VO with ORCA', 2, async (visitor) => {
    await visitor.click('button', 'Avoidance');
    await shows(visitor.page, (now) => now.scene === 'circle' && now.step > 0);
    await visitor.click('button', 'VO');
    await shows(visitor.page, (now) => now.beside > 0);
  }],
  ['put a wall before walking people', 2, async (visitor) => {
    await visitor.click('button', 'barrier');
    const { width, height } = visitor.page.viewportSize();
    await visitor.press([0.45 * width, 0.3 * height], [0.5 * width, 0.4 * height]);
    await shows(visitor.page, (now) => now.interventions === 1 && now.step > 3);
  }],
  ['share exactly this view', 1, async (visitor) => {
    await visitor.click('button', 'Share');
    await visitor.page.waitForFunction(() => location.hash.startsWith('#street@'), null, { timeout: 20_000 });
  }],
  ['find out why an agent turns', 2, async (visitor) => {
    await visitor.click('button', 'Why');
    await visitor.click('button', 'Explain an agent');
    await shows(visitor.page, (now) => now.why && now.selected !== null);
  }],
];

/** Carries out all tasks in pages of all sizes. `expect` notes what does not hold. */
export async function tasksOfVisitors(folder, expect) {
  for (const size of sizes) {
    const { wrong, open, close } = await studio(folder, size);
    for (const [name, most, carryOut] of tasks) {
      const visitor = new Visitor(await open('', (now) => now.scene === 'street' && now.step > 0));
      try {
        await carryOut(visitor);
        console.log(`  ${size.width} pixels: ${name}: ${visitor.clicks} clicks`);
        expect(visitor.clicks <= most, `${name} takes ${visitor.clicks} clicks, not ${most}`);
      } catch (error) {
        expect(false, `${size.width} pixels: ${name}: ${error.message.split('\n')[0]}`);
      }
      await visitor.page.close();
    }
    wrong.forEach((says) => expect(false, says));
    await close();
  }
}

/** Carries out the tasks with the keyboard alone. */
export async function tasksByKeyboard(open) {
  const operate = async (page, name, key = 'Enter') => {
    await focused(page, name);
    await page.keyboard.press(key);
  };
  const start = async () => {
    const page = await open('', (now) => now.scene === 'street' && now.step > 0);
    await page.focus('canvas');
    return page;
  };
  let page = await start();
  await operate(page, 'Flocks');
  await shows(page, (now) => now.scene === 'boids-in-box' && now.step > 3);
  await operate(page, 'separation', 'ArrowRight');
  await shows(page, (now) => now.unsaved && now.trouble === null);
  await page.close();
  page = await start();
  await operate(page, 'Avoidance');
  await shows(page, (now) => now.scene === 'circle' && now.step > 0);
  await operate(page, 'VO');
  await shows(page, (now) => now.beside > 0);
  await page.close();
  page = await start();
  await operate(page, 'barrier');
  // the cross begins in the middle of the view
  const press = async (key, times = 1) => {
    for (let k = 0; k < times; k += 1) {
      await page.keyboard.press(key);
      await page.waitForTimeout(100);
    }
  };
  await press('ArrowUp', 2);
  await press('Enter');
  await press('ArrowRight', 6);
  await press('Enter');
  await shows(page, (now) => now.interventions === 1 && now.step > 3);
  await page.close();
  page = await start();
  await operate(page, 'Share');
  await page.waitForFunction(() => location.hash.startsWith('#street@'), null, { timeout: 20_000 });
  await operate(page, 'Why');
  await operate(page, 'Explain an agent');
  await shows(page, (now) => now.why && now.selected !== null);
  await page.close();
}
