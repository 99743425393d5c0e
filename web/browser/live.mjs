// Steers a live run in simulated time from a real browser: node live.mjs URL (with its token). Stops the run at the end.
import { openBrowser } from "./chromium.mjs";

const [url] = process.argv.slice(2);
const browser = await openBrowser();
let failed = 0;

function check(name, good, ...what) {
  if (!good) ++failed;
  console.log(good ? "ok    " : "FAILED", name, ...(good ? [] : what));
}

async function open(address) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  page.setDefaultTimeout(120000);
  await page.goto(address);
  await page.waitForFunction(() => window.canopeer?.timeline.views.length > 1);
  return page;
}
const said = (page, text) =>
  page.waitForFunction((text) => window.canopeer.timeline.events.some((e) => e.text.includes(text)), text);
const newest = (page) => page.evaluate(() => window.canopeer.timeline.newest);

const page = await open(url);
check("it follows the newest", await page.evaluate(() => window.canopeer.playback.follow));
check("it may steer", await page.locator(".controls").isVisible());
await page.selectOption('[aria-label="Pace of simulated time"]', "2");

const other = await open(new URL(url).origin + "/");
check("a page without the token looks on only", !(await other.locator(".controls").isVisible()));
check("opened late, it has all from the first view on", (await other.evaluate(() => window.canopeer.timeline.views[0].view)) === 0);

await page.keyboard.press("ArrowLeft");
check("a step back leaves the newest", !(await page.evaluate(() => window.canopeer.playback.follow)));
await page.keyboard.press("l");
check("L returns to it", await page.evaluate(() => window.canopeer.playback.follow));

const controls = page.locator(".controls");
await controls.getByRole("button", { name: "Pause" }).click();
await said(page, "pause");
await page.waitForTimeout(4000);
const held = await newest(page);
await page.waitForTimeout(2000);
check("paused, nothing comes", (await newest(page)) === held);
await controls.getByRole("button", { name: "Go on" }).click();
await page.waitForFunction((t) => window.canopeer.timeline.newest > t, held);
check("it goes on", true);

await page.reload();
await page.waitForFunction((t) => window.canopeer?.timeline.newest >= t, held);
check("a reloaded page has all that was", (await page.evaluate(() => window.canopeer.timeline.views[0].view)) === 0);

await page.selectOption('[aria-label="Pace of simulated time"]', "0");
await controls.getByRole("button", { name: "Stop" }).click();
await page.getByRole("button", { name: "Keep it running" }).click();
check("stop asks first", !(await page.evaluate(() => window.canopeer.timeline.end)));
await controls.getByRole("button", { name: "Stop" }).click();
await page.getByRole("button", { name: "Stop the mission" }).click();
for (const one of [page, other]) await one.waitForFunction(() => window.canopeer.timeline.end?.interrupted);
check("stopped, both pages say so", (await page.locator(".status").textContent()) === "stopped early", await page.locator(".status").textContent());
check("and steer no more", !(await controls.isVisible()));
await browser.close();
process.exit(failed > 0 ? 1 : 0);
