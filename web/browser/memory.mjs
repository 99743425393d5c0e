// What a replay costs in memory while it is played and sought through: node memory.mjs URL [ROUNDS]. Linux.
import { execFileSync } from "node:child_process";
import { openBrowser } from "./chromium.mjs";

const [url, rounds = "3"] = process.argv.slice(2);
const browser = await openBrowser();
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
page.setDefaultTimeout(600000);
const cdp = await page.context().newCDPSession(page);

/** Resident memory of the largest process that draws pages, MB. */
function resident() {
  const lines = execFileSync("ps", ["-eo", "rss=,args="], { encoding: "utf8", maxBuffer: 1 << 26 }).split("\n");
  return Math.max(...lines.filter((line) => line.includes("--type=renderer")).map((line) => parseInt(line) / 1024));
}
async function say(what) {
  await cdp.send("HeapProfiler.collectGarbage");
  const heap = await page.evaluate(() => performance.memory.usedJSHeapSize / 1e6);
  const { geometries, textures } = await page.evaluate(() => window.canopeer.scene.probe.held);
  console.log(`${what}: heap ${heap.toFixed(0)} MB, process ${resident().toFixed(0)} MB, ${geometries} geometries, ${textures} textures`);
}

await page.goto(url);
await page.waitForFunction(() => window.canopeer?.timeline.end && window.canopeer.scene);
const duration = await page.evaluate(() => window.canopeer.timeline.duration);
await say(`${(duration / 60).toFixed(0)} min of mission loaded`);
for (let round = 1; round <= Number(rounds); ++round) {
  for (let i = 0; i <= 40; ++i) {
    await page.evaluate((t) => window.canopeer.seek(t), (duration * i) / 40);
    await page.evaluate(() => window.canopeer.scene.probe.still());
  }
  await say(`sought through, round ${round}`);
}
await page.evaluate(() => {
  window.canopeer.seek(0);
  window.canopeer.playback.setSpeed(64);
  window.canopeer.toggle();
});
await page.waitForFunction(() => !window.canopeer.playback.playing);
await say("played at 64 times its speed");
await browser.close();
