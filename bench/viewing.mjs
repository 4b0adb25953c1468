#!/usr/bin/env node
// How the viewer feels in a browser without a graphics card: the time to the first picture, from a
// click to the selection that is shown, and frames a second.
//
//   bench/viewing.mjs BUILD [WORLD [picture|clicks|frames]]
//
// BUILD is a release build (build/release); WORLD a world for the first picture, without it the
// TurtleBot3 house in GSV_REAL_DIR. With a third word only that is measured. The machine should do
// nothing else: load_average says whether it did. Prints one JSON object; times in ms.
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import process from "node:process";

const HOUSE = path.join(process.env.GSV_REAL_DIR ?? "", "turtlebot3/worlds/turtlebot3_house.world");
const [build, world = HOUSE, only = ""] = process.argv.slice(2);
if (!build) throw new Error("usage: bench/viewing.mjs BUILD [WORLD [picture|clicks|frames]]");
process.env.GSV_BUILD_DIR = path.resolve(build);
const { openBrowser, openPage, waitUntilDrawn } = await import("../tests/browser/browser.mjs");
const { crowd, noteClicks, timeClicks } = await import("../tests/browser/crowd.mjs");
const { startServer } = await import("../tests/browser/server.mjs");

const PICTURES = 5;
const CLICKS = 20;
const FRAMES_S = 15;
const SIZE = { width: 1280, height: 800 };

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-viewing-"));

function summary(times) {
  const sorted = [...times].sort((a, b) => a - b).map((time) => Math.round(time));
  return { median: sorted[sorted.length >> 1], worst: sorted.at(-1), all: times.map((time) => Math.round(time)) };
}

async function withPage(url, use) {
  const browser = await openBrowser(SIZE);
  try {
    const { page } = await openPage(browser, url);
    await waitUntilDrawn(page, 120_000);
    return await use(page);
  } finally {
    await browser.close();
  }
}

async function withServer(args, use) {
  const server = await startServer(args);
  try {
    return await use(server.url);
  } finally {
    await server.stop();
  }
}

// From the page's address to a picture with every shape, each in a new browser; the first after the
// server's start stands apart.
const firstPicture = () =>
  withServer([world, "--robot", "pebble@-2,-1", "--behaviour", "wander"], async (url) => {
    const times = [];
    for (let i = 0; i <= PICTURES; i++) {
      const browser = await openBrowser(SIZE);
      const page = await browser.context.newPage();
      const begin = performance.now();
      await page.goto(url, { waitUntil: "commit" });
      await page.waitForFunction(() => window.gsv !== undefined);
      await page.evaluate(() => window.gsv.ready);
      times.push(performance.now() - begin);
      await browser.close();
    }
    return { first_after_start: Math.round(times[0]), later: summary(times.slice(1)) };
  });

const clicks = (robots) =>
  withServer(crowd(folder, robots), (url) =>
    withPage(url, async (page) => {
      await noteClicks(page);
      const { list, picture } = await timeClicks(page, CLICKS);
      return { robots, in_the_list: summary(list), in_the_picture: summary(picture) };
    }),
  );

const frames = (robots) =>
  withServer(crowd(folder, robots), (url) =>
    withPage(url, async (page) => {
      const count = () => page.evaluate(() => [window.gsv.frames, performance.now()]);
      const [before, from] = await count();
      await new Promise((resolve) => setTimeout(resolve, FRAMES_S * 1000));
      const [after, to] = await count();
      return { robots, frames_a_second: Math.round((10_000 * (after - before)) / (to - from)) / 10 };
    }),
  );

try {
  const result = { world: path.basename(world), load_average: os.loadavg()[0] };
  const isWanted = (part) => only === "" || only === part;
  if (isWanted("picture") && fs.existsSync(world)) result.first_picture = await firstPicture();
  if (isWanted("clicks")) result.clicks = await clicks(1000);
  if (isWanted("frames")) result.frames = [await frames(100), await frames(1000)];
  console.log(JSON.stringify(result, null, 2));
} finally {
  fs.rmSync(folder, { recursive: true, force: true });
}
