// Tests that a replay shows a whole recording at once: the curve of a value from start to end, and
// the log. A click on the curve or the log goes to its instant.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { readPoses } from "./recorded_poses.mjs";
import { record, startReplay } from "./server.mjs";
import { ask, settled, until } from "./viewing.mjs";

const DURATION_S = 20;
const ROBOT = "pebble";
const LEFT_PX = 54; // of the plot's axis, see web/src/plot/TimeCharts.ts
const RIGHT_PX = 10;

let folder;
let recorded;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-whole-"));
  const file = path.join(folder, "run.mcap");
  const robots = ["b21r@-5,-1.5,0", "pebble@-2,0"].flatMap((robot) => ["--robot", robot]);
  const pace = ["--behaviour", "wander", "--lockstep", "--seed", "3", "--duration", String(DURATION_S)];
  await record(file, ["office", ...robots, ...pace]);
  recorded = await readPoses(file);
  server = await startReplay([file, "--paused"]);
  browser = await openBrowser({ width: 1200, height: 960 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const canvas = () => page.getByRole("img", { name: "Plot", exact: true });

async function placeOnPlot(time) {
  const { x, y, width, height } = await canvas().boundingBox();
  return { x: x + LEFT_PX + (time / DURATION_S) * (width - LEFT_PX - RIGHT_PX), y: y + height / 2 };
}

// Returns the content of the table of curves: [[time, value, …], …]
async function table() {
  const [file] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save as CSV" }).click(),
  ]);
  const [head, ...lines] = fs.readFileSync(await file.path(), "utf8").trim().split("\r\n");
  return { head, rows: lines.map((line) => line.split(",").map((cell) => (cell === "" ? null : Number(cell)))) };
}

// Returns the robot's position at each recorded pose: [[time, x], …]
async function recordedPlaces() {
  const { bodies, poses } = await ask(page, "/scene");
  const entry = poses.findIndex(({ body, link }) => bodies[body].name === ROBOT && link === null);
  return recorded.map(({ time, poses: numbers }) => [time, numbers[7 * entry]]);
}

async function standsAt(time, tolerance) {
  await until(
    async () => Math.abs((await page.evaluate(() => window.gsv.time)) - time) <= tolerance,
    `the instant ${time}`,
  );
}

test("a value is plotted over the whole recording before any of it was played", async () => {
  await page.locator(`[data-robot="${ROBOT}"]`).click();
  await page.getByRole("button", { name: "Plots", exact: true }).click();
  const added = page.getByRole("combobox", { name: "Add a curve" });
  await added.selectOption("robot x");
  const shown = page.getByRole("combobox", { name: "Time shown" });
  assert.equal(await shown.evaluate((each) => each.selectedOptions[0].text), "Whole recording");
  const expected = await recordedPlaces();
  let rows;
  await until(async () => {
    ({ rows } = await table());
    return rows.length === expected.length;
  }, "the whole curve");
  assert.equal(rows.at(-1)[0], DURATION_S);
  expected.forEach(([time, x], i) => {
    assert.ok(Math.abs(rows[i][0] - time) < 1e-9, `row ${i} is of ${rows[i][0]} s, not of ${time} s`);
    assert.equal(rows[i][1], x);
  });
  assert.equal(await page.evaluate(() => window.gsv.time), 0);
});

test("a press on the curve goes to that instant, and dragging goes along", async () => {
  const tolerance = (3 * DURATION_S) / (await canvas().boundingBox()).width;
  const first = await placeOnPlot(15);
  await page.mouse.click(first.x, first.y);
  await standsAt(15, tolerance);
  const to = await placeOnPlot(5);
  await page.mouse.move(first.x, first.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 10 });
  await page.mouse.up();
  await standsAt(5, tolerance);
  const { time_s: time } = await ask(page, "/replay");
  assert.ok(Math.abs(time - 5) < tolerance, `the server stands at ${time} s`);
  // After the release, it no longer follows the pointer.
  await page.mouse.move(first.x, first.y, { steps: 3 });
  await settled(page);
  assert.equal((await ask(page, "/replay")).time_s, time);
});

test("a sensor's value is plotted as well, from start to end", async () => {
  await page.locator('[data-sensor="sonar_00"] dd').waitFor();
  await page.getByRole("button", { name: "Plot sonar_00 range" }).click();
  let rows;
  await until(async () => {
    ({ rows } = await table());
    return rows.some(([time, , range]) => range !== null && time > DURATION_S - 1);
  }, "the sonar's curve");
  const first = rows.find(([, , range]) => range !== null);
  assert.ok(first[0] < 1, `its first value is of ${first[0]} s`);
});

test("the log lists and filters all lines, and a click on one goes to its time", async () => {
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press("g");
  const log = page.getByRole("region", { name: "Log" });
  const lines = log.locator(".log-line");
  await lines.first().waitFor();
  assert.deepEqual(await log.locator(".log-text").allTextContents(), ["started", "finished"]);
  assert.deepEqual(
    await lines.evaluateAll((rows) => rows.map((row) => row.classList.contains("to-come"))),
    [false, true],
  );
  await page.keyboard.press("r");
  await settled(page);
  await keepPicture(page, "timeline");
  await log.getByLabel("Search the log").fill("FIN");
  await until(async () => (await lines.count()) === 1, "the one line that fits");
  await lines.first().getByRole("button").click();
  await standsAt(DURATION_S, 1e-6);
  await log.getByLabel("Search the log").fill("nothing like this");
  await log.getByText("No message matches").waitFor();
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
