import { existsSync } from "node:fs";

const kPlaces = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/** Debian's Chromium without a screen, drawing with the processor. Ends with 77 where there is none. */
export async function openBrowser() {
  const executablePath = kPlaces.find(existsSync);
  if (!executablePath) {
    console.log("Skipped: no Chromium here (apt-get install chromium).");
    process.exit(77);
  }
  const { chromium } = await import("playwright-core");
  const flags = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking"];
  const drawing = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  return chromium.launch({ executablePath, args: [...flags, ...drawing] });
}
