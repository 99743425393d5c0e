// Pictures of a replay, evenly over the run, for an animation: node film.mjs URL FOLDER [PICTURES WIDTH HEIGHT]
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { openBrowser } from "./chromium.mjs";

const [url, folder, pictures = "200", width = "1180", height = "664"] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const browser = await openBrowser();
const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) } });
page.setDefaultTimeout(300000);
await page.goto(url);
await page.waitForFunction(() => window.canopeer?.timeline.end && window.canopeer.scene);
await page.getByRole("button", { name: "Layers" }).click(); // folds them up: they hide plants
await page.evaluate(() => window.canopeer.look("row"));
await page.waitForTimeout(1500); // the camera flies there
const duration = await page.evaluate(() => window.canopeer.timeline.duration);
for (let i = 0; i < Number(pictures); ++i) {
  await page.evaluate((t) => window.canopeer.seek(t), (duration * i) / (Number(pictures) - 1));
  await page.evaluate(() => window.canopeer.scene.probe.still());
  await page.screenshot({ path: join(folder, `${String(i).padStart(4, "0")}.png`) });
}
await browser.close();
