// Edits a world by the page alone: shapes of a given size, handles, numbers, several bodies at
// once, the ruler and the map. Then saves the world and reads the saved file.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { picture } from "./pixels.mjs";
import { program, startServer } from "./server.mjs";
import { ask, settled, until, viewClip } from "./viewing.mjs";

const NAME = `tools_${process.pid}`;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-tools-"));
let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@-2,-1.5", "--name", NAME]);
  browser = await openBrowser({ width: 1300, height: 900 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  fs.rmSync(folder, { recursive: true, force: true });
});

const edit = () => page.getByRole("region", { name: "Edit" });
const pose = () => page.getByRole("region", { name: "Pose" });
const press = (name) => page.getByRole("button", { name, exact: true }).click();
const body = async (name) => (await ask(page, "/scene")).bodies.find((each) => each.name === name);
const place = async (name) => (await body(name))?.pose;
const chosen = () => page.evaluate(() => window.gsv.chosen);
const onScreen = (name) => page.evaluate((name) => window.gsv.robotScreenPosition(name), name);
const handle = (axis) => page.evaluate((axis) => window.gsv.gizmoHandle(axis), axis);
const chosenAre = (...names) =>
  page.waitForFunction((names) => JSON.stringify(window.gsv.chosen) === JSON.stringify(names), names);
const ready = () => page.locator('.edit [aria-label="Undo"]:enabled').waitFor();
const shape = () => edit().getByRole("group", { name: "Shape", exact: true });

async function type(label, value) {
  const field = pose().getByLabel(label);
  await field.fill(String(value));
  await field.press("Enter");
  await field.blur();
}

test("a click on the floor clears the selection", async () => {
  await page.locator('[data-robot="pebble"]').click();
  await chosenAre("pebble");
  const at = await onScreen("pebble");
  await page.mouse.click(at.x - 70, at.y + 25);
  await chosenAre();
});

test("a box of 0.4 m is put before the selected robot", async () => {
  await press("Edit");
  await edit().waitFor();
  await page.locator('[data-robot="pebble"]').click();
  await press("Shape");
  for (const label of ["Length x (m)", "Width y (m)", "Height z (m)"]) await shape().getByLabel(label).fill("0.4");
  await shape().getByLabel("Mass (kg)").fill("8");
  await shape().getByLabel("Colour").fill("#ff0000");
  await press("Add shape");
  await page.waitForFunction(() => window.gsv.chosen[0] === "box");
  await settled(page);
  const [x, y, z] = await place("box");
  const [rx, ry] = await place("pebble");
  assert.ok(x - rx > 0.5 && x - rx < 1.2 && Math.abs(y - ry) < 1e-6, "it is ahead of the robot");
  assert.ok(Math.abs(z - 0.2) < 1e-6, "it stands on the floor");
  assert.equal((await body("box")).is_static, false);
  const { data } = await picture(page, await viewClip(page));
  let red = 0;
  for (let i = 0; i < data.length; i += 4) red += Number(data[i] > 120 && data[i + 1] < 70 && data[i + 2] < 70);
  assert.ok(red > 100, `${red} pixels are as red as the box`);
});

test("the list, the inspector and the view show the same choice", async () => {
  await page.locator(".world-tree summary").click();
  assert.equal(await page.locator('[data-object="box"]').getAttribute("aria-pressed"), "true");
  assert.equal(await page.locator('[data-robot="pebble"]').getAttribute("aria-pressed"), "false");
  await pose().getByRole("heading", { name: "box" }).waitFor();
  await page.locator('[data-robot="pebble"]').click();
  assert.deepEqual(await chosen(), ["pebble"]);
  await pose().getByRole("heading", { name: "pebble" }).waitFor();
  assert.equal(await pose().getByLabel("Roll (°)").isVisible(), false); // robots stand upright
  await page.locator('[data-object="box"]').click();
  await pose().getByRole("heading", { name: "box" }).waitFor();
});

test("a handle moves the body along one axis, in steps if snapping is on", async () => {
  await edit().getByLabel("Snap").check();
  await edit().getByLabel("Distance").selectOption("0.25");
  await page.keyboard.press("t");
  await settled(page);
  await page.waitForFunction(() => window.gsv.gizmoHandle("x") !== null);
  const before = await place("box");
  const [from, middle] = [await handle("x"), await onScreen("box")];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 0.5 * (from.x - middle.x), from.y, { steps: 4 });
  // The distance on the screen is so short that no body is in between.
  await page.mouse.move(from.x + (from.x - middle.x), from.y + 10, { steps: 4 });
  await page.mouse.up();
  await until(async () => (await place("box"))[0] - before[0] > 0.2, "the moved box");
  const now = await place("box");
  assert.ok(Math.abs(now[1] - before[1]) < 1e-6 && Math.abs(now[2] - before[2]) < 1e-6, "along x only");
  assert.ok(Math.abs(4 * now[0] - Math.round(4 * now[0])) < 1e-6, "on a multiple of 0.25 m");
  await settled(page);
  assert.equal(Number(await pose().getByLabel("x (m)").inputValue()), Number(now[0].toFixed(4)));
});

test("a drag of the selected body itself moves it over the floor", async () => {
  await edit().getByLabel("Snap").uncheck();
  await settled(page);
  await ready();
  await type("x (m)", 0);
  await until(async () => Math.abs((await place("box"))[0]) < 1e-9, "the box in the open");
  await settled(page);
  await ready();
  const before = await place("box");
  const at = await onScreen("box");
  // The front of the body, below its centre, which is where the handles meet.
  const from = { x: at.x - 2, y: at.y + 6 };
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 25, from.y + 5, { steps: 5 });
  await page.mouse.up();
  await until(async () => Math.hypot((await place("box"))[0] - before[0], (await place("box"))[1] - before[1]) > 0.1, "the dragged box");
  assert.ok(Math.abs((await place("box"))[2] - before[2]) < 1e-6, "at its height");
  await settled(page);
  await ready();
  await press("Undo");
  await until(async () => Math.abs((await place("box"))[0] - before[0]) < 1e-6, "the box at its old place");
  await settled(page);
});

test("a click on a handle is no edit, and no handle takes a click that places", async () => {
  await ready();
  const before = await place("box");
  const redo = page.locator('.edit [aria-label="Redo"]:enabled');
  await redo.waitFor();
  const at = await handle("x");
  await page.mouse.click(at.x, at.y);
  await settled(page);
  await redo.waitFor(); // an edit would have cleared the list of undone edits
  await chosenAre("box");
  await press("Place");
  await page.getByText("Click the floor to place box there.").waitFor();
  await settled(page);
  assert.equal(await handle("x"), null);
  const middle = await onScreen("box");
  await page.mouse.click(middle.x + 25, middle.y + 8); // beside the arrow along x
  await until(async () => Math.hypot((await place("box"))[0] - before[0], (await place("box"))[1] - before[1]) > 0.05, "the placed box");
  await settled(page);
  await ready();
  await press("Undo");
  await until(async () => Math.abs((await place("box"))[0] - before[0]) < 1e-6, "the box at its old place");
  await settled(page);
});

test("typed numbers place the body exactly, and undo reverts each of them", async () => {
  await ready();
  const before = await place("box");
  await type("z (m)", 1.5);
  await until(async () => Math.abs((await place("box"))[2] - 1.5) < 1e-9, "the raised box");
  await settled(page);
  await type("Roll (°)", 30);
  await until(async () => Math.abs((await place("box"))[3] - Math.sin(Math.PI / 12)) < 1e-6, "the tilted box");
  await ready();
  await press("Undo");
  await until(async () => Math.abs((await place("box"))[3]) < 1e-9, "the level box");
  await settled(page);
  await ready();
  await press("Undo");
  await until(async () => Math.abs((await place("box"))[2] - before[2]) < 1e-9, "the box on the floor");
  await settled(page);
});

test("a ring turns the body about one axis, in steps if snapping is on", async () => {
  await edit().getByLabel("Snap").check();
  await edit().getByLabel("Angle").selectOption("15");
  await press("Turn");
  await settled(page);
  await ready();
  const before = await place("box");
  const [middle, x, y] = [await onScreen("box"), await handle("x"), await handle("y")];
  // Points of the horizontal ring, between the axes, where it crosses no other ring.
  const onRing = (degrees) => {
    const [c, s] = [Math.cos((Math.PI * degrees) / 180), Math.sin((Math.PI * degrees) / 180)];
    const at = (name) => middle[name] + c * (x[name] - middle[name]) + s * (y[name] - middle[name]);
    return { x: at("x"), y: at("y") };
  };
  // Only the half of the ring that faces the camera is drawn. It is lower in the image.
  const start = [45, 135, 225, 315].sort((a, b) => onRing(b).y - onRing(a).y)[0];
  const [from, to] = [onRing(start), onRing(start + 40)];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 4 });
  await page.mouse.move(to.x, to.y, { steps: 4 });
  await page.mouse.up();
  const yawDegrees = ([, , , , , qz, qw]) => (360 / Math.PI) * Math.atan2(qz, qw);
  await until(async () => Math.abs(yawDegrees(await place("box"))) > 10, "the turned box");
  const now = await place("box");
  const yaw = yawDegrees(now);
  assert.ok(Math.abs(yaw / 15 - Math.round(yaw / 15)) < 1e-3, `${yaw} degrees are a multiple of 15`);
  for (const i of [0, 1, 2, 3, 4]) assert.ok(Math.abs(now[i] - before[i]) < 1e-6, `${now}: about z only`);
  await settled(page);
  await ready();
  await press("Undo");
  await until(async () => Math.abs(yawDegrees(await place("box"))) < 1e-6, "the box as it was");
  await edit().getByLabel("Snap").uncheck();
  await press("Move");
  await settled(page);
});

for (const [kind, sizes, geometry, z] of [
  ["cylinder", { "Radius (m)": "0.15", "Height z (m)": "0.5" }, "cylinder, radius 0.15 m, length 0.5 m", 0.25],
  ["sphere", { "Radius (m)": "0.25" }, "sphere, radius 0.25 m", 0.25],
]) {
  test(`a ${kind} of a given size is added, and undo removes it`, async () => {
    await ready();
    await press("Shape");
    await shape().getByLabel("Shape", { exact: true }).selectOption(kind);
    for (const [label, value] of Object.entries(sizes)) await shape().getByLabel(label).fill(value);
    await press("Add shape");
    await page.waitForFunction((kind) => window.gsv.chosen[0]?.startsWith(kind), kind);
    await ready();
    const [name] = await chosen();
    await page.getByRole("region", { name: "Selected object", exact: true }).getByText(geometry).first().waitFor();
    assert.ok(Math.abs((await place(name))[2] - z) < 1e-6, "it stands on the floor");
    await press("Undo");
    await until(async () => (await body(name)) === undefined, `the end of the ${kind}`);
    await page.locator('[data-object="box"]').click();
    await chosenAre("box");
  });
}

test("a wall is drawn by two clicks", async () => {
  await page.keyboard.press("r");
  await press("Map");
  await settled(page);
  await press("Shape");
  await shape().getByLabel("Shape", { exact: true }).selectOption("wall");
  await press("Draw wall");
  const at = await onScreen("pebble");
  await page.mouse.click(at.x - 60, at.y - 50);
  await page.getByText("where the wall ends").waitFor();
  await page.mouse.click(at.x + 60, at.y - 50);
  await page.waitForFunction(() => window.gsv.chosen[0] === "wall");
  await settled(page);
  const wall = await body("wall");
  assert.equal(wall.is_static, true);
  assert.equal(wall.is_fixed, false);
  const onMap = await onScreen("wall");
  assert.ok(Math.hypot(onMap.x - at.x, onMap.y - at.y + 50) < 15, "it stands between the clicks");
});

test("the map has a scale, and its ruler agrees with it", async () => {
  // Beside the floor, the map has the colour of the world's background, not black.
  const { data, width } = await picture(page, await viewClip(page));
  const dark = [4, width - 4].map((x) => data.slice(4 * (40 * width + x), 4 * (40 * width + x) + 3)).filter((colour) => Math.max(...colour) < 20);
  assert.deepEqual(dark, []);
  const label = await page.locator(".scale-bar").getAttribute("aria-label");
  const [, length, unit] = label.match(/bar stands for ([\d.]+) (m|cm)/);
  const metres = Number(length) * (unit === "cm" ? 0.01 : 1);
  const pixels = await page.locator(".scale-line").evaluate((bar) => bar.clientWidth + 2);
  await press("Measure");
  const at = await onScreen("pebble");
  await page.mouse.click(at.x + 40, at.y + 30);
  await page.getByText("Click the second point").waitFor();
  await page.mouse.click(at.x + 140, at.y - 45);
  const ruler = page.getByRole("region", { name: "Ruler" });
  await ruler.getByText("Distance").waitFor();
  const values = await ruler.locator("dd").allTextContents();
  const [distance, dx, dy, dz, angle] = values.map((text) => parseFloat(text.replace("−", "-")));
  // 100 pixels to the east and 75 to the north, on the floor.
  const wanted = { dx: (100 * metres) / pixels, dy: (75 * metres) / pixels };
  assert.ok(Math.abs(dx - wanted.dx) < 0.05 * dx && Math.abs(dy - wanted.dy) < 0.05 * dy, `${values} of ${metres} m in ${pixels} px`);
  assert.ok(Math.abs(distance - Math.hypot(dx, dy, dz)) < 0.002 && Math.abs(dz) < 0.001, `${values}`);
  assert.ok(Math.abs(angle - (180 / Math.PI) * Math.atan2(75, 100)) < 3, "counter-clockwise from east");
  await page.keyboard.press("Escape");
  await ruler.waitFor({ state: "hidden" });
  assert.deepEqual(await chosen(), ["wall"]); // Escape ended the ruler only
  await press("Map");
  await settled(page);
});

test("several bodies are selected, moved, copied and removed together", async () => {
  await page.locator('[data-object="box"]').click();
  await chosenAre("box");
  await page.locator('[data-object="wall"]').click({ modifiers: ["Shift"] });
  await chosenAre("box", "wall");
  assert.equal(await page.locator('[data-object="wall"]').getAttribute("aria-pressed"), "true");
  await page.getByText("2 bodies are selected").waitFor();
  await press("Duplicate");
  await page.waitForFunction(() => window.gsv.chosen.length === 2 && !window.gsv.chosen.includes("box"));
  await settled(page);
  const copies = await chosen();
  const [box, copy] = [await place("box"), await place(copies[0])];
  assert.ok(Math.abs(copy[0] - box[0] - 0.5) < 1e-6 && Math.abs(copy[1] - box[1] - 0.5) < 1e-6);
  await ready();
  await page.keyboard.press("Delete");
  await until(async () => (await body(copies[0])) === undefined && (await body(copies[1])) === undefined, "the end of both");
  await ready();
  await press("Undo");
  await until(async () => (await body(copies[0])) !== undefined && (await body(copies[1])) !== undefined, "both again");
  await ready();
  await press("Undo");
  await until(async () => (await body(copies[0])) === undefined, "the end of the copies");
  await settled(page);
});

test("a rectangle selects the bodies inside it", async () => {
  await press("Map");
  await settled(page);
  // On a slow machine the map may still be moving into place, so the rectangle is drawn again.
  await until(async () => {
    await page.keyboard.press("Escape");
    const at = await onScreen("box");
    await page.keyboard.down("Shift");
    await page.mouse.move(at.x - 25, at.y - 25);
    await page.mouse.down();
    await page.mouse.move(at.x + 25, at.y + 25, { steps: 3 });
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await settled(page);
    return JSON.stringify(await chosen()) === '["box"]';
  }, "the box in the rectangle");
  await press("Map");
});

test("the saved world is read again with the same bodies", async () => {
  await press("Save");
  await edit().getByText("An SDFormat file of all bodies at their present poses, for Gazebo and GSV.").waitFor();
  const [download] = await Promise.all([page.waitForEvent("download"), press("Save world")]);
  const file = path.join(folder, "saved.sdf");
  await download.saveAs(file);
  assert.match(download.suggestedFilename(), /\.sdf$/);
  const check = spawnSync(program(), ["world", "check", file], { encoding: "utf8" });
  assert.equal(check.status, 0, check.stdout + check.stderr);
  const saved = path.join(folder, "by_command.sdf");
  const scenario = path.join(folder, "by_command.yaml");
  const command = spawnSync(program(), ["world", "save", NAME, "-o", saved, "--scenario", scenario], { encoding: "utf8" });
  assert.equal(command.status, 0, command.stdout + command.stderr);
  assert.match(fs.readFileSync(scenario, "utf8"), /world: by_command\.sdf/);
  const poses = (await ask(page, "/scene")).bodies.map(({ name, pose }) => [name, pose]);
  const again = await startServer([saved]);
  const { page: other } = await openPage(browser, again.url);
  await waitUntilDrawn(other);
  const read = (await ask(other, "/scene")).bodies.map(({ name, pose }) => [name, pose]);
  assert.deepEqual(read.map(([name]) => name), poses.map(([name]) => name));
  // The simulation has run in the meantime: bodies on the floor settle within a millimetre.
  read.forEach(([name, pose], i) => pose.forEach((value, j) => assert.ok(Math.abs(value - poses[i][1][j]) < 1e-3, name)));
  await other.close();
  await again.stop();
});

test("the saved scenario starts the same world with the robot's set-up", async () => {
  await page.bringToFront();
  await press("Save");
  const downloads = [];
  page.on("download", (download) => downloads.push(download));
  await press("Save scenario");
  await until(() => downloads.length === 2, "both files");
  for (const download of downloads) await download.saveAs(path.join(folder, download.suggestedFilename()));
  assert.deepEqual(downloads.map((download) => download.suggestedFilename()).sort(), [`${NAME}.sdf`, `${NAME}.yaml`]);
  const again = await startServer([path.join(folder, `${NAME}.yaml`)]);
  const { page: other } = await openPage(browser, again.url);
  await waitUntilDrawn(other);
  const names = async (of) => (await ask(of, "/scene")).bodies.map(({ name }) => name).sort();
  assert.deepEqual(await names(other), await names(page));
  await other.locator('[data-robot="pebble"]').waitFor();
  await other.close();
  await again.stop();
  await page.bringToFront();
});

test("after editing, the robot for which a shape was added is selected again", async () => {
  await page.locator('[data-robot="pebble"]').click();
  await press("Shape");
  await shape().getByLabel("Shape", { exact: true }).selectOption("box");
  await press("Add shape");
  await page.waitForFunction(() => window.gsv.chosen[0]?.startsWith("box"));
  await ready();
  await press("Edit");
  await edit().waitFor({ state: "detached" });
  await chosenAre("pebble");
  await page.getByRole("region", { name: "Selected robot" }).getByRole("heading", { name: "pebble" }).waitFor();
  const offer = page.getByText("The simulation is still paused.");
  await offer.waitFor();
  await page.getByTitle("Resume (Space)").click();
  await offer.waitFor({ state: "detached" });
  assert.deepEqual(faults, []);
});
