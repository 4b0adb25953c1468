// Adds, rotates and removes objects in a paused simulation, and simulates the recorded run again.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { readTopic } from "./recorded_poses.mjs";
import { program, startServer } from "./server.mjs";
import { ask, phaseIs, settled, until } from "./viewing.mjs";

const RUN = ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander"];
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-edited-"));
const recording = path.join(folder, "edited.mcap");

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer([...RUN, "--record", recording]);
  browser = await openBrowser({ width: 1100, height: 700 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  fs.rmSync(folder, { recursive: true, force: true });
});

const press = (name) => page.getByRole("button", { name, exact: true }).click();
const body = async (name) => (await ask(page, "/scene")).bodies.find((each) => each.name === name);
const place = async (name) => (await body(name))?.pose;
const onScreen = (name) => page.evaluate((name) => window.gsv.robotScreenPosition(name), name);
const model = () => page.getByRole("region", { name: "Edit" }).getByLabel("Model", { exact: true });
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const yawOf = ([, , , x, y, z, w]) => Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));

// Waits until the page shows the server's state.
async function shown(name, isThere = true) {
  await page.locator(".world-tree li", { hasText: name }).waitFor({ state: isThere ? "attached" : "detached" });
  await settled(page);
}

// Returns the titles of both buttons. The titles differ after each press, even if two edits are
// equal.
const offered = () =>
  page.evaluate(() => ["Undo", "Redo"].map((each) => document.querySelector(`.edit [aria-label="${each}"]`).title).join());

async function pressAsOftenAsItGoes(name) {
  const button = page.locator(`.edit [aria-label="${name}"]`);
  for (let times = 0; ; ++times) {
    await settled(page);
    if (await button.isDisabled()) return times;
    const before = await offered();
    await button.click();
    await until(async () => (await offered()) !== before, "what comes of the press");
  }
}

test("an added object is placed and selected", async () => {
  await phaseIs(page, "running");
  await press("Edit");
  await phaseIs(page, "paused");
  await page.locator(".edit option", { hasText: "crate" }).waitFor({ state: "attached" });
  await page.keyboard.press("t");
  await settled(page);
  await press("Robot or object");
  await model().selectOption({ label: "crate" });
  await press("Add");
  await shown("crate");
  assert.equal((await body("crate")).is_fixed, false);
  await page.getByText("crate is selected").waitFor();
});

test("an object is rotated by a number, and by a key", async () => {
  const yaw = page.getByRole("region", { name: "Pose" }).getByLabel("Yaw (°)");
  await yaw.fill("90");
  await yaw.press("Enter");
  await until(async () => Math.abs(yawOf(await place("crate")) - Math.PI / 2) < 1e-6, "the turned crate");
  await yaw.blur();
  const turned = yawOf(await place("crate"));
  await page.waitForFunction(() => !document.querySelector('.edit [aria-label="Undo"]').disabled);
  await settled(page);
  await page.keyboard.press("]");
  await until(async () => Math.abs(yawOf(await place("crate")) - turned + Math.PI / 12) < 1e-6, "15° less");
});

test("a click on the floor puts it there after Place only, which another viewer sees", async () => {
  const { page: other } = await openPage(browser, server.url);
  await waitUntilDrawn(other);
  const at = await onScreen("crate");
  const before = await place("crate");
  await page.mouse.click(at.x + 70, at.y - 50);
  await settled(page);
  assert.ok(distance(await place("crate"), before) < 1e-6);
  await press("Place");
  await page.getByText("Click the floor to place crate there").waitFor();
  await page.mouse.click(at.x + 70, at.y - 50);
  await until(async () => distance(await place("crate"), before) > 0.5, "the moved crate");
  await settled(page);
  const now = await onScreen("crate");
  assert.ok(Math.hypot(now.x - at.x - 70, now.y - at.y + 50) < 12, "it stands where the click was");
  await other.locator(".world-tree li", { hasText: "crate" }).waitFor({ state: "attached" });
  await settled(other);
  const there = await other.evaluate(() => window.gsv.robotScreenPosition("crate"));
  assert.notEqual(there, null);
  await other.close();
});

test("removal is undone, and all edits can be undone and redone", async () => {
  await press("Robot or object");
  await model().selectOption({ label: "can" });
  await press("Add");
  await shown("can");
  const stood = await place("can");
  await page.locator(".world-tree summary").click();
  await page.locator('[data-object="crate"]').click();
  await page.getByText("crate is selected").waitFor();
  await page.keyboard.press("r");
  await settled(page);
  await keepPicture(page, "edit-objects");
  await page.locator('[data-object="can"]').click();
  await page.keyboard.press("Delete");
  await shown("can", false);
  await press("Undo");
  await shown("can");
  assert.ok(distance(await place("can"), stood) < 1e-6);
  const crate = await place("crate");
  assert.equal(await pressAsOftenAsItGoes("Undo"), 5); // the can, a move, two turns, the crate
  await shown("crate", false);
  assert.equal(await body("can"), undefined);
  assert.equal(await pressAsOftenAsItGoes("Redo"), 6);
  assert.ok(distance(await place("crate"), crate) < 1e-6);
  assert.ok(Math.abs(yawOf(await place("crate")) - yawOf(crate)) < 1e-6);
  assert.equal(await body("can"), undefined); // Redo removed the can again
  await press("Undo");
  await shown("can");
});

test("impossible edits are rejected with a sentence", async () => {
  const refusal = async (what) => (await ask(page, "/objects", what)).error;
  assert.match(await refusal({ model: "can", x: 5.1, y: 0 }), /no room at \(5\.1, 0\): .* "east_wall"/);
  assert.match(await refusal({ model: "unicorn", x: 1, y: 1 }), /unicorn/);
  assert.match(await refusal({ model: "can", name: "crate", x: 1, y: 1 }), /there is already a body of this name/);
  assert.match(await refusal({ model: "can", x: "left", y: 1 }), /./);
  assert.match(await refusal({ model: "pebble", x: 1, y: 1 }), /as a robot/);
  assert.match((await ask(page, "/bodies/east_wall/place", { x: 1, y: 1 })).error, /fixed to the world/);
});

test("nothing can be edited after the simulation has resumed", async () => {
  await press("Resume");
  await phaseIs(page, "running");
  const then = await page.evaluate(() => window.gsv.time);
  assert.match((await ask(page, "/objects", { model: "can", x: 1, y: 1 })).error, /must be created or paused/);
  await page.waitForFunction((then) => window.gsv.time > then + 1, then);
  assert.deepEqual(faults.filter((fault) => !/status of 4\d\d/.test(fault)), []);
});

test("the recording contains the edits, and simulating it again gives the same result", async () => {
  await browser.close();
  browser = undefined;
  await server.stop();
  server = undefined;
  const edits = (await readTopic(recording, "/gsv/edits")).map(({ message }) => message);
  assert.deepEqual(
    edits.slice(0, 4).map(({ kind, body }) => `${kind} ${body}`),
    ["add_object crate", "place crate", "place crate", "place crate"],
  );
  assert.match(edits[0].model, /crate\/model\.sdf$/);
  assert.ok(edits.some(({ copy_of }) => copy_of === "can"));
  const again = spawnSync(program(), ["replay", recording, "--resimulate", "--commands", "--json"], { encoding: "utf8" });
  assert.equal(JSON.parse(again.stdout).equal, true, again.stdout + again.stderr);
  assert.equal(again.status, 0);
});

// Uses the API and not the page: it counts steps, so that the behaviours' decisions can be repeated
// too.
test("in lockstep, a run with live behaviours repeats its edits exactly", async () => {
  const file = path.join(folder, "lockstep.mcap");
  server = await startServer([...RUN, "--lockstep", "--record", file]);
  const api = `${server.url}api/simulations/simulation`;
  const post = async (what, content = {}) => {
    const headers = { "content-type": "application/json" };
    const answer = await fetch(`${api}${what}`, { method: "POST", headers, body: JSON.stringify(content) });
    const text = await answer.text();
    assert.ok(answer.ok, `${what}: ${text}`);
    return JSON.parse(text);
  };
  const phase = async () => (await (await fetch(api)).json()).phase;
  const halt = () => until(async () => (await phase()) === "paused", "the pause");
  await until(async () => (await phase()) === "running", "the run");
  await post("/pause"); // at some moment in the behaviours' cycles
  await post("/objects", { model: "can", x: 1, y: 0 });
  await post("/step", { count: 100 });
  await halt();
  await post("/bodies/can/place", { x: 0, y: 1, roll: 1.5 });
  await post("/robots", { model: "rover4", name: "late", x: -1, y: 0, behaviour: "wander" });
  await post("/objects", { copy_of: "can", x: 1, y: 1, yaw: 1 });
  await post("/step", { count: 100 });
  await halt();
  await fetch(`${api}/objects/can`, { method: "DELETE" });
  await post("/resume");
  await post("/pause");
  await post("/bodies/can_2/place", { x: -1, y: -1 });
  await post("/step", { count: 50 });
  await halt();
  await fetch(`${api}/robots/late`, { method: "DELETE" });
  await post("/step", { count: 50 });
  await halt();
  await server.stop();
  server = undefined;
  const again = spawnSync(program(), ["replay", file, "--resimulate", "--json"], { encoding: "utf8" });
  assert.equal(JSON.parse(again.stdout || "{}").equal, true, again.stdout + again.stderr);
  assert.equal(again.status, 0);
});

// A cart on two wheels, without its own file.
const wheel = (side, y) => `<link name="${side}"><pose>0 ${y} 0 -1.5707963 0 0</pose>
  <collision name="c"><geometry><cylinder><radius>0.15</radius><length>0.05</length></cylinder></geometry></collision></link>
  <joint name="${side}_joint" type="revolute"><parent>base</parent><child>${side}</child><axis><xyz>0 0 1</xyz></axis></joint>`;
const WORLD = `<?xml version="1.0"?><sdf version="1.9"><world name="yard">
  <light name="sun" type="directional"><direction>-0.5 0.2 -1</direction></light>
  <model name="ground"><static>true</static><link name="link">
    <collision name="c"><geometry><plane><normal>0 0 1</normal><size>40 40</size></plane></geometry></collision></link></model>
  <model name="cart"><pose>1 2 0.15 0 0 0.5</pose>
    <link name="base"><collision name="c"><geometry><box><size>0.6 0.4 0.2</size></box></geometry></collision>
      <visual name="v"><geometry><box><size>0.6 0.4 0.2</size></box></geometry></visual></link>
    ${wheel("left", 0.25)}${wheel("right", -0.25)}
    <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
      <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint></plugin>
  </model></world></sdf>`;

test("undo restores a robot of the world file", async () => {
  const world = path.join(folder, "yard.sdf");
  fs.writeFileSync(world, WORLD);
  server = await startServer([world, "--robot", "pebble@-2,0", "--behaviour", "wander"]);
  browser = await openBrowser({ width: 1100, height: 700 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
  await press("Edit");
  await phaseIs(page, "paused");
  const stood = await place("cart");
  await model().locator("option", { hasText: "rover4" }).waitFor({ state: "attached" });
  await page.locator('[data-robot="cart"]').click();
  await page.keyboard.press("Delete");
  await until(async () => (await body("cart")) === undefined, "the cart's end");
  await page.locator('.edit [aria-label="Undo"]:enabled').waitFor();
  await settled(page);
  await press("Undo");
  await until(async () => (await body("cart")) !== undefined, "the cart again");
  (await place("cart")).forEach((value, i) => assert.ok(Math.abs(value - stood[i]) < 1e-6));
  assert.equal((await body("cart")).is_of_world, true);
  await press("Resume");
  await phaseIs(page, "running");
  assert.deepEqual(faults, []);
});
