// The decoder of the package in Node: node --test decoder_test.mjs, with WEB and MODELS as for
// browser_test.mjs.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

const web = process.env.WEB, models = process.env.MODELS;
const { ProgressiveDecoder, PStripError } = await import(pathToFileURL(join(web, "dist/decoder.js")));
const bunny = readFileSync(join(models, "bunny-compact.pstrip"));

function* pieces(bytes, size) {
  for (let at = 0; at < bytes.length; at += size) yield bytes.subarray(at, at + size);
}

async function levelsOf(source, until, options = {}) {
  const decoder = new ProgressiveDecoder({ workers: 0, ...options });
  const levels = [];
  let error;
  try {
    for await (const { meshes, changes, ...level } of decoder.decode(source, until)) levels.push({ ...level, meshes, changes });
  } catch (thrown) {
    error = thrown;
  }
  decoder.dispose();
  return { levels, error };
}

test("levels grow up to the whole model, whatever the pieces", async () => {
  for (const source of [bunny, pieces(bunny, 10000), new Response(bunny), new Blob([bunny]).stream()]) {
    const { levels, error } = await levelsOf(source);
    assert.equal(error, undefined);
    assert.equal(levels[0].type, "base");
    assert.ok(levels.length > 2 && levels.every((level, i) => !i || level.triangles >= levels[i - 1].triangles));
    const last = levels.at(-1);
    assert.ok(last.complete && last.error === 0 && last.bytes === bunny.length);
    assert.equal(last.triangles, last.meshes[0].indices.length / 3);
    assert.ok(levels.slice(0, -1).every((level) => !level.complete));
  }
});

test("display strips show the triangles", async () => {
  const { levels } = await levelsOf(bunny, {}, { strips: true });
  const { strips, triangles, indices } = levels.at(-1).meshes[0];
  const key = ([a, b, c]) => (a < b && a < c ? [a, b, c] : b < c ? [b, c, a] : [c, a, b]).join();
  const shown = [];
  for (let i = 0, first = 0; i < strips.length; ++i) {
    if (strips[i] === 0xffffffff) first = i + 1;
    else if (i >= first + 2) {
      const [a, b, c] = strips.subarray(i - 2, i + 1);
      if (a !== b && b !== c && a !== c) shown.push(key((i - first) % 2 ? [b, a, c] : [a, b, c]));
    }
  }
  const listed = Array.from({ length: triangles }, (_, i) => key(indices.subarray(3 * i, 3 * i + 3)));
  assert.deepEqual(shown.sort(), listed.sort());
});

test("a limit ends at the first level that reaches it", async () => {
  const enough = await levelsOf(bunny, { maxTriangles: 20000 });
  assert.ok(enough.levels.at(-1).triangles >= 20000 && enough.levels.at(-1).triangles < 30000);
  assert.equal(enough.error, undefined);
  const near = await levelsOf(bunny, { maxError: 0.001 });
  assert.ok(near.levels.at(-1).error <= 0.001 && !near.levels.at(-1).complete);
  const short = await levelsOf(pieces(bunny, 7000), { maxBytes: 30000 });
  assert.ok(short.levels.at(-1).bytes <= 30000 && short.levels.at(-1).bytes > 15000);
  assert.equal(short.error, undefined);
});

test("truncated, corrupt and over limit are three answers, after what could be shown", async () => {
  const cut = await levelsOf(bunny.subarray(0, 50000));
  assert.ok(cut.error instanceof PStripError && cut.error.code === "truncated" && cut.error.offset === 50000);
  assert.ok(cut.levels.at(-1).triangles > 0);
  const spoilt = Buffer.from(bunny);
  spoilt[60000] ^= 1;
  const broken = await levelsOf(spoilt);
  assert.ok(broken.error.code === "corrupt" && broken.error.offset > 0 && broken.error.offset <= 60000);
  assert.ok(broken.levels.at(-1).triangles > 0);
  const large = await levelsOf(bunny, {}, { maxMemory: 100000 });
  assert.equal(large.error.code, "over limit");
  const foreign = await levelsOf(new TextEncoder().encode("solid model"));
  assert.equal(foreign.error.code, "corrupt");
});

test("a signal and dispose() end a decode", async () => {
  const stop = new AbortController();
  await assert.rejects(async () => {
    for await (const _ of new ProgressiveDecoder({ workers: 0 }).decode(bunny, { signal: stop.signal })) stop.abort();
  }, { name: "AbortError" });
  const decoder = new ProgressiveDecoder({ workers: 0 });
  await assert.rejects(async () => {
    for await (const _ of decoder.decode(bunny)) decoder.dispose();
  }, { name: "AbortError" });
  await assert.rejects(() => decoder.decode(bunny).next(), { code: "bad argument" });
});

test("a hundred loads leave no memory behind", async () => {
  const small = readFileSync(join(models, "textured.pstrip"));
  const rounds = async (count) => {
    for (let i = 0; i < count; ++i) await levelsOf(small);
    for (let i = 0; i < 5; ++i) {
      global.gc();
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    const { heapUsed, external, arrayBuffers } = process.memoryUsage();
    return heapUsed + external + arrayBuffers;
  };
  const before = await rounds(20), after = await rounds(100);
  assert.ok(after < before + 4e6, `${after - before} bytes more`);
});

test("the packed package can be installed and bundled", () => {
  const project = mkdtempSync(join(tmpdir(), "pstrips-"));
  try {
    const npm = (...args) => execFileSync("npm", args, { cwd: project, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
    const packed = JSON.parse(npm("pack", web, "--json", "--pack-destination", project))[0];
    writeFileSync(join(project, "package.json"), JSON.stringify({ type: "module" }));
    npm("install", "--no-audit", "--no-fund", join(project, packed.filename));
    writeFileSync(join(project, "main.js"), `
      import { readFileSync } from "node:fs";
      import { ProgressiveDecoder } from "pstrips/decoder";
      let triangles;
      for await (const level of new ProgressiveDecoder({ workers: 0 }).decode(readFileSync(process.argv[2]))) triangles = level.triangles;
      console.log(triangles);`);
    execFileSync(join(web, "node_modules/.bin/esbuild"), ["main.js", "--bundle", "--format=esm", "--platform=node", "--outfile=out.js"], { cwd: project, stdio: "ignore" });
    const printed = execFileSync("node", ["out.js", join(models, "bunny-compact.pstrip")], { cwd: project, encoding: "utf8" });
    assert.ok(Number(printed) > 60000, printed);
    const names = packed.files.map((file) => file.path).sort();
    assert.deepEqual(names, ["README.md", "dist/decoder-worker.js", "dist/decoder.d.ts", "dist/decoder.js", "dist/three.d.ts", "dist/three.js", "package.json"]);
  } finally {
    rmSync(project, { recursive: true });
  }
});
