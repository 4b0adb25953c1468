// Sets up a simulation in the page, from the first click to robots that drive, on `gsv serve`. The
// behaviour is a separate program that is found through the broker.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import process from "node:process";
import { after, before, test } from "node:test";
import { openBrowser, openPage } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { around, changedPixels, isBlank, picture } from "./pixels.mjs";
import { startServe } from "./server.mjs";
import { phaseIs, settled, until, viewClip } from "./viewing.mjs";

let folder;
let server;
let browser;
let page;
let faults;
let behaviour;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-create-"));
  server = await startServe([]);
  browser = await openBrowser({ width: 1200, height: 780 });
  ({ page, faults } = await openPage(browser, server.url));
});

after(async () => {
  await browser?.close();
  if (behaviour && behaviour.exitCode === null) {
    behaviour.kill("SIGINT");
    await once(behaviour, "exit");
  }
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const row = (n) => page.locator(`[data-row="robots[${n}]"]`);
const press = (name, within = page) => within.getByRole("button", { name, exact: true }).click();
const field = (label, within = page) => within.getByLabel(label, { exact: true });

// Waits until the server has answered all requests.
async function answered() {
  await page.locator('.set-up[aria-busy="false"]').waitFor();
  await settled(page);
}

async function fill(label, text, within = page) {
  await field(label, within).fill(text);
  await page.keyboard.press("Tab");
  await answered();
}

async function placeOf(robot) {
  return page.evaluate((name) => window.gsv.robotPosition(name), robot);
}

async function onScreen(robot) {
  const at = await page.evaluate((name) => window.gsv.robotScreenPosition(name), robot);
  assert.ok(at, `${robot} is not in the picture`);
  return at;
}

test("without a simulation the page offers to create one", async () => {
  await page.getByText("No simulation yet").waitFor();
  await press("Create a simulation");
  await page.getByRole("heading", { name: "New simulation" }).waitFor();
  await answered();
  assert.equal(await field("Environment").inputValue(), "office");
  assert.equal(isBlank(await picture(page, await viewClip(page))), false);
});

test("the environment is chosen and shown", async () => {
  const before = await picture(page, await viewClip(page));
  await field("Environment").selectOption("playground");
  await answered();
  const after = await picture(page, await viewClip(page));
  assert.ok(changedPixels(before, after) > 10_000, "another world looks different");
});

test("a missing world shows an error beside the field", async () => {
  await field("Environment").selectOption({ label: "A file or folder…" });
  await page.getByLabel("Environment: A file or folder…").fill("no/such.world");
  await page.keyboard.press("Tab");
  const error = page.locator(".field", { has: field("Environment") }).locator(".field-error");
  await error.filter({ hasText: "no/such.world" }).waitFor();
  await field("Environment").selectOption("playground");
  await answered();
  assert.equal(await error.isVisible(), false);
});

test("without offers the page shows the command to start one, and the offer appears automatically", async () => {
  await page.getByLabel("Model to add").selectOption("pebble");
  await press("Add robot");
  await answered();
  const command = await page.locator(".offers-hint code").innerText();
  assert.match(command, /^gsv-wander --broker corbaloc:/);
  const [, ...args] = command.split(" ");
  behaviour = spawn(path.join(process.env.GSV_BUILD_DIR, "bin", "gsv-wander"), args, { stdio: "ignore" });
  await field("Behaviour", row(0)).locator("option", { hasText: "wander" }).waitFor({ state: "attached" });
  await field("Behaviour", row(0)).selectOption("wander");
  await answered();
  assert.equal(await page.locator(".offers-hint").isVisible(), false);
});

test("a click on the floor puts the chosen robot there, after Place only", async () => {
  await page.keyboard.press("t");
  await settled(page);
  const before = await placeOf("pebble");
  const at = await onScreen("pebble");
  await page.mouse.click(at.x + 60, at.y + 40);
  await settled(page);
  assert.deepEqual(await placeOf("pebble"), before);
  await row(0).getByRole("button", { name: "Place" }).click();
  await page.mouse.click(at.x + 60, at.y + 40);
  await until(async () => {
    const { x, y } = await placeOf("pebble");
    return Math.hypot(x - before.x, y - before.y) > 0.2;
  }, "the robot's new place");
  await answered();
  const shown = await onScreen("pebble");
  assert.ok(Math.hypot(shown.x - at.x - 60, shown.y - at.y - 40) < 12, "it stands where one clicked");
  const { x } = await placeOf("pebble");
  assert.ok(Math.abs(Number(await field("x (m)", row(0)).inputValue()) - x) < 1e-3);
});

test("dragging moves a robot, dragging the arrow's tip rotates it, and undo reverts both", async () => {
  const before = await placeOf("pebble");
  const from = await onScreen("pebble");
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x - 30, from.y - 20, { steps: 4 });
  await page.mouse.move(from.x - 60, from.y - 40, { steps: 4 });
  await page.mouse.up();
  await until(async () => Math.abs((await placeOf("pebble")).x - before.x) > 0.2, "the dragged robot");
  await answered();
  const to = await onScreen("pebble");
  assert.ok(Math.hypot(to.x - from.x + 60, to.y - from.y + 40) < 12, "it stands where it was dropped");

  const heading = field("Heading (°)", row(0));
  const then = Number(await heading.inputValue());
  const tip = await page.evaluate(() => window.gsv.turnHandle());
  await page.mouse.move(tip.x, tip.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y - 60, { steps: 6 }); // north: up in the picture
  await page.mouse.up();
  await until(async () => Math.abs(Number(await heading.inputValue()) - then) > 20, "the turned robot");
  await answered();
  assert.ok(Math.abs(Number(await heading.inputValue()) - 90) < 8, "it heads north");

  await press("Undo");
  await press("Undo");
  await answered();
  const back = await placeOf("pebble");
  assert.ok(Math.hypot(back.x - before.x, back.y - before.y) < 1e-6);
});

test("a robot inside another one shows an error at its row", async () => {
  await press("Add robot");
  await answered();
  const { x, y } = await placeOf("pebble");
  await fill("x (m)", String(x), row(1));
  await fill("y (m)", String(y), row(1));
  await row(1).locator(".field-error", { hasText: "there is no room" }).first().waitFor();
  await fill("y (m)", String(y - 1), row(1));
  await row(1).locator(".field-error").first().waitFor({ state: "hidden" });
  await fill("Name", "<img src=x onerror=alert(1)>", row(1));
  assert.equal(await page.locator(".set-up img, .view img").count(), 0);
  await fill("Name", "second", row(1));
});

test("the set-up is saved as a file and loaded again", async () => {
  await page.getByText("Parameters", { exact: true }).click();
  await fill("Name", "made here", page.locator("details"));
  await fill("Random seed", "7");
  const download = page.waitForEvent("download");
  await press("Save as a scenario file");
  const file = path.join(folder, "made here.yaml");
  await (await download).saveAs(file);
  const saved = JSON.parse(fs.readFileSync(file, "utf8"));
  assert.equal(saved.world, "playground");
  assert.equal(saved.seed, 7);
  assert.deepEqual(
    saved.robots.map(({ name, model, behaviour }) => ({ name, model, behaviour })),
    [
      { name: "pebble", model: "pebble", behaviour: "wander" },
      { name: "second", model: "pebble", behaviour: undefined },
    ],
  );
  await press("Remove robot", row(1));
  await row(1).waitFor({ state: "detached" });
  await field("Scenario file").setInputFiles(file);
  await row(1).waitFor();
  await answered();
  await keepPicture(page, "create");
});

test("a file that is not a scenario is rejected with a sentence", async () => {
  const file = path.join(folder, "torn.yaml");
  fs.writeFileSync(file, "robots: [");
  await field("Scenario file").setInputFiles(file);
  await page.getByText(/torn\.yaml cannot be read as a scenario/).waitFor();
  assert.equal(await row(1).count(), 1);
});

test("the created simulation is shown, and its robot is driven by the behaviour", async () => {
  await press("Create");
  await phaseIs(page, "created");
  assert.deepEqual(await page.evaluate(() => window.gsv.robots), ["pebble", "second"]);
  await until(async () => (await placeOf("pebble")) !== null, "the robot's pose");
  const start = { pebble: await placeOf("pebble"), second: await placeOf("second") };
  await press("Start");
  await phaseIs(page, "running");
  await until(async () => {
    const { x, y } = await placeOf("pebble");
    return Math.hypot(x - start.pebble.x, y - start.pebble.y) > 0.1;
  }, "the wandering robot");
  const still = await placeOf("second");
  assert.ok(Math.hypot(still.x - start.second.x, still.y - start.second.y) < 1e-6);
});

test("cancelling a second set-up returns to the first simulation", async () => {
  await press("New simulation");
  await answered();
  await press("Cancel");
  await phaseIs(page, "running");
  const names = await (await fetch(`${server.url}api/simulations`)).json();
  assert.deepEqual(names.map(({ name }) => name), ["made here"]);
  assert.deepEqual(faults.filter((fault) => !/status of 422/.test(fault)), []);
});
