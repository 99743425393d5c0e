// Looks at a replay in a real browser: node replay.mjs URL [PICTURE_FOLDER]
// Needs what `npm ci` installs, Node 20, and Chromium. Ends with 1 where a check fails, with 77 where no browser is there.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { openBrowser } from "./chromium.mjs";

const [url, pictures] = process.argv.slice(2);
const browser = await openBrowser();
let failed = 0;

function check(name, good, ...what) {
  if (!good) ++failed;
  console.log(good ? "ok    " : "FAILED", name, ...(good ? [] : what));
}

const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
page.setDefaultTimeout(120000);
const errors = [];
page.on("pageerror", (error) => errors.push(error.message));
const asked = [];
page.on("request", (request) => asked.push(request.url()));

const moment = () =>
  page.evaluate(() => {
    const { playback, selection, timeline } = window.canopeer;
    return { t: playback.t, playing: playback.playing, speed: playback.speed, selection, view: timeline.viewAt(playback.t)?.view };
  });
const seekTo = (t) => page.evaluate((t) => window.canopeer.seek(t), t);
const key = (name) => page.keyboard.press(name);
const figure = (name) => page.locator(".figure", { has: page.locator(`dt:text-is("${name}")`) }).locator("dd").textContent();
const picture = async (name) => {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
};
/** Until all voxels of this moment are there. */
const settled = () => page.waitForFunction(() => window.canopeer.scene.probe.settled);

await page.goto(url);
await page.waitForFunction(() => window.canopeer?.timeline.end);
const run = await page.evaluate(() => {
  const { timeline } = window.canopeer;
  const views = timeline.views.map((v) => ({ view: v.view, t: v.t, fruits: v.fruits, roiVoxels: v.roiVoxels }));
  return { views, duration: timeline.duration, segments: timeline.segments.map((s) => s.t) };
});
const last = run.views.at(-1);

// Figures.
await seekTo(run.duration);
await page.waitForTimeout(300);
check("the last view is named", (await figure("View")).startsWith(`${last.view} /`), await figure("View"));
check("fruits are counted", (await figure("Fruits")).startsWith(String(last.fruits)), await figure("Fruits"), last.fruits);
check("fruit voxels are counted", (await figure("Fruit voxels")).replace(",", "") === String(last.roiVoxels));
await settled();
await picture("end");

// Each switch changes what is seen where its things are.
const looks = await page.evaluate(() => window.canopeer.timeline.looks.length);
check("frames on the way are counted", looks === 0 || (await figure("On the way")) === `${looks} / ${looks}`);
check("their switch is there with them only", (await page.locator(".layer.onTheWay").isVisible()) === looks > 0);
for (const layer of ["robot", "occupied", "roi", "fruits", "plants"]) {
  const [on, off] = await page.evaluate((id) => window.canopeer.scene.probe.compare(id), layer);
  check(`layer ${layer} is where it must be`, Math.abs(on[0] - off[0]) + Math.abs(on[1] - off[1]) + Math.abs(on[2] - off[2]) > 12, on, off);
}
for (const box of await page.locator(".layer input:visible").all()) {
  const before = await box.isChecked();
  await box.click();
  check(`switch ${await box.locator("..").textContent()}`, (await box.isChecked()) !== before);
  await box.click();
}

// Playback, by keys only.
await key("Home");
await key(" ");
await page.waitForFunction(() => window.canopeer.playback.t > 0.3);
await key("+");
check("+ is faster", (await moment()).speed === 2);
await key(" ");
check("space holds", !(await moment()).playing);
await seekTo(run.views[1].t);
await key("ArrowRight");
check("→ is the next view", (await moment()).view === run.views[2].view);
await key("ArrowLeft");
check("← is the view before", (await moment()).view === run.views[1].view);
await key("PageUp");
check("PgUp is a segment's beginning", run.segments.includes((await moment()).t));
await key("End");
check("End is the end", (await moment()).t === run.duration);

// The line of time.
const line = await page.locator(".scrub").boundingBox();
await page.mouse.click(line.x + line.width / 2, line.y + 12);
check("a click on the line goes there", Math.abs((await moment()).t - run.duration / 2) < run.duration / 200);
await page.mouse.down();
await page.mouse.move(line.x + 0.9 * line.width, line.y + 12, { steps: 4 });
await page.mouse.up();
check("dragging goes along", Math.abs((await moment()).t - 0.9 * run.duration) < run.duration / 200);

// Picking.
await seekTo(run.duration);
await settled();
const fruit = await page.evaluate(() => window.canopeer.scene.probe.someFruit());
await page.mouse.click(fruit.x, fruit.y);
check("a click picks a fruit", (await moment()).selection?.is === "fruit", fruit);
await page.waitForSelector(".thumb");
await picture("fruit");
await page.locator(".thumb").first().click();
check("its pictures lead to views", (await moment()).selection?.is === "view");
await picture("view");
await key("Escape");
check("Esc leaves it", (await moment()).selection === null);
await page.getByRole("tab", { name: "Views" }).click();
await page.locator(".views .rows .row").nth(1).click();
check("a row picks a view", (await moment()).selection?.is === "view");
await key("Escape");
await page.getByRole("tab", { name: "Progress" }).click();
const plot = await page.locator(".u-over").first().boundingBox();
await page.mouse.click(plot.x + 0.4 * plot.width, plot.y + 0.5 * plot.height);
check("a click in the plot picks a view", (await moment()).selection?.is === "view");
await key("Escape");

// Links.
await page.evaluate((view) => (location.hash = `#view=${view}`), run.views[1].view);
await page.waitForTimeout(200);
check("#view= goes to the view", (await moment()).t === run.views[1].t);
await page.reload();
await page.waitForFunction(() => window.canopeer?.timeline.end);
check("a reloaded page is where it was", (await moment()).t === run.views[1].t);

// For all.
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
for (const colorScheme of ["light", "dark"]) {
  await page.emulateMedia({ colorScheme });
  await page.evaluate(axe);
  for (const name of ["Progress", "Views", "Fruits", "Log"]) {
    if (await page.locator(".detail").isVisible()) await key("Escape");
    await page.getByRole("tab", { name }).click();
    const { violations } = await page.evaluate(() => window.axe.run());
    const serious = violations.filter((v) => v.impact === "serious" || v.impact === "critical");
    check(`accessible: ${name}, ${colorScheme}`, serious.length === 0, serious.map((v) => v.id));
  }
  await picture(colorScheme);
}
await page.setViewportSize({ width: 390, height: 844 });
await page.waitForTimeout(300);
const wide = await page.evaluate(() => document.documentElement.scrollWidth);
check("nothing sticks out on a phone", wide <= 390, wide);
await picture("phone");

const own = new URL(url).host;
check("nothing comes from elsewhere", asked.every((u) => u.startsWith("data:") || u.startsWith("blob:") || new URL(u).host === own), asked);
check("no errors", errors.length === 0, errors);
await browser.close();
process.exit(failed > 0 ? 1 : 0);
