// How soon a replay is there, and how many frames a second it is drawn with: node frames.mjs URL [WIDTH HEIGHT]
import { openBrowser } from "./chromium.mjs";

const [url, width = "1280", height = "720"] = process.argv.slice(2);
const browser = await openBrowser();
const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) } });
page.setDefaultTimeout(300000);
const begin = Date.now();
await page.goto(url);
await page.waitForFunction(() => window.canopeer?.scene?.probe.furnished);
const first = Date.now() - begin;
await page.waitForFunction(() => window.canopeer.timeline.end);
const all = Date.now() - begin;
await page.evaluate(() => window.canopeer.seek(window.canopeer.timeline.duration));
await page.waitForFunction(() => window.canopeer.scene.probe.settled);
await page.evaluate(() => window.canopeer.scene.probe.turn(3000)); // it finds its level of detail
const fps = await page.evaluate(() => window.canopeer.scene.probe.turn(6000));
const { voxels } = await page.evaluate(() => window.canopeer.scene.probe.figures);
const heap = await page.evaluate(() => performance.memory.usedJSHeapSize / 1e6);
console.log(`first picture (robot, plants) after ${first} ms, all there after ${all} ms`);
console.log(`${voxels} voxels, ${fps.toFixed(1)} frames a second while turning, heap ${heap.toFixed(0)} MB`);
await browser.close();
