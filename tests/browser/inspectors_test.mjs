// Tests the inspectors of objects and sensors of the world, which are chosen in the view, in the
// list, in the tree and by the command palette.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { keepPicture } from "./documentation.mjs";
import { changedPixels, picture } from "./pixels.mjs";
import { phaseIs, settled, until, viewClip } from "./viewing.mjs";

const box = (size) => `<geometry><box><size>${size}</size></box></geometry>`;
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
</world></sdf>`;

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-inspectors-"));
let server;
let browser;
let page;
let faults;

before(async () => {
  const world = path.join(folder, "inspectors.sdf");
  fs.writeFileSync(world, WORLD);
  server = await startServer([world, "--robot", "pebble@-3,3"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  // The crate is in the middle of the view.
  ({ page, faults } = await openPage(browser, `${server.url}#view=-3,-2,2,0,0,0.2`));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  fs.rmSync(folder, { recursive: true, force: true });
});

const inspector = () => page.getByRole("region", { name: "Selected object", exact: true });
const inList = (name) => page.locator(`[data-object="${name}"]`);

// The lines of the inspector, by name.
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
  await tree.getByLabel("Name in the world").fill("post");
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

test("an arrow shows the force of the ground on the crate", async () => {
  const isPink = (r, g, b) => r > 150 && b > 120 && g < 0.6 * r;
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await phaseIs(page, "paused");
  const clip = await viewClip(page);
  await settled(page);
  const without = await picture(page, clip);
  await page.keyboard.press("3");
  await until(async () => {
    await settled(page);
    return changedPixels(without, await picture(page, clip), isPink) > 40;
  }, "the contacts of the crate with the ground");
  assert.ok((await page.evaluate(() => window.gsv.topics)).includes("/gsv/current_contacts"));
  await keepPicture(page, "contacts");
  await page.keyboard.press("3");
});

test("Escape ends the choice, and the inspector explains how to choose", async () => {
  await page.keyboard.press("Escape");
  await page.getByText("Select a robot or an object in the view, in the list or in the panel World").waitFor();
  assert.equal(await inspector().count(), 0);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
