// The loader and the viewer in a real browser: node --test browser_test.mjs, with WEB the folder that
// web/build fills, MODELS one of models with their .pstrip beside them.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";

import { serve } from "./server.mjs";

const web = process.env.WEB, models = process.env.MODELS;
const require = createRequire(join(web, "package.json"));
const { chromium } = require("playwright-core");
const here = dirname(fileURLToPath(import.meta.url));

let server, browser;
before(async () => {
  server = await serve({
    viewer: join(web, "viewer"), dist: join(web, "dist"), npm: join(web, "node_modules"), pages: join(here, "pages"), models,
  });
  browser = await chromium.launch({
    executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
});
after(async () => {
  await browser?.close();
  server?.close();
});

async function harness() {
  const page = await browser.newPage();
  await page.goto(`${server.origin}/pages/compare.html`);
  await page.waitForSelector("body[data-ready]", { state: "attached" });
  return page;
}

for (const [original, ours] of [
  ["bunny.obj", "bunny-compact.pstrip"], ["bunny.obj", "bunny-plain.pstrip"], ["charts.glb", "textured.pstrip"],
  ["instances.gltf", "instances.pstrip"],
])
  test(`${ours} ends as three's own loader shows ${original}`, async () => {
    const page = await harness();
    const result = await page.evaluate(([a, b]) => window.compare(a, b), [`/models/${original}`, `/models/${ours}`]);
    console.log(JSON.stringify(result));
    assert.ok(result.complete);
    assert.ok(result.atEnd.covered > 10000, "there is something in the picture");
    assert.ok(result.atEnd.differ <= 0.001, `${result.atEnd.differ} of the pixels differ`);
    assert.ok(result.atBase.iou > 0.97, `the base covers ${result.atBase.iou}`);
    await page.close();
  });

const bunny = "/models/bunny-compact.pstrip";
const load = async (url, options) => {
  const page = await harness();
  const result = await page.evaluate(([a, b]) => window.load(a, b), [url, options]);
  await page.close();
  return result;
};

for (const workers of [0, 1]) {
  test(`a connection that breaks leaves the last whole packet, ${workers} workers`, async () => {
    const { error, drawn, complete, levels } = await load(`${bunny}?cut=60000&speed=200000`, { workers });
    assert.equal(error.code, "io");
    assert.equal(complete, false);
    assert.ok(drawn > 0 && drawn === levels.at(-1).triangles, `${drawn} of ${levels.at(-1).triangles}`);
  });
  test(`a spoilt byte is told with its place, ${workers} workers`, async () => {
    const { error, drawn } = await load(`${bunny}?flip=60000`, { workers });
    assert.equal(error.code, "corrupt");
    assert.ok(error.offset > 0 && error.offset <= 60000, `${error.offset}`);
    assert.ok(drawn > 0);
  });
  test(`a load can be stopped, ${workers} workers`, async () => {
    const { error, drawn, complete } = await load(`${bunny}?speed=200000`, { workers, stopAt: 5000 });
    assert.equal(error.name, "AbortError");
    assert.equal(complete, false);
    assert.ok(drawn > 0);
  });
}

test("a server that says no is told as it says it", async () => {
  const { error } = await load(`${bunny}?status=416`);
  assert.equal(error.code, "io");
  assert.match(error.message, /416/);
});

test("the first picture is there after a tenth of the bytes", async () => {
  const { levels } = await load(`${bunny}?speed=100000`);
  assert.ok(levels[0].bytes <= 0.1 * levels.at(-1).bytes, `${levels[0].bytes} of ${levels.at(-1).bytes}`);
});

test("the viewer shows a file under its strict policy, and is usable at 360 pixels", async () => {
  const page = await browser.newPage({ viewport: { width: 360, height: 640 } });
  const complaints = [];
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  await page.goto(`${server.origin}/viewer/index.html?url=${bunny}`);
  await page.waitForSelector('body[data-state="complete"]');
  assert.match(await page.textContent("#error"), /exact/);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= 360), "it scrolls sideways");
  await page.screenshot({ path: join(web, "viewer-360.png") });
  await page.setViewportSize({ width: 1000, height: 640 });
  await page.screenshot({ path: join(web, "viewer.png") });
  for (const colours of ["arrival", "strips", "wire"]) {
    const before = await page.screenshot();
    await page.selectOption("#colours", colours);
    await page.waitForFunction(() => document.getElementById("canvas").dataset.colours === document.getElementById("colours").value);
    assert.notDeepEqual(await page.screenshot(), before, colours);
  }
  await page.fill("#level", "500");
  await page.dispatchEvent("#level", "change");
  await page.waitForFunction(() => Number(document.getElementById("triangles").textContent.replaceAll(",", "")) < 20000);
  assert.deepEqual(complaints.filter((text) => !text.includes("favicon")), []);
  await page.close();
});

test("the viewer has no serious fault of accessibility", async () => {
  const page = await browser.newPage({ bypassCSP: true });
  await page.goto(`${server.origin}/viewer/index.html?url=${bunny}`);
  await page.waitForSelector('body[data-state="complete"]');
  await page.addScriptTag({ path: require.resolve("axe-core") });
  const { violations } = await page.evaluate(() => window.axe.run());
  const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  assert.deepEqual(serious.map(({ id, nodes }) => `${id}: ${nodes[0].html}`), []);
  await page.close();
});
