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
import { ask, phaseIs, settled, until, viewClip } from "./viewing.mjs";

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

// Drags a handle away from the body, by this part of its distance on the screen.
async function dragHandle(axis, part) {
  await settled(page);
  const [from, middle] = [await handle(axis), await onScreen((await chosen())[0])];
  const to = { x: from.x + part * (from.x - middle.x), y: from.y + part * (from.y - middle.y) };
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 3 });
  await page.mouse.move(to.x, to.y, { steps: 3 });
  await page.mouse.up();
}

for (const [index, axis] of [[1, "y"], [2, "z"]]) {
  test(`the handle along ${axis} moves the body along ${axis} only, and undo reverts it`, async () => {
    await ready();
    const before = await place("box");
    await dragHandle(axis, 0.6);
    await until(async () => Math.abs((await place("box"))[index] - before[index]) > 0.05, "the moved box");
    const now = await place("box");
    assert.ok(now[index] > before[index], "in the direction of the drag");
    now.forEach((value, i) => assert.ok(i === index || Math.abs(value - before[i]) < 1e-6, `${now} along ${axis} only`));
    await settled(page);
    await ready();
    await press("Undo");
    await until(async () => Math.abs((await place("box"))[index] - before[index]) < 1e-6, "the box at its old place");
    await settled(page);
  });
}

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

const AXES = ["x", "y", "z"];

test("a body is raised, to have room for turns", async () => {
  await ready();
  await type("z (m)", 1);
  await until(async () => Math.abs((await place("box"))[2] - 1) < 1e-9, "the raised box");
  await settled(page);
});

for (const axis of AXES) {
  test(`the ring about ${axis} turns the body about ${axis} only, in steps if snapping is on`, async () => {
    await edit().getByLabel("Snap").check();
    await edit().getByLabel("Angle").selectOption("15");
    await press("Turn");
    await settled(page);
    await ready();
    const before = await place("box");
    const index = AXES.indexOf(axis);
    const others = [(index + 1) % 3, (index + 2) % 3];
    const [middle, ...ends] = [await onScreen("box"), await handle(AXES[others[0]]), await handle(AXES[others[1]])];
    const view = await page.evaluate(() => window.gsv.view);
    const toEye = AXES.map((_, i) => view[i] - view[3 + i]);
    // Points of the ring, between the axes, where it crosses no other ring.
    const onRing = (degrees) => {
      const [c, s] = [Math.cos((Math.PI * degrees) / 180), Math.sin((Math.PI * degrees) / 180)];
      const at = (name) => middle[name] + c * (ends[0][name] - middle[name]) + s * (ends[1][name] - middle[name]);
      return { x: at("x"), y: at("y"), nearness: c * toEye[others[0]] + s * toEye[others[1]] };
    };
    // Only the half that faces the camera is drawn.
    const start = [45, 135, 225, 315].sort((a, b) => onRing(b).nearness - onRing(a).nearness)[0];
    const [from, to] = [onRing(start), onRing(start + 40)];
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2, { steps: 4 });
    await page.mouse.move(to.x, to.y, { steps: 4 });
    await page.mouse.up();
    const degrees = (pose) => (360 / Math.PI) * Math.atan2(pose[3 + index], pose[6]);
    await until(async () => Math.abs(degrees(await place("box"))) > 10, "the turned box");
    const now = await place("box");
    const angle = degrees(now);
    assert.ok(angle > 0, `${angle} degrees counter-clockwise about ${axis}`);
    assert.ok(Math.abs(angle / 15 - Math.round(angle / 15)) < 1e-3, `${angle} degrees are a multiple of 15`);
    for (const i of [0, 1, 2, ...others.map((other) => 3 + other)]) assert.ok(Math.abs(now[i] - before[i]) < 1e-6, `${now}: about ${axis} only`);
    await settled(page);
    await ready();
    await press("Undo");
    await until(async () => Math.abs(degrees(await place("box"))) < 1e-6, "the box as it was");
    await edit().getByLabel("Snap").uncheck();
    await press("Move");
    await settled(page);
    if (axis !== "z") return;
    await ready();
    await press("Undo");
    await until(async () => Math.abs((await place("box"))[2] - 0.2) < 1e-6, "the box on the floor");
    await settled(page);
  });
}

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

// The scale of the map, by its bar.
async function metresPerPixel() {
  const label = await page.locator(".scale-bar").getAttribute("aria-label");
  const [, length, unit] = label.match(/bar stands for ([\d.]+) (m|cm)/);
  return (Number(length) * (unit === "cm" ? 0.01 : 1)) / (await page.locator(".scale-line").evaluate((bar) => bar.clientWidth + 2));
}

// Shows the map, or the former view, and waits until it is in place.
async function pressMap() {
  await press("Map");
  const view = async () => JSON.stringify(await page.evaluate(() => window.gsv.view));
  await until(async () => {
    const then = await view();
    await settled(page);
    return then === (await view());
  }, "a view at rest");
}

test("a shape is put at a typed position, and an occupied one is refused", async () => {
  const [x, y] = await place("box");
  await press("Shape");
  for (const [label, value] of [["At x (m)", x], ["At y (m)", y]]) {
    await shape().getByLabel(label).click();
    await page.keyboard.type(String(value));
    await page.keyboard.press("Tab"); // leaves the field, which keeps its text
    assert.equal(Number(await shape().getByLabel(label).inputValue()), value);
  }
  await press("Add shape");
  await page.getByText(/there is no room at .* it would overlap "box"; choose another place/).waitFor();
  await until(() => faults.length > 0, "the refused request");
  assert.match(faults.splice(0).join(), /422/);
  await shape().getByLabel("At y (m)").fill(String(y + 0.7));
  await press("Add shape");
  await page.waitForFunction(() => window.gsv.chosen[0] !== "box");
  await shape().waitFor({ state: "hidden" }); // after the refusal, the form was still open
  const [added] = await chosen();
  assert.deepEqual((await place(added)).slice(0, 2).map((value) => Math.round(1e6 * value)), [x, y + 0.7].map((value) => Math.round(1e6 * value)));
  await press("Shape");
  await shape().getByLabel("At x (m)").fill("");
  await shape().getByLabel("At y (m)").fill("");
  await press("Shape");
  await shape().waitFor({ state: "hidden" });
  await ready();
  await page.keyboard.press("Control+z");
  await until(async () => (await body(added)) === undefined, "the shape is gone");
});

test("a wall of a given thickness and height is drawn by two clicks", async () => {
  await page.keyboard.press("r");
  await pressMap();
  await press("Shape");
  await shape().getByLabel("Shape", { exact: true }).selectOption("wall");
  await shape().getByLabel("Width y (m)").fill("0.2");
  await shape().getByLabel("Height z (m)").fill("1.5");
  await press("Draw wall");
  const at = await onScreen("pebble");
  await page.mouse.click(at.x - 60, at.y - 50);
  await page.getByText("where the wall ends").waitFor();
  await page.mouse.click(at.x + 60, at.y - 90);
  await page.waitForFunction(() => window.gsv.chosen[0] === "wall");
  await settled(page);
  const wall = await body("wall");
  assert.equal(wall.is_static, true);
  assert.equal(wall.is_fixed, false);
  const onMap = await onScreen("wall");
  assert.ok(Math.hypot(onMap.x - at.x, onMap.y - at.y + 70) < 15, "it stands between the clicks");
  assert.ok(Math.abs(wall.pose[2] - 0.75) < 1e-6, "it stands on the floor");
  const geometry = page.getByRole("region", { name: "Selected object", exact: true }).getByText(/^box, [\d.]+ × 0.2 × 1.5 m$/).first();
  const length = parseFloat((await geometry.textContent()).slice("box, ".length));
  const wanted = Math.hypot(120, 40) * (await metresPerPixel());
  assert.ok(Math.abs(length - wanted) < 0.03 * wanted, `${length} m between clicks ${wanted} m apart`);
});

test("the map has a scale, and its ruler agrees with it", async () => {
  // Beside the floor, the map has the colour of the world's background, not black.
  const { data, width } = await picture(page, await viewClip(page));
  const dark = [4, width - 4].map((x) => data.slice(4 * (40 * width + x), 4 * (40 * width + x) + 3)).filter((colour) => Math.max(...colour) < 20);
  assert.deepEqual(dark, []);
  await press("Measure");
  const ruler = page.getByRole("region", { name: "Ruler" });
  await ruler.waitFor();
  await settled(page);
  const scale = await metresPerPixel();
  const at = await onScreen("pebble");
  await page.mouse.click(at.x + 40, at.y + 30);
  await page.getByText("Click the second point").waitFor();
  await page.mouse.click(at.x + 140, at.y - 45);
  await ruler.getByText("Distance").waitFor();
  const [box, view] = [await ruler.boundingBox(), await viewClip(page)];
  assert.ok(box.y >= view.y + view.height - 1, "the ruler covers nothing of the view");
  const values = await ruler.locator("dd").allTextContents();
  const [distance, dx, dy, dz, angle] = values.map((text) => parseFloat(text.replace("−", "-")));
  // 100 pixels to the east and 75 to the north, on the floor.
  const wanted = { dx: 100 * scale, dy: 75 * scale };
  assert.ok(Math.abs(dx - wanted.dx) < 0.05 * dx && Math.abs(dy - wanted.dy) < 0.05 * dy, `${values} at ${scale} m for a pixel`);
  assert.ok(Math.abs(distance - Math.hypot(dx, dy, dz)) < 0.002 && Math.abs(dz) < 0.001, `${values}`);
  assert.ok(Math.abs(angle - (180 / Math.PI) * Math.atan2(75, 100)) < 3, "counter-clockwise from east");
  await page.keyboard.press("Escape");
  await ruler.waitFor({ state: "hidden" });
  assert.deepEqual(await chosen(), ["wall"]); // Escape ended the ruler only
  await pressMap();
});

test("several bodies are selected, moved, copied and removed together", async () => {
  await page.locator('[data-object="box"]').click();
  await chosenAre("box");
  await page.locator('[data-object="wall"]').click({ modifiers: ["Shift"] });
  await chosenAre("box", "wall");
  assert.equal(await page.locator('[data-object="wall"]').getAttribute("aria-pressed"), "true");
  await page.getByText("2 bodies are selected").waitFor();
  await ready();
  const [boxThen, wallThen] = [await place("box"), await place("wall")];
  await dragHandle("z", 0.6);
  await until(async () => (await place("wall"))[2] - wallThen[2] > 0.1, "the raised wall");
  const rise = (await place("wall"))[2] - wallThen[2];
  for (const [name, then] of [["box", boxThen], ["wall", wallThen]]) {
    (await place(name)).forEach((value, i) => assert.ok(Math.abs(value - then[i] - (i === 2 ? rise : 0)) < 1e-6, `${name} has risen by ${rise} m`));
  }
  await settled(page);
  await ready();
  await press("Undo");
  await until(async () => Math.abs((await place("box"))[2] - boxThen[2]) < 1e-6 && Math.abs((await place("wall"))[2] - wallThen[2]) < 1e-6, "both on the floor");
  await settled(page);
  await ready();
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

test("Ctrl C and Ctrl V copy the selected bodies", async () => {
  await page.locator('[data-object="box"]').click();
  await page.locator('[data-object="wall"]').click({ modifiers: ["Shift"] });
  await chosenAre("box", "wall");
  await ready();
  await page.keyboard.press("Control+c");
  await page.getByText("2 bodies copied.").waitFor();
  assert.deepEqual(await chosen(), ["box", "wall"]);
  await page.keyboard.press("Control+v");
  await page.waitForFunction(() => window.gsv.chosen.length === 2 && !window.gsv.chosen.includes("box"));
  const copies = await chosen();
  for (const [i, name] of ["box", "wall"].entries()) {
    const [copy, original] = [await body(copies[i]), await body(name)];
    assert.equal(copy.is_static, original.is_static);
    assert.ok([0, 1].every((k) => Math.abs(copy.pose[k] - original.pose[k] - 0.5) < 1e-6), `${copies[i]} is beside ${name}`);
  }
  await settled(page);
  await ready();
  await press("Undo");
  await until(async () => (await body(copies[0])) === undefined && (await body(copies[1])) === undefined, "the end of the copies");
  await settled(page);
});

test("a rectangle selects the bodies inside it", async () => {
  await pressMap();
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

test("an edited world has the same hash after it was saved and loaded, at its start and after 200 steps", async () => {
  await ask(page, "/pause", {});
  await ask(page, "/reset", {});
  await phaseIs(page, "created");
  await press("Edit");
  await press("Save");
  const [download] = await Promise.all([page.waitForEvent("download"), press("Save world")]);
  const file = path.join(folder, "start.sdf");
  await download.saveAs(file);
  const again = await startServer([file, "--name", `${NAME}_again`]);
  try {
    const { page: other } = await openPage(browser, again.url);
    await other.waitForFunction(() => window.gsv?.phase === "running");
    await ask(other, "/pause", {});
    await ask(other, "/reset", {});
    await phaseIs(other, "created");
    const hashOf = (name) => {
      const { status, stdout, stderr } = spawnSync(program(), ["ps", name, "--json"], { encoding: "utf8" });
      assert.equal(status, 0, stderr);
      return JSON.parse(stdout).state_hash;
    };
    assert.equal(hashOf(`${NAME}_again`), hashOf(NAME));
    for (const each of [page, other]) await ask(each, "/step", { count: 200 });
    for (const each of [page, other]) await until(async () => (await ask(each, "")).step === 200, "200 steps");
    assert.equal(hashOf(`${NAME}_again`), hashOf(NAME));
  } finally {
    await again.stop();
  }
});
