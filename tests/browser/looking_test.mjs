// Tests overlays, views, the inspector's live values, plots, and downloads. One robot has a sensor
// of each kind.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { openBrowser, openPage, requireFromWeb, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { changedPixels, isBlank, isBlue, isGreen, isOrange, isRed, isYellow, picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, settled, until, viewClip } from "./viewing.mjs";

const { PNG } = requireFromWeb("pngjs");
const SURVEYOR = path.join(path.dirname(fileURLToPath(import.meta.url)), "models", "surveyor.sdf");
const SIMULATION = [
  "playground",
  ...["--robot", `${SURVEYOR}@3.2,0`, "--behaviour", "surveyor=cruise"],
  ...["--robot", "pebble@0,-1.5", "--behaviour", "pebble=wander"],
];

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(SIMULATION);
  browser = await openBrowser({ width: 1100, height: 700 });
  await browser.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const inspector = () => page.getByRole("region", { name: "Selected robot" });

async function press(name) {
  await page.getByRole("button", { name, exact: true }).click();
}

// Performs an action that makes the browser download a file, and returns its name and content.
async function downloaded(act) {
  const [file] = await Promise.all([page.waitForEvent("download"), act()]);
  return { name: file.suggestedFilename(), bytes: fs.readFileSync(await file.path()) };
}

test("the menu of overlays shows the active ones, and keys switch them too", async () => {
  await press("Overlays");
  const trails = page.getByRole("button", { name: "Trails", exact: true });
  assert.equal(await trails.getAttribute("aria-pressed"), "false");
  await trails.click();
  assert.equal(await trails.getAttribute("aria-pressed"), "true");
  await page.keyboard.press("Escape");
  assert.equal(await trails.isVisible(), false);
  // After the keyboard was used, the focus is on the button again.
  await page.getByRole("button", { name: "Overlays", exact: true }).focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Escape");
  assert.equal(await trails.isVisible(), false);
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Overlays");
});

test("a chase follows the selected robot, and a pause stops all motion", async () => {
  await page.locator('[data-robot="surveyor"]').click();
  await page.keyboard.press("c");
  // Trails grow. On a busy machine, a robot may take seconds before it gets a command to drive.
  const from = await page.evaluate(() => window.gsv.robotPosition("surveyor"));
  await page.waitForFunction(({ x, y }) => {
    const now = window.gsv.robotPosition("surveyor");
    return Math.hypot(now.x - x, now.y - y) > 0.5;
  }, from);
  await press("Pause");
  await phaseIs(page, "paused");
  await settled(page);
});

// Colours from the purple end to the yellow end of the colour scale of points.
const isOfScale = (r, g, b) => (g < 60 && r > 60 && b > 50) || (r > 130 && r > 1.3 * b);

// Switches on one overlay at a time in a paused picture: the view is from behind the robot, or from
// above for trails.
for (const [name, key, isWanted, least] of [
  ["points of lidar and depth camera", "2", isOfScale, 60],
  ["what a camera sees", "4", (...colour) => isYellow(...colour) || isOrange(...colour), 15],
  ["trails", "5", (...colour) => isBlue(...colour) || isOrange(...colour), 40],
  ["frames", "6", (...colour) => [isRed, isGreen, isBlue].some((is) => is(...colour)), 40],
  ["collision shapes", "9", (r, g, b) => r > 1.25 * b && r > g, 60],
  ["joints", "0", (r, g, b) => b > 1.2 * r && g > 1.1 * r, 10],
]) {
  test(`overlays: ${name}`, async () => {
    if (name === "trails") for (const pressed of ["o", "t"]) await page.keyboard.press(pressed);
    if (name === "joints") await page.locator('[data-robot="pebble"]').click(); // its wheels turn
    await settled(page);
    const clip = await viewClip(page);
    const button = page.locator(`.menu-item[aria-keyshortcuts="${key}"]`);
    const isOn = async () => (await button.getAttribute("aria-pressed")) === "true";
    if (!(await isOn())) await page.keyboard.press(key);
    // A last reading may still arrive.
    let drawn = 0;
    await until(async () => {
      await settled(page);
      const shown = await picture(page, clip);
      await page.keyboard.press(key);
      await settled(page);
      const without = await picture(page, clip);
      drawn = changedPixels(without, shown, isWanted);
      await page.keyboard.press(key);
      return drawn >= least;
    }, `${least} pixels of ${name}, ${drawn} at last,`);
    if (name === "collision shapes") {
      await settled(page);
      await keepPicture(page, "collisions");
    }
    if (name === "trails") await page.keyboard.press("c");
    if (name === "trails") return; // kept for the next test
    await page.keyboard.press(key);
    if (name === "joints") await page.locator('[data-robot="surveyor"]').click();
    assert.equal(await isOn(), false);
  });
}

test("points are coloured by height or range, and trails by speed", async () => {
  await page.keyboard.press("2");
  await settled(page);
  const clip = await viewClip(page);
  for (const [label, values] of [
    ["Colour points by", ["height", "range"]],
    ["Colour trails by", ["speed", "robot"]],
  ]) {
    for (const value of values) {
      const before = await picture(page, clip);
      await press("Overlays");
      await page.getByLabel(label).selectOption(value);
      await page.keyboard.press("Escape");
      let changed = 0;
      await until(async () => {
        await settled(page);
        changed = changedPixels(before, await picture(page, clip));
        return changed > 10;
      }, `other colours by ${value}`);
    }
  }
  await page.keyboard.press("2");
});

test("centres of mass and inertia boxes are drawn", async () => {
  await settled(page);
  const clip = await viewClip(page);
  const without = await picture(page, clip);
  await page.keyboard.press("b");
  await until(async () => {
    await settled(page);
    return changedPixels(without, await picture(page, clip)) > 5;
  }, "the masses");
  await page.keyboard.press("b");
  await settled(page);
});

test("the browser stores the choice of overlays", async () => {
  await page.keyboard.press("2");
  await page.reload();
  await waitUntilDrawn(page);
  const pressed = await page
    .locator(".menu-item[aria-keyshortcuts]")
    .evaluateAll((items) =>
      items.filter((item) => item.ariaPressed === "true").map((item) => item.children[1].textContent),
    );
  assert.deepEqual(pressed, [
    "Beams",
    "Points",
    "Trails",
    "Names",
    "States",
    "Grid",
    "Actuators and radio",
  ]);
});

test("the inspector shows each sensor's readings", async () => {
  await page.locator('[data-robot="surveyor"]').click();
  const values = (sensor) => inspector().locator(`[data-sensor="${sensor}"] .values`);
  await values("sonar")
    .getByText(/^\d\.\d\d\d m$/)
    .waitFor();
  await values("imu")
    .getByText(/^9\.8\d\d m\/s²$/)
    .waitFor();
  await values("lidar").getByText("ranges min").waitFor();
  assert.equal(await values("camera").textContent(), "");
  await keepPicture(page, "inspector");
});

test("the pose is copied in the format of files", async () => {
  await press("Copy pose");
  const text = await page.evaluate(() => navigator.clipboard.readText());
  const numbers = text.split(" ").map(Number);
  const { pose } = (await ask(page, "")).robots.find(({ name }) => name === "surveyor");
  assert.equal(numbers.length, 6);
  assert.ok(Math.abs(numbers[0] - pose.x_m) < 1e-3 && Math.abs(numbers[1] - pose.y_m) < 1e-3, text);
});

test("a chase looks from behind, a robot's view ahead, and afterwards the former view returns", async () => {
  const view = () => page.evaluate(() => window.gsv.view);
  const robot = await page.evaluate(() => window.gsv.robotPosition("surveyor"));
  await page.keyboard.press("c");
  await settled(page);
  const [x, y, , tx, ty] = await view();
  const away = Math.hypot(x - robot.x, y - robot.y);
  assert.ok(away > 1 && away < 4, `it stands ${away} m away`);
  assert.ok(Math.hypot(tx - robot.x, ty - robot.y) < 0.2, `it looks at ${tx}, ${ty}`);
  const behind = await picture(page, await viewClip(page));
  await page.keyboard.press("v");
  await settled(page);
  const eye = await picture(page, await viewClip(page));
  const share = changedPixels(behind, eye) / (eye.width * eye.height);
  assert.ok(share > 0.3, `only ${share} of the picture changed`);
  assert.equal(await page.getByRole("button", { name: "Robot's eye" }).getAttribute("aria-pressed"), "true");
  await page.keyboard.press("o");
  await settled(page);
  const again = await view();
  assert.ok(Math.hypot(again[0] - x, again[1] - y) < 0.05, `it came back to ${again}`);
  await page.keyboard.press("r");
});

test("values are plotted against simulated time and saved as a table", async () => {
  await page.locator('[data-robot="pebble"]').click();
  await press("Plot speed");
  await inspector().locator('[data-sensor="sonar_00"] dd').waitFor();
  await press("Plot sonar_00 range");
  const legend = page.getByRole("list", { name: "Curves" });
  await legend.getByText("pebble sonar_00 range").waitFor();
  await press("Resume");
  await phaseIs(page, "running");
  const then = await page.evaluate(() => window.gsv.time);
  await page.waitForFunction((time) => window.gsv.time > time + 3, then);
  await press("Pause");
  await phaseIs(page, "paused");
  await legend.getByText(/m\/s$/).waitFor();
  await keepPicture(page, "plots");
  const canvas = page.getByRole("img", { name: "Plot", exact: true }).locator("canvas").first();
  const drawn = await canvas.evaluate((each) => {
    const { data } = each.getContext("2d").getImageData(0, 0, each.width, each.height);
    let blue = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 200 && data[i + 2] > 180 && data[i] < 120) blue += 1;
    }
    return blue;
  });
  assert.ok(drawn > 50, `${drawn} pixels of a curve`);
  const { name, bytes } = await downloaded(() => press("Save as CSV"));
  assert.match(name, /^simulation plot .*\.csv$/);
  const [head, ...rows] = bytes.toString().trim().split("\r\n");
  assert.equal(head, "time_s,pebble speed [m/s],pebble sonar_00 range [m]");
  const times = rows.map((row) => Number(row.split(",")[0]));
  assert.ok(rows.length > 20, `${rows.length} rows`);
  assert.deepEqual(
    times,
    [...times].sort((a, b) => a - b),
  );
  const ranges = rows.map((row) => row.split(",")[2]).filter((text) => text !== "");
  assert.ok(ranges.length > 5 && ranges.every((text) => Number(text) >= 0 && Number(text) <= 3), `${ranges}`);
});

test("plots stop while the simulation is paused", async () => {
  const rows = async () =>
    (await downloaded(() => press("Save as CSV"))).bytes.toString().split("\r\n").length;
  const then = await rows();
  await settled(page);
  assert.equal(await rows(), then);
  await press("Close plots");
});

test("an image of the view is saved as it is displayed", async () => {
  const { name, bytes } = await downloaded(() => page.keyboard.press("x"));
  assert.match(name, /^simulation view .*\.png$/);
  assert.equal(isBlank(PNG.sync.read(bytes)), false);
});

test("a video of the view is saved", async () => {
  await page.keyboard.press("m");
  await press("Resume");
  await phaseIs(page, "running");
  const frames = await page.evaluate(() => window.gsv.frames);
  await page.waitForFunction((then) => window.gsv.frames > then + 15, frames);
  const { name, bytes } = await downloaded(() => page.keyboard.press("m"));
  assert.match(name, /^simulation video .*\.webm$/);
  assert.equal(bytes.readUInt32BE(0), 0x1a45dfa3); // EBML
  assert.ok(bytes.length > 5000, `${bytes.length} bytes`);
});

test("a link restores the robot and the camera", async () => {
  await press("Pause");
  await phaseIs(page, "paused");
  await page.keyboard.press("f");
  // Waits until the view has stopped moving.
  const view = () => page.evaluate(() => window.gsv.view);
  await until(async () => {
    const then = await view();
    await settled(page);
    const now = await view();
    return now.every((value, i) => Math.abs(value - then[i]) < 1e-3);
  }, "a view at rest");
  await page.keyboard.press("l");
  await page.getByText("Link copied.").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(link, page.url());
  const other = await openBrowser({ width: 1100, height: 700 });
  try {
    const there = await openPage(other, link);
    await waitUntilDrawn(there.page);
    await settled(there.page);
    const seen = (of) =>
      of.evaluate(() => ({ view: window.gsv.view, at: window.gsv.robotScreenPosition("pebble") }));
    const [here, again] = [await seen(page), await seen(there.page)];
    here.view.forEach((value, i) =>
      assert.ok(Math.abs(value - again.view[i]) < 0.01, `${here.view}; ${again.view}`),
    );
    assert.ok(Math.hypot(here.at.x - again.at.x, here.at.y - again.at.y) < 3);
    assert.equal(await there.page.getByRole("heading", { name: "pebble" }).isVisible(), true);
    assert.deepEqual(there.faults, []);
  } finally {
    await other.close();
  }
});

test("the sheet of keys lists all keys", async () => {
  await page.keyboard.press("?");
  const sheet = page.getByRole("dialog");
  for (const text of ["Chase the selected robot", "Trails", "recording a video", "Plots"]) {
    await sheet.getByText(text).first().waitFor();
  }
  await keepPicture(page, "keys");
  await page.keyboard.press("Escape");
  await sheet.waitFor({ state: "hidden" });
});

test("a panel shows the status of the simulation, its robots and the server", async () => {
  await page.keyboard.press("i");
  const panel = page.getByRole("region", { name: "Status", exact: true });
  await panel.getByRole("button", { name: "surveyor" }).click();
  await page.getByRole("heading", { name: "surveyor" }).waitFor();
  await panel.getByText("target real-time factor").waitFor();
  await panel.getByText(new URL(server.url).host).waitFor();
  await settled(page);
  await keepPicture(page, "status");
  await panel.getByRole("button", { name: "Close status" }).click();
  assert.equal(await panel.isVisible(), false);
});

test("single keys can be turned off with the keyboard, and the page stores it", async () => {
  const panel = page.getByRole("region", { name: "Status", exact: true });
  await page.keyboard.press("?");
  const setting = page.getByRole("checkbox", { name: "Single-key shortcuts" });
  await page.keyboard.press("Tab");
  assert.equal(await setting.evaluate((box) => box === document.activeElement), true);
  await page.keyboard.press("Space");
  assert.equal(await setting.isChecked(), false);
  await page.keyboard.press("Escape");
  await page.reload();
  await waitUntilDrawn(page);
  for (const key of ["i", "?", "t"]) await page.keyboard.press(key);
  assert.equal(await page.getByRole("dialog").isVisible(), false);
  await page.getByRole("button", { name: "Help" }).focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Space");
  await page.keyboard.press("Escape");
  await page.keyboard.press("i");
  await panel.waitFor();
});

test("no other host was contacted and there were no errors", () => assert.deepEqual(faults, []));
