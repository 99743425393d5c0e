// Bundles the page into one file: node build.mjs OUT.html [NODE_MODULES]
// Needs what `npm ci` installs; NODE_MODULES says where, if not beside this file.
import { mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [out, modules = join(here, "node_modules")] = process.argv.slice(2);
if (!out) {
  console.error("usage: node build.mjs OUT.html [NODE_MODULES]");
  process.exit(2);
}
const { build } = createRequire(join(resolve(modules), "x.js"))("esbuild");

const result = await build({
  entryPoints: [join(here, "src/main.ts")],
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "eof",
  nodePaths: [resolve(modules)],
  outdir: "bundle",
  write: false,
  logLevel: "warning",
});
const text = (end) => result.outputFiles.find((file) => file.path.endsWith(end)).text;

// Inside HTML, the end of the element must not show up in the script.
const script = text(".js").replaceAll("</script", "<\\/script");
const page = readFileSync(join(here, "src/index.html"), "utf8")
  .replace("/*STYLE*/", () => text(".css"))
  .replace("/*SCRIPT*/", () => script);
mkdirSync(dirname(resolve(out)), { recursive: true });
writeFileSync(`${out}.part`, page);
renameSync(`${out}.part`, out);
console.log(`${out}: ${(page.length / 1024).toFixed(0)} KiB`);
