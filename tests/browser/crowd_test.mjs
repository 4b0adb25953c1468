// Tests a page with a thousand robots, drawn without a graphics card: it must answer clicks in the
// list and in the picture, and must not rewrite more of the page than necessary. bench/viewing.mjs
// measures the times.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { clickNoted, crowd, freePlaces, noteClicks, rowOf, rowsWritten, unselectedAt } from "./crowd.mjs";
import { cut, isBlank, picture, showsLabel } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, settled, until, viewClip } from "./viewing.mjs";

const ROBOTS = 1000;
const CLICKS = 5;

let folder;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-crowd-"));
  server = await startServer(crowd(folder, ROBOTS));
  browser = await openBrowser({ width: 1280, height: 800 });
  await browser.context.addInitScript(countDrawing);
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page, 300_000);
  await noteClicks(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const labels = () => page.evaluate(() => window.gsv.labels);

test("a thousand robots are listed and drawn, and they move", async () => {
  await page.getByRole("heading", { name: `${ROBOTS.toLocaleString("en")} robots` }).waitFor();
  const rows = await page.locator("[data-robot]").count();
  assert.ok(rows > 5 && rows < 60, `${rows} rows are there`);
  assert.equal(isBlank(await picture(page, await viewClip(page))), false);
  const time = (await ask(page, "")).time_s;
  await until(async () => (await page.evaluate(() => window.gsv.time)) > time, "the next instant");
});

// Counts the drawing calls of each frame.
function countDrawing() {
  window.testDrawn = 0;
  for (const name of ["drawArrays", "drawArraysInstanced", "drawElements", "drawElementsInstanced"]) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...rest) {
      window.testDrawn += 1;
      return draw.apply(this, rest);
    };
  }
}

test("the robots are drawn with one call for each mesh and material, not one for each robot", async () => {
  const count = () => page.evaluate(() => ({ calls: window.testDrawn, frames: window.gsv.frames }));
  const before = await count();
  await page.waitForFunction((frames) => window.gsv.frames > frames + 5, before.frames);
  const after = await count();
  const calls = (after.calls - before.calls) / (after.frames - before.frames);
  assert.ok(calls >= 3 && calls < 40, `${calls} calls for a frame with ${ROBOTS} robots`);
});

test("a click in the list shows the robot in the inspector", async () => {
  const names = await page.evaluate(() => window.gsv.robots);
  const robot = names.at(-1);
  const row = await rowOf(page, robot);
  const { robot: chosen, inspected } = await clickNoted(page, () => row.click());
  assert.equal(chosen, robot);
  assert.equal(inspected, robot);
});

// A robot has nine sensors, and the server lists two thousand. The sensors of the last robot are
// listed when it is selected.
test("the last robot's camera and sensors are shown when it is selected", async () => {
  const last = await page.evaluate(() => window.gsv.robots.at(-1));
  await page.locator(`[data-robot="${last}"][aria-pressed="true"]`).waitFor();
  await page.locator("li[data-sensor] dd .number", { hasText: /\d/ }).first().waitFor();
  const choice = page.getByRole("combobox", { name: "Camera" });
  if (!(await choice.isVisible())) await page.getByRole("button", { name: "Open camera image" }).click();
  assert.match(await choice.evaluate((select) => select.selectedOptions[0].text), new RegExp(`^${last} `));
  await page.locator(".picture-waiting").waitFor({ state: "hidden" });
  const seen = await page.getByRole("img", { name: "Camera image" }).boundingBox();
  assert.equal(isBlank(await picture(page, seen)), false);
});

test("a click on a robot in the view selects it, or one beside it", async () => {
  const before = await page.locator('[data-robot][aria-pressed="true"]').getAttribute("data-robot");
  const click = async () => {
    const place = (await freePlaces(page)).find(({ name }) => name !== before);
    return clickNoted(page, () => page.mouse.click(place.x, place.y));
  };
  let answer = await click();
  for (let i = 0; i < CLICKS && answer.robot === null; i++) {
    // The robot had moved away.
    const row = await rowOf(page, before);
    await clickNoted(page, () => row.click());
    answer = await click();
  }
  const { robot, inspected } = answer;
  assert.notEqual(robot, null);
  assert.equal(inspected, robot);
  assert.notEqual(robot, before);
});

test("a click in the list rewrites only two rows", async () => {
  const written = [];
  for (let i = 0; i < CLICKS; i++) {
    const row = await rowOf(page, await unselectedAt(page, i / CLICKS));
    const { rows } = await clickNoted(page, () => row.click());
    written.push(rows);
  }
  // The state of a robot in sight may change at the same time, which writes its row.
  written.sort((a, b) => a - b);
  assert.ok(written[0] >= 1 && written[CLICKS >> 1] <= 2, `${written} rows were written`);
});

// Rows out of sight have no layout, so they are not rewritten. Some rows beyond the edge count as
// in sight.
test("a search shows only matching robots in the list and in the view", async () => {
  await page.keyboard.press("Escape"); // the selected robot's name is always shown
  const last = await page.evaluate(() => window.gsv.robots.at(-1));
  const field = page.getByRole("searchbox", { name: "Search robots" });
  await field.fill(`/^${last}$/`);
  await until(async () => (await page.locator("[data-robot]").count()) === 1, "one row");
  await until(async () => (await labels()).every(({ name }) => name === last), "only its label");
  await field.fill("");
  await field.blur(); // the page receives key presses again
  await until(async () => (await page.locator("[data-robot]").count()) > 5, "all rows");
});

// The simulation pauses, because a name moves with its robot while the browser takes the picture.
test("the view shows many names, all of them can be read, and no two overlap", async () => {
  await page.keyboard.press("t");
  await until(async () => (await labels()).length > 60, "names");
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await phaseIs(page, "paused");
  await settled(page);
  const { x, y, width, height } = await viewClip(page);
  const inView = (box) => box.x > x && box.y > y && box.x + box.width < x + width && box.y + box.height < y + height;
  const isOver = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
  const boxes = await labels();
  const seen = await picture(page, { x, y, width, height });
  assert.deepEqual(await labels(), boxes);
  assert.deepEqual(boxes.flatMap((a, i) => boxes.slice(i + 1).filter((b) => isOver(a, b)).map((b) => [a.name, b.name])), []);
  const shown = boxes.filter(inView);
  const isReadable = (box) => showsLabel(cut(seen, { ...box, x: Math.round(box.x - x), y: Math.round(box.y - y) }));
  assert.ok(shown.length > 60, `${shown.length} names are in the view`);
  assert.deepEqual(shown.filter((box) => !isReadable(box)), []);
  await page.getByRole("button", { name: "Resume", exact: true }).click();
  await phaseIs(page, "running");
});

// The beams of all robots would hide everything.
test("without a selected robot no beams are subscribed, and with one only its own", async () => {
  assert.ok(ROBOTS > 20);
  const graph = () => page.evaluate(() => window.gsv.topics);
  await page.keyboard.press("Escape");
  await until(async () => !(await graph()).some((topic) => topic.startsWith("/gsv/beams")), "no beams");
  const row = await rowOf(page, await page.evaluate(() => window.gsv.robots[0]));
  await row.click();
  const robot = await row.getAttribute("data-robot");
  await until(async () => (await graph()).includes(`/gsv/beams/${robot}`), "the beams of one robot");
  assert.equal((await graph()).includes("/gsv/beams"), false);
});

test("only rows in sight are rewritten while the robots move", async () => {
  const written = await rowsWritten(page);
  assert.ok(written >= 1 && written <= ROBOTS / 4, `${written} rows were written`);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
