// Tests changes of the robots in a paused simulation, and recordings of it.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { program, startServer } from "./server.mjs";
import { ask, phaseIs, settled, until } from "./viewing.mjs";

const RUN = ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander"];

let server;
let browser;
let page;
let faults;
let other; // a second viewer

before(async () => {
  server = await startServer(RUN);
  browser = await openBrowser({ width: 1100, height: 700 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const press = (name) => page.getByRole("button", { name, exact: true }).click();
const robots = () => page.evaluate(() => window.gsv.robots);
const placeNow = async (name) => (await ask(page, "")).robots.find((robot) => robot.name === name)?.pose;
const distance = (a, b) => Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m);

async function notBusy() {
  await page.waitForFunction(() => {
    const [undo, redo] = document.querySelectorAll(".edit-buttons button");
    return !undo.disabled || !redo.disabled;
  });
  await settled(page);
}

test("editing pauses the simulation and explains what can be done", async () => {
  await phaseIs(page, "running");
  await press("Edit");
  await phaseIs(page, "paused");
  await page.getByRole("region", { name: "Edit" }).getByText("Click a robot or an object to select it").waitFor();
  await page.getByRole("region", { name: "Edit" }).locator("option", { hasText: "rover4" }).waitFor({ state: "attached" });
});

test("dragging a robot moves it on the server, and undo reverts it", async () => {
  await page.keyboard.press("t");
  await settled(page);
  const before = await placeNow("pebble");
  const at = await page.evaluate(() => window.gsv.robotScreenPosition("pebble"));
  // Returns a place towards the middle of the room: x is to the right, y upwards.
  const pixels = 45 / Math.hypot(before.x_m, before.y_m);
  const by = { x: -before.x_m * pixels, y: before.y_m * pixels };
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + by.x / 2, at.y + by.y / 2, { steps: 3 });
  await page.mouse.move(at.x + by.x, at.y + by.y, { steps: 3 });
  await page.mouse.up();
  await until(async () => distance(await placeNow("pebble"), before) > 0.1, "the moved robot");
  await notBusy();
  const after = await page.evaluate(() => window.gsv.robotScreenPosition("pebble"));
  assert.ok(Math.hypot(after.x - at.x - by.x, after.y - at.y - by.y) < 12, "it stands where it was dropped");
  await page.keyboard.press("Control+z");
  await until(async () => distance(await placeNow("pebble"), before) < 1e-9, "the robot where it was");
  await notBusy();
  await press("Redo");
  await until(async () => distance(await placeNow("pebble"), before) > 0.1, "the robot moved again");
  await notBusy();
});

test("a robot with a behaviour is added, removed, and restored at its place", async () => {
  const panel = page.getByRole("region", { name: "Edit" });
  await press("Robot or object");
  await panel.getByLabel("Model", { exact: true }).selectOption("rover4");
  await panel.getByLabel("Behaviour", { exact: true }).selectOption("wander");
  await press("Add");
  await until(async () => (await robots()).includes("rover4"), "the added robot");
  await notBusy();
  const stood = await placeNow("rover4");
  await page.locator('[data-robot="rover4"]').click();
  await keepPicture(page, "edit");
  await page.keyboard.press("Delete");
  await until(async () => !(await robots()).includes("rover4"), "the robot's end");
  await notBusy();
  await press("Undo");
  await until(async () => (await robots()).includes("rover4"), "the robot again");
  await notBusy();
  assert.ok(distance(await placeNow("rover4"), stood) < 1e-6);
});

test("the inspector shows the pose of a moved robot", async () => {
  await page.locator('[data-robot="pebble"]').click();
  const inspector = page.getByRole("region", { name: "Selected robot" });
  for (const place of [{ x: 1.25, y: -1.5 }, { x: -1.25, y: -1.5 }]) {
    await ask(page, "/bodies/pebble/place", place);
    await inspector.getByText(`${place.x.toFixed(2)}, ${place.y.toFixed(2)}, `).waitFor();
  }
});

test("moving a robot onto another one is rejected with a sentence", async () => {
  const before = await placeNow("rover4");
  const { x_m: x, y_m: y } = await placeNow("pebble");
  const refused = await ask(page, "/bodies/rover4/place", { x, y });
  assert.match(refused.error, /there is no room .* "pebble"/);
  assert.deepEqual(await placeNow("rover4"), before);
});

test("after resuming, the added robot drives and editing has ended", async () => {
  const before = await placeNow("rover4");
  await press("Resume");
  await phaseIs(page, "running");
  await page.getByRole("region", { name: "Edit" }).waitFor({ state: "hidden" });
  await until(async () => distance(await placeNow("rover4"), before) > 0.1, "the driving robot");
});

test("a recording is started, which another viewer sees, and stopped", async () => {
  ({ page: other } = await openPage(browser, server.url));
  const record = (of) => of.getByRole("button", { name: "Record", exact: true });
  await record(page).click();
  await other.locator('.record[aria-pressed="true"]').waitFor();
  const { path } = await ask(page, "/recording");
  await ask(page, "/pause", {});
  await ask(page, "/bodies/pebble/place", { x: 0, y: -1.5 });
  try {
    await record(other).click();
    await other.getByRole("button", { name: "End recording" }).click(); // this viewer has not started the recording
    await other.getByText("Recording saved. Replay it on the page Recordings").waitFor();
    await page.locator('.record[aria-pressed="false"]').waitFor();
    assert.ok(fs.statSync(path).size > 1000);
    // Edits before the start of the recording are not in it, and the page reports this.
    const again = spawnSync(program(), ["replay", path, "--resimulate"], { encoding: "utf8" });
    assert.match(again.stderr, /it starts at \d+\.\d+ s, in the middle of the run/);
    assert.equal(again.status, 2);
  } finally {
    fs.rmSync(path, { force: true });
  }
  // On a busy machine, a robot may be removed before the page requests its model or its sensors'
  // topics.
  const expected = /status of 422|status of 404 .*(\/api\/models\/|\/robots\/rover4\/topics)/;
  assert.deepEqual(faults.filter((fault) => !expected.test(fault)), []);
});
