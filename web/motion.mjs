// Measures the time to the first motion of the page that web/build made, for a visitor without a link: in a headless
// Chromium that is four times slower than this machine, over a network of 10 Mbit/s with 40 ms of latency.
//
// usage: node web/motion.mjs FOLDER      (requirements: see page.mjs)
import { studio } from './page.mjs';

const { open, close } = await studio(process.argv[2], { width: 1280, height: 800 });
const bytes = [];
async function slow(page) {
  const cdp = await page.context().newCDPSession(page);
  await cdp.send('Network.enable');
  await cdp.send('Network.setCacheDisabled', { cacheDisabled: true });
  await cdp.send('Network.emulateNetworkConditions', { offline: false, latency: 40, downloadThroughput: 1.25e6, uploadThroughput: 1.25e6 });
  await cdp.send('Emulation.setCPUThrottlingRate', { rate: 4 });
  const names = new Map();
  cdp.on('Network.responseReceived', ({ requestId, response }) => names.set(requestId, response.url));
  cdp.on('Network.loadingFinished', ({ requestId, encodedDataLength }) => bytes.push([names.get(requestId), encodedDataLength]));
  await page.addInitScript(() => {
    const wait = () => (globalThis.throng?.step > 0 ? (globalThis.moved = performance.now()) : requestAnimationFrame(wait));
    wait();
    const play = () => (document.querySelector('video')?.currentTime > 0 ? (globalThis.played = performance.now()) : requestAnimationFrame(play));
    play();
  });
}
const page = await open('', (now) => now.step > 0, { before: slow });
const [played, moved] = await page.evaluate(() => [globalThis.played, globalThis.moved]);
console.log(`the film moves after ${(played / 1000).toFixed(1)} s, the studio's scene after ${(moved / 1000).toFixed(1)} s`);
bytes.filter(([name]) => !name?.endsWith('blank')).forEach(([name, length]) => console.log(`${length} bytes  ${name}`));
await close();
