// Tests that a viewer over a slow network shows the newest state and reports the slow connection.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, afterEach, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { crowd } from "./crowd.mjs";
import { startServer } from "./server.mjs";
import { SLOW_HOST, openSlowLink } from "./slow_link.mjs";
import { until } from "./viewing.mjs";

const SLOW = 25_000; // bytes per second
const MAX_AGE_S = 1;
const SENTENCE = "The connection is slow: the server leaves out older updates";

const ROBOTS = 50; // their poses, status and readings need at least 90 kB/s

let folder;
let link;
let server;
let browser;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-slow-"));
  server = await startServer([...crowd(folder, ROBOTS), "--allow-host", SLOW_HOST]);
  link = await openSlowLink(server.url);
  browser = await openBrowser({ width: 900, height: 600 });
});

afterEach(() => link.limit(Infinity));

after(async () => {
  await browser?.close();
  await link?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

// Queries the server directly, not over the slow network.
const serverTime = async () => (await (await fetch(`${server.url}api/simulations`)).json())[0].time_s;

// The minimum age of the state that the page shows, in simulated seconds, which equal wall-clock
// seconds.
async function ageOf(page) {
  const now = await serverTime();
  return now - (await page.evaluate(() => window.gsv.time));
}

async function medianAge(page) {
  const ages = [];
  for (let i = 0; i < 9; ++i) ages.push(await ageOf(page));
  return ages.sort((a, b) => a - b)[4];
}

test("over a slow network the state is new, and the page says that the connection is slow", async () => {
  const { page, faults } = await openPage(browser, link.url);
  await waitUntilDrawn(page);
  const problem = page.getByTestId("connection-problem");
  await until(async () => (await problem.textContent()) === "", "a fast connection");
  const began = await serverTime();
  link.limit(SLOW);
  await problem.getByText(SENTENCE).waitFor();
  await until(async () => (await serverTime()) > began + 10, "ten seconds of the slow network");
  await until(async () => (await medianAge(page)) < MAX_AGE_S, "a state that is new");
  link.limit(Infinity);
  await problem.getByText(SENTENCE).waitFor({ state: "hidden", timeout: 120_000 });
  assert.deepEqual(faults, []);
  await page.close();
});

// At first, the server only detects late confirmations. So the page may report a slow connection for
// some seconds, until it has measured its own speed.
test("if only the page is slow, it says so", async () => {
  const { page, faults } = await openPage(browser, link.url);
  await waitUntilDrawn(page);
  await page.evaluate((busyMs) => {
    const work = () => {
      const end = performance.now() + busyMs;
      while (performance.now() < end);
      window.testWork = setTimeout(work, 20);
    };
    work();
  }, 4000);
  await page.getByTestId("connection-problem").getByText("This page is slow: the browser is busy").waitFor({ timeout: 120_000 });
  await page.evaluate(() => clearTimeout(window.testWork));
  await page.getByTestId("connection-problem").getByText(/./).waitFor({ state: "hidden", timeout: 120_000 });
  // A page that is busy when it connects may send its request to /api/viewers/me too late.
  assert.deepEqual(faults.filter((fault) => !fault.includes("/api/viewers/me")), []);
  await page.close();
});

test("a network that passes nothing for a while does not hold up the simulation, and the page catches up", async () => {
  const { page, faults } = await openPage(browser, link.url);
  await waitUntilDrawn(page);
  link.limit(0);
  const began = await serverTime();
  await until(async () => (await serverTime()) > began + 5, "five seconds of simulated time");
  link.limit(Infinity);
  const ended = await serverTime();
  await until(() => page.evaluate((time) => window.gsv.time >= time, ended), "the page's next instant");
  assert.deepEqual(faults, []);
  await page.close();
});

// The widths of the view's images in pixels, as they arrive at the page.
function noteImages() {
  window.testImages = [];
  const decode = window.createImageBitmap;
  window.createImageBitmap = async (...given) => {
    const bitmap = await decode(...given);
    window.testImages.push(bitmap.width);
    return bitmap;
  };
}

test("over a slow network the server's images become smaller, and large again afterwards", async () => {
  const other = await openBrowser({ width: 1024, height: 680, drawer: null, webgl: false });
  try {
    await other.context.addInitScript(noteImages);
    const { page, faults } = await openPage(other, link.url);
    await waitUntilDrawn(page);
    const width = await page.evaluate(() => window.testImages.at(-1));
    const canvasWidth = () => page.evaluate(() => document.querySelector(".drawn-view").width);
    const former = await canvasWidth();
    link.limit(SLOW / 2);
    await page.waitForFunction((first) => window.testImages.at(-1) < first, width, { timeout: 120_000 });
    assert.equal(await canvasWidth(), former); // so labels stay at their robots
    link.limit(Infinity);
    await page.waitForFunction((first) => window.testImages.at(-1) === first, width, { timeout: 120_000 });
    assert.deepEqual(faults, []);
  } finally {
    await other.close();
  }
});
