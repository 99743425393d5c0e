// One picture of a replay: node shot.mjs URL PICTURE.jpg [SHARE_OF_THE_RUN robot|row|camera light|dark]
import { openBrowser } from "./chromium.mjs";

const [url, path, share = "1", where = "row", colorScheme = "light"] = process.argv.slice(2);
const browser = await openBrowser();
const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, colorScheme });
page.setDefaultTimeout(300000);
await page.goto(url);
await page.waitForFunction(() => window.canopeer?.timeline.end && window.canopeer.scene);
await page.evaluate((share) => window.canopeer.seek(share * window.canopeer.timeline.duration), Number(share));
await page.waitForTimeout(300); // panels, and what the camera sees
await page.evaluate((where) => window.canopeer.look(where), where);
await page.waitForTimeout(1000); // the eye flies there
await page.evaluate(() => window.canopeer.scene.probe.still());
await page.screenshot({ path, quality: 88 });
await browser.close();
