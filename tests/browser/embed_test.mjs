// Tests <gsv-view> in a plain page of another origin, which has only the address of the viewer.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { once } from "node:events";
import http from "node:http";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { openBrowser, withTimeout } from "./browser.mjs";
import { changedPixels, isBlank, picture } from "./pixels.mjs";
import { startServer, startView } from "./server.mjs";
import { until } from "./viewing.mjs";

let server;
let relay;
let site;
let browser;
let html = "";

before(async () => {
  server = await startServer(["office", "--robot", "pebble@0,-1.5", "--behaviour", "wander"]);
  relay = await startView([server.url]);
  site = http.createServer((_, answer) => answer.setHeader("content-type", "text/html").end(html)).listen(0, "127.0.0.1");
  await once(site, "listening");
  browser = await openBrowser({ width: 700, height: 500, webgl: false, drawer: null });
});

after(async () => {
  await browser?.close();
  site?.close();
  await relay?.stop();
  await server?.stop();
});

// The page in docs/viewer.md.
const pageFor = (url, attributes = "") => `<!doctype html>
<title>Our lab</title>
<h1>Our lab</h1>
<script src="${url}gsv-view.js"></script>
<gsv-view src="${url}" ${attributes} style="width: 640px"></gsv-view>`;

async function open(content) {
  html = content;
  const page = await browser.context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(error.message));
  await page.goto(`http://127.0.0.1:${site.address().port}/`);
  return { page, faults };
}

async function shown(page) {
  const clip = await page.locator("gsv-view").boundingBox();
  let now;
  await until(async () => !isBlank((now = await picture(page, clip))), "an image of the view");
  return now;
}

test("the element shows the world, and a drag and the keys turn the view", async () => {
  const { page, faults } = await open(pageFor(server.url));
  const first = await shown(page);
  const view = page.locator("gsv-view");
  const { x, y, width, height } = await view.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 150, y + height / 2 + 40, { steps: 5 });
  await page.mouse.up();
  const side = await view.evaluate((element) => element.view);
  assert.ok(Math.abs(side.azimuth - 75) < 0.5 && Math.abs(side.elevation - 50) < 0.5, JSON.stringify(side));
  await until(async () => changedPixels(first, await shown(page)) > 0.05 * width * height, "the turned view");
  await view.locator("[role=img]").focus();
  await page.keyboard.press("+");
  assert.ok((await view.evaluate((element) => element.view.zoom)) > 1.1);
  await page.keyboard.press("Home");
  assert.equal((await view.evaluate((element) => element.view.azimuth)), 135);
  assert.match(await view.locator("[role=img]").getAttribute("aria-label"), /Arrow keys turn the view/);
  assert.deepEqual(faults, []);
  await page.close();
});

test("the element follows a robot, and shows an error for an unknown one", async () => {
  const { page, faults } = await open(pageFor(server.url, 'follow="pebble" label="Pebble at work"'));
  await shown(page);
  const view = page.locator("gsv-view");
  assert.equal(await view.locator("[role=img]").getAttribute("aria-label"), "Pebble at work");
  await view.evaluate((element) => element.setAttribute("follow", "nobody"));
  await view.getByText("cannot be loaded").waitFor();
  // The listener must exist before the change, because the image may arrive at once.
  const again = view.evaluate(
    (element) =>
      new Promise((resolve) => {
        element.addEventListener("image", () => resolve(), { once: true });
        element.setAttribute("follow", "pebble");
      }),
  );
  await withTimeout(again, 30_000, "the view again");
  await view.getByText("cannot be loaded").waitFor({ state: "hidden" });
  assert.deepEqual(faults, []);
  await page.close();
});

test("the element shows a simulation through a relay", async () => {
  const { page, faults } = await open(pageFor(relay.url));
  await shown(page);
  assert.deepEqual(faults, []);
  await page.close();
});

// Loads only the module of notebooks, which does not need the compiled part of the package.
const NOTEBOOK = `
import sys, types
gsv = sys.modules["gsv"] = types.ModuleType("gsv")
gsv.__path__ = [sys.argv[1]]
from gsv.notebook import view
print(view(sys.argv[2], width="600px", height="300px", follow="pebble")._repr_html_())
`;
const MODULE = fileURLToPath(new URL("../../sdk/python/gsv", import.meta.url));

test("gsv.view() of a notebook shows the world, also in a notebook that runs no scripts", async () => {
  const made = spawnSync("python3", ["-B", "-c", NOTEBOOK, MODULE, server.url], { encoding: "utf8" });
  assert.equal(made.status, 0, made.stderr);
  const { page, faults } = await open(made.stdout);
  await shown(page);
  const { width, height } = await page.locator("gsv-view").boundingBox();
  assert.deepEqual([width, height], [600, 300]);
  assert.equal(await page.locator("gsv-view").evaluate((view) => view.querySelector("img").checkVisibility()), false, "only one view is seen");
  await page.close();
  const { page: plain } = await open(made.stdout.replace(/<script.*<\/script>/, ""));
  await plain.waitForFunction(() => document.images[0]?.naturalWidth > 0);
  const image = await picture(plain, await plain.locator("img").boundingBox());
  assert.equal(isBlank(image), false);
  assert.deepEqual(faults, []);
  await plain.close();
});
