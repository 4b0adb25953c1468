// Tests the inspectors of objects and sensors of the world, which are chosen in the view, in the
// list, in the tree and by the command palette. Also tests the arrows of forces, and the colours of points.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import process from "node:process";
import { after, before, test } from "node:test";
import { openBrowser, openPage, requireFromWeb, waitUntilDrawn } from "./browser.mjs";
import { program, startServer } from "./server.mjs";
import { keepPicture } from "./documentation.mjs";
import { changedPixels, cut, isRed, picture } from "./pixels.mjs";
import { phaseIs, project, settled, until, viewClip } from "./viewing.mjs";

const { PNG } = requireFromWeb("pngjs");
const NAME = `inspectors_${process.pid}`;
const box = (size) => `<geometry><box><size>${size}</size></box></geometry>`;
const NEAR = [-0.4, 3, 0.2]; // centres of the boards in m
const FAR = [0.55, 4.2, 0.2];
const board = (name, at, colour) => `
  <model name="${name}"><static>true</static><pose>${at.join(" ")} 0 0 0</pose><link name="link">
    <collision name="collision">${box("0.7 0.04 0.4")}</collision>
    <visual name="visual">${box("0.7 0.04 0.4")}<material><diffuse>${colour} 1</diffuse></material></visual>
  </link></model>`;
const [EYE, TARGET] = [[-3, -2, 2], [0, 0, 0.2]]; // the crate is in the middle of the view
const WORLD = `<?xml version="1.0"?>
<sdf version="1.9"><world name="inspectors">
  <model name="ground"><static>true</static><link name="link">
    <collision name="collision"><geometry><plane><normal>0 0 1</normal><size>40 40</size></plane></geometry></collision>
    <visual name="visual"><geometry><plane><normal>0 0 1</normal><size>40 40</size></plane></geometry></visual>
  </link></model>
  <model name="crate"><pose>0 0 0.2 0 0 0</pose><link name="box">
    <inertial><mass>2.5</mass></inertial>
    <collision name="collision">${box("0.4 0.4 0.4")}</collision>
    <visual name="visual">${box("0.4 0.4 0.4")}
      <material><diffuse>1 0 0 1</diffuse><pbr><metal><metalness>0.25</metalness><roughness>0.5</roughness></metal></pbr></material>
    </visual>
  </link></model>
  <model name="post"><static>true</static><pose>3 0 0 0 0 0</pose><link name="link">
    <visual name="visual"><pose>0 0 1 0 0 0</pose><geometry><cylinder><radius>0.1</radius><length>2</length></cylinder></geometry></visual>
    <sensor name="height" type="altimeter"><pose>0 0 2 0 0 0</pose><update_rate>5</update_rate></sensor>
  </link></model>
  <model name="scanner"><static>true</static><pose>0 2 0 0 0 0</pose><link name="link">
    <visual name="visual"><pose>0 0 0.1 0 0 0</pose>${box("0.1 0.1 0.2")}</visual>
    <sensor name="scan" type="lidar"><pose>0 0 0.3 0 0 1.5708</pose><update_rate>5</update_rate><visualize>true</visualize><lidar>
      <scan><horizontal><samples>41</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal></scan>
      <range><min>0.1</min><max>8</max></range>
    </lidar><gsv:intensity_scale>100</gsv:intensity_scale></sensor>
  </link></model>
  ${board("near_and_white", NEAR, "1 1 1")}
  ${board("far_and_black", FAR, "0.05 0.05 0.05")}
</world></sdf>`;

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-inspectors-"));
let server;
let browser;
let page;
let faults;

before(async () => {
  const world = path.join(folder, "inspectors.sdf");
  fs.writeFileSync(world, WORLD);
  server = await startServer([world, "--robot", "pebble@-3,3", "--name", NAME]);
  browser = await openBrowser({ width: 1366, height: 768 });
  ({ page, faults } = await openPage(browser, `${server.url}?quality=high#view=${[...EYE, ...TARGET]}`));
  await waitUntilDrawn(page);
  await until(async () => {
    const view = await page.evaluate(() => window.gsv.view);
    return [...EYE, ...TARGET].every((value, i) => Math.abs(view[i] - value) < 0.01);
  }, "the view of the address");
});

after(async () => {
  await browser?.close();
  await server?.stop();
  fs.rmSync(folder, { recursive: true, force: true });
});

const inspector = () => page.getByRole("region", { name: "Selected object", exact: true });
const inList = (name) => page.locator(`[data-object="${name}"]`);

// Returns the lines of the inspector, by name.
async function facts(region) {
  const names = await region.locator("dt").allTextContents();
  const values = await region.locator("dd").allTextContents();
  return Object.fromEntries(names.map((name, i) => [name, values[i]]));
}

// Waits for a line of the inspector.
async function shows(region, name, value) {
  let last;
  await until(async () => {
    last = (await facts(region))[name];
    return last !== undefined && (value instanceof RegExp ? value.test(last) : last === value);
  }, `${name}: ${value}`);
}

test("a click on an object in the view shows its pose, mass, geometry, material and collision", async () => {
  const { x, y, width, height } = await viewClip(page);
  await page.mouse.click(x + width / 2, y + height / 2);
  const shown = inspector();
  await shown.getByRole("heading", { name: "crate", exact: true }).waitFor();
  await shows(shown, "Kind", "dynamic");
  await shows(shown, "Mass", "2.5 kg");
  await shows(shown, "Geometry", "box, 0.4 × 0.4 × 0.4 m");
  await shows(shown, "Material", "#ff0000, metalness 0.25, roughness 0.5");
  await shows(shown, "Collision", "box, 0.4 × 0.4 × 0.4 m");
  await shows(shown, "Position", "0.000, 0.000, 0.200 m");
  await shows(shown, "Age", /^\d+\.\d\d s$/);
  // The list shows the same selection.
  await until(async () => (await inList("crate").getAttribute("aria-pressed")) === "true", "the choice in the list");
});

test("an object of the list is shown in the inspector and in the tree", async () => {
  await page.locator(".world-tree summary").click();
  await inList("post").click();
  await inspector().getByRole("heading", { name: "post", exact: true }).waitFor();
  await shows(inspector(), "Geometry", "cylinder, radius 0.1 m, length 2 m");
  await shows(inspector(), "Collision", "none");
  await page.getByRole("button", { name: "World", exact: true }).click();
  const tree = page.getByRole("region", { name: "World", exact: true });
  await until(async () => (await tree.locator('[data-node="post"]').getAttribute("aria-pressed")) === "true", "the choice in the tree");
});

test("a sensor of the world is chosen in the tree: parameters, transform and the newest value with its age", async () => {
  const tree = page.getByRole("region", { name: "World", exact: true });
  await tree.getByLabel("Search the world by name").fill("post");
  await tree.locator('[data-node="post::sensor::height"]').click();
  const shown = page.getByRole("region", { name: "Selected part", exact: true });
  await shown.getByRole("heading", { name: "Sensor height", exact: true }).waitFor();
  await shows(shown, "Type", "altimeter");
  await shows(shown, "Update rate", "5 Hz");
  await shows(shown, "Position in the link", "0.000, 0.000, 2.000 m");
  await shows(shown, "Transform", /^0\.000, 0\.000, 2\.000 m in post.*, static$/);
  await shows(shown, "Age", /^\d+\.\d\d s$/);
  await until(async () => Object.keys(await facts(shown)).some((name) => name.includes("vertical_position")), "the newest value");
  await page.getByRole("button", { name: "Close world", exact: true }).click();
});

test("the command palette finds objects and sensors", async () => {
  await page.keyboard.press("Control+k");
  await page.getByRole("combobox", { name: "Command, robot, topic or panel" }).fill("object crate");
  await page.keyboard.press("Enter");
  await inspector().getByRole("heading", { name: "crate", exact: true }).waitFor();
  await page.keyboard.press("Control+k");
  await page.getByRole("combobox", { name: "Command, robot, topic or panel" }).fill("sensor post height");
  await page.keyboard.press("Enter");
  await inspector().getByRole("heading", { name: "Sensor height", exact: true }).waitFor();
  // The station with the sensor is selected in the list of robots.
  await until(async () => (await page.locator('[data-robot="post"]').count()) > 0, "the station in the list");
  // Long names of parameters leave room for the values.
  const values = page.locator(".inspector-body .world-inspector dd");
  await until(async () => {
    const widths = await values.evaluateAll((all) => all.map((each) => each.clientWidth));
    return widths.length > 3 && widths.every((width) => width > 90);
  }, "values wider than 90 pixels");
});

test("arrows show the forces of the ground on the crate: their direction and length", async () => {
  const isPink = (r, g, b) => r > 150 && b > 120 && g < 0.6 * r;
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await phaseIs(page, "paused");
  const clip = await viewClip(page);
  await settled(page);
  const without = await picture(page, clip);
  await page.keyboard.press("3");
  let shown;
  await until(async () => {
    await settled(page);
    shown = await picture(page, clip);
    return changedPixels(without, shown, isPink) > 40;
  }, "the contacts of the crate with the ground");
  assert.ok((await page.evaluate(() => window.gsv.topics)).includes("/gsv/current_contacts"));
  // Returns the number of pink pixels within 5 pixels of a place above the corner that is nearest to the camera.
  const pinkAt = (height) => {
    const { x, y } = project([-0.2, -0.2, height], EYE, TARGET, shown);
    const square = { x: Math.round(x) - 5, y: Math.round(y) - 5, width: 11, height: 11 };
    return changedPixels(cut(without, square), cut(shown, square), isPink);
  };
  // Each of four corners carries 6.1 N. The length for 10 N is 0.3 m, and it grows with the square root.
  const tip = 0.3 * Math.sqrt((2.5 * 9.8) / 4 / 10);
  const found = [0.1, tip - 0.02, tip + 0.06, tip + 0.2, -0.12].map(pinkAt);
  assert.ok(found[0] > 5 && found[1] > 5, `along the arrow, up to its tip: ${found}`);
  assert.deepEqual(found.slice(2), [0, 0, 0], "above the tip and below the ground");
  await keepPicture(page, "contacts");
  await page.keyboard.press("3");
});

test("points are coloured by range or by intensity, from dark to bright", async () => {
  const clip = await viewClip(page);
  await settled(page);
  const without = await picture(page, clip);
  await page.keyboard.press("2");
  const isDark = (r, g, b) => g < 60 && r > 50 && b > 50;
  const isBright = (r, g, b) => r > 200 && g > 100 && b < 100;
  // Returns the numbers of dark and of bright pixels of the points on a board.
  const look = async () => {
    await settled(page);
    const shown = await picture(page, clip);
    return [NEAR, FAR].map(([x, y]) => {
      const at = project([x, y - 0.02, 0.3], EYE, TARGET, shown);
      const area = { x: Math.round(at.x) - 15, y: Math.round(at.y) - 15, width: 31, height: 31 };
      return [isDark, isBright].map((is) => changedPixels(cut(without, area), cut(shown, area), is));
    });
  };
  for (const [value, isWanted] of [
    ["range", ([[nearDark, nearBright], [farDark, farBright]]) => nearDark > 5 && nearBright === 0 && farDark === 0 && farBright > 5],
    ["intensity", ([[nearDark, nearBright], [farDark, farBright]]) => nearDark === 0 && nearBright > 5 && farDark > 5 && farBright === 0],
  ]) {
    await page.getByRole("button", { name: "Overlays", exact: true }).click();
    await page.getByLabel("Colour points by").selectOption(value);
    await page.keyboard.press("Escape");
    await until(async () => isWanted(await look()), `points by ${value}`);
  }
  await page.keyboard.press("2");
});

test("gsv snapshot draws an image of the running simulation from the same place", async () => {
  await page.getByRole("button", { name: "Resume", exact: true }).click();
  await phaseIs(page, "running");
  const file = path.join(folder, "snapshot.png");
  const [eye, target] = [EYE, TARGET].map((point) => point.join());
  const command = spawnSync(program(), ["snapshot", NAME, "-o", file, "--size", "640x480", `--eye=${eye}`, `--target=${target}`, "--fov", "50"], { encoding: "utf8" });
  assert.equal(command.status, 0, command.stderr);
  const image = PNG.sync.read(fs.readFileSync(file));
  assert.deepEqual([image.width, image.height], [640, 480]);
  const colourAt = (point) => {
    const { x, y } = project(point, EYE, TARGET, image);
    return [...image.data.subarray(4 * (Math.round(y) * 640 + Math.round(x))).subarray(0, 3)];
  };
  const [crate, beside] = [colourAt([-0.2, 0, 0.2]), colourAt([-0.8, -0.8, 0])];
  assert.ok(isRed(...crate) && !isRed(...beside), `the crate is ${crate}, the ground ${beside}`);
});

test("Escape ends the choice, and the inspector explains how to choose", async () => {
  await page.keyboard.press("Escape");
  await page.getByText("Select a robot or an object in the view, in the list or in the panel World").waitFor();
  assert.equal(await inspector().count(), 0);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
