// A replay's server goes and comes back: node back.mjs PROGRAM RUN_DIR
import { spawn } from "node:child_process";
import { once } from "node:events";
import { openBrowser } from "./chromium.mjs";

const [program, run] = process.argv.slice(2);
let failed = 0;
function check(name, good, ...what) {
  if (!good) ++failed;
  console.log(good ? "ok    " : "FAILED", name, ...(good ? [] : what));
}

/** The server's process and the address it says. */
async function serve(port) {
  const server = spawn(program, ["view", run, "--view-port", String(port)]);
  let said = "";
  for (const stream of [server.stdout, server.stderr]) stream.on("data", (data) => (said += data));
  for (;;) {
    const link = said.match(/http:\/\/127[^\s]*/);
    if (link) return { server, url: new URL(link[0]) };
    if (server.exitCode !== null) throw new Error(said);
    await new Promise((resume) => setTimeout(resume, 50));
  }
}
async function stop(server) {
  server.kill();
  await once(server, "exit");
}

const first = await serve(0);
const browser = await openBrowser();
const page = await browser.newPage();
page.setDefaultTimeout(120000);
// What is there already is not asked for again; so the page is caught while the run comes in.
let most = 40;
await page.routeWebSocket(/socket/, (socket) => {
  const server = socket.connectToServer();
  let passed = 0;
  server.onMessage((message) => (passed++ < most ? socket.send(message) : undefined));
});
await page.goto(first.url.origin + "/");
await page.waitForFunction(() => window.canopeer?.timeline.hello);
const before = await page.evaluate(() => window.canopeer.timeline.views.length);
await stop(first.server);
await page.waitForFunction(() => document.querySelector(".status").textContent === "lost");
check("without its server the page says so", await page.getByText("No connection to Canopeer").isVisible());
most = Infinity;
const second = await serve(first.url.port);
await page.waitForFunction(() => window.canopeer.timeline.end);
const after = await page.evaluate(() => window.canopeer.timeline.views.map((view) => view.view));
check("back again it has everything, once", after.length > before && after.every((view, i) => view === i), before, after.length);
await browser.close();
await stop(second.server);
process.exit(failed > 0 ? 1 : 0);
