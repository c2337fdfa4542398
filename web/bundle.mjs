// Puts the modules of the package together: node web/bundle.mjs OUT, with OUT/decoder.wasm and
// OUT/node_modules there.

import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";

const web = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2]);
const esbuild = createRequire(join(out, "package.json"))("esbuild");

const common = {
  bundle: true, format: "esm", minify: true, target: "es2022", legalComments: "none", logLevel: "warning",
  nodePaths: [join(out, "node_modules")],
};

// The worker and the decoder travel inside the module, so that every bundler takes it as it is.
const dist = join(out, "dist");
mkdirSync(dist, { recursive: true });
await esbuild.build({ ...common, entryPoints: [join(web, "src/worker.js")], outfile: join(dist, "decoder-worker.js") });
const embedded = {
  name: "embedded",
  setup(build) {
    build.onResolve({ filter: /\/embedded\.js$/ }, (args) => ({ path: args.path, namespace: "embedded" }));
    build.onLoad({ filter: /.*/, namespace: "embedded" }, () => {
      const wasm = deflateRawSync(readFileSync(join(out, "decoder.wasm")), { level: 9 }).toString("base64");
      const worker = readFileSync(join(dist, "decoder-worker.js"), "utf8");
      return { contents: `export const wasmBase64 = ${JSON.stringify(wasm)}; export const workerSource = ${JSON.stringify(worker)};` };
    });
  },
};
await esbuild.build({ ...common, entryPoints: [join(web, "src/decoder.js")], outfile: join(dist, "decoder.js"), plugins: [embedded] });
await esbuild.build({
  ...common, entryPoints: [join(web, "src/three.js")], outfile: join(dist, "three.js"), external: ["three", "pstrips/decoder"],
});
for (const types of ["decoder.d.ts", "three.d.ts"]) copyFileSync(join(web, "src", types), join(dist, types));
copyFileSync(join(web, "README.md"), join(out, "README.md"));

// The viewer is a page of its own with all that it needs beside it.
const page = join(out, "viewer");
mkdirSync(page, { recursive: true });
await esbuild.build({
  ...common, entryPoints: [join(web, "viewer/viewer.js")], outfile: join(page, "viewer.js"),
  alias: { "pstrips/decoder": join(dist, "decoder.js"), "pstrips/three": join(dist, "three.js") },
});
for (const file of ["index.html", "viewer.css"]) copyFileSync(join(web, "viewer", file), join(page, file));
copyFileSync(join(dist, "decoder-worker.js"), join(page, "decoder-worker.js"));
