// Tests <gsv-view> in a plain page of another origin, which has only the address of the viewer.
import assert from "node:assert/strict";
import { once } from "node:events";
import http from "node:http";
import { after, before, test } from "node:test";
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
  assert.match(await view.locator("[role=img]").getAttribute("aria-label"), /Arrow keys turn it/);
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
