// Tests the colours of plots, and of a panel in its own window, in dark and in light colours, and
// that a panel shows the same when its window is closed. The colours are those of the pixels on the
// screen. Contrasts are those of WCAG 2.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { faultsOf } from "./axe.mjs";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { isBlank, picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, settled, until } from "./viewing.mjs";

const READABLE = 4.5; // minimum contrast of text (WCAG 2, 1.4.3)
const VISIBLE = 1.25; // minimum contrast of the lines of the grid
const CURVE = 3; // minimum contrast of graphics (WCAG 2, 1.4.11)
const [LEFT_PX, BOTTOM_PX] = [54, 22]; // sizes of the axes of a chart

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander", "--in-process"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
  await page.locator('[data-robot="pebble"]').click();
  await press("Plots");
  await choose("Add a curve", "robot x");
  await choose("Add a curve", "robot y");
  await choose("Time shown", "null");
  await phaseIs(page, "running");
  const { time_s: time } = await ask(page, "");
  await until(async () => (await ask(page, "")).time_s > time + 4, "four simulated seconds");
  // During the pause no new values arrive. Only the change of the colours draws the charts again.
  await press("Pause");
  await phaseIs(page, "paused");
  await settled(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const panel = (of = page) => of.getByRole("region", { name: "Plots", exact: true });
const press = (name, of = page) => of.getByRole("button", { name, exact: true }).click();
const choose = (name, value) => panel().getByRole("combobox", { name }).selectOption(value);

const colourAt = ({ width, data }, x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)];

function luminance(colour) {
  const [r, g, b] = colour.map((value) => (value <= 10 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a, b) {
  const [bright, dark] = [luminance(a), luminance(b)].sort((p, q) => q - p);
  return (bright + 0.05) / (dark + 0.05);
}

// The most frequent colour among these pixels.
function mostFrequent(colours) {
  const counts = new Map();
  for (const colour of colours) counts.set(colour.join(), (counts.get(colour.join()) ?? 0) + 1);
  return [...counts].sort((a, b) => b[1] - a[1])[0][0].split(",").map(Number);
}

function colours(image, { left = 0, top = 0, right = image.width, bottom = image.height }) {
  const found = [];
  for (let y = top; y < bottom; y++) for (let x = left; x < right; x++) found.push(colourAt(image, x, y));
  return found;
}

// The colours of the horizontal lines of the grid: lines that most pixels of a row belong to.
function gridOf(image, background) {
  const lines = [];
  for (let y = 4; y < image.height - BOTTOM_PX - 4; y++) {
    const row = colours(image, { left: LEFT_PX + 2, top: y, right: image.width - 12, bottom: y + 1 });
    const colour = mostFrequent(row);
    const share = row.filter((each) => each.join() === colour.join()).length / row.length;
    if (share > 0.6 && colour.join() !== background.join()) lines.push(colour);
  }
  return lines;
}

// Returns what is wrong with the colours of the chart on the screen of a page; null if nothing.
// `bottom` is the height of the axis below the chart.
async function problemOf(of, isDark, bottom = BOTTOM_PX) {
  const image = await picture(of, await panel(of).getByRole("img", { name: "Plot", exact: true }).boundingBox());
  const background = mostFrequent(colours(image, {}));
  const strongest = (part) => Math.max(...colours(image, part).map((colour) => contrast(colour, background)));
  const saturated = colours(image, { left: LEFT_PX + 4, bottom: image.height - bottom }).filter((colour) => Math.max(...colour) - Math.min(...colour) > 120);
  const grid = gridOf(image, background);
  const found = {
    background: luminance(background),
    values: strongest({ right: LEFT_PX - 6, bottom: image.height - bottom - 2 }),
    below: strongest({ left: LEFT_PX, top: image.height - bottom + 4 }),
    grid: grid.length === 0 ? 0 : Math.min(...grid.map((colour) => contrast(colour, background))),
    curve: saturated.length < 20 ? 0 : contrast(mostFrequent(saturated), background),
  };
  const isRight =
    (isDark ? found.background < 0.05 : found.background > 0.8) &&
    Math.min(found.values, found.below) >= READABLE &&
    found.grid >= VISIBLE && found.grid < CURVE &&
    found.curve >= CURVE;
  return isRight ? null : JSON.stringify(found);
}

async function hasReadableColours(of, colorScheme, bottom) {
  let problem = null;
  await until(async () => {
    problem = await problemOf(of, colorScheme === "dark", bottom);
    return problem === null;
  }, `readable ${colorScheme} colours`).catch((error) => assert.fail(`${error.message}: ${problem}`));
}

const change = (of, colorScheme) => of.emulateMedia({ colorScheme, reducedMotion: "reduce" });

test("axes, grid and curves against time have readable colours, also when the colours change during a pause", async () => {
  for (const colorScheme of ["light", "dark", "light", "dark"]) {
    await change(page, colorScheme);
    await hasReadableColours(page, colorScheme);
  }
});

test("the axes and the grid of a path have readable colours", async () => {
  await choose("Horizontal axis", "robot pebble x");
  for (const colorScheme of ["light", "dark"]) {
    await change(page, colorScheme);
    await hasReadableColours(page, colorScheme, 34);
  }
  await choose("Horizontal axis", "");
});

test("a panel in its own window has the colours of the system", async () => {
  await change(page, "dark");
  const opened = page.waitForEvent("popup");
  await press("Arrange plots");
  await press("Open in a separate window");
  const popup = await opened;
  for (const colorScheme of ["dark", "light", "dark"]) {
    await change(popup, colorScheme);
    await hasReadableColours(popup, colorScheme);
    // The text beside the chart, and the ground of the window.
    assert.deepEqual(await faultsOf(popup, ["color-contrast"]), []);
    const { width, height } = popup.viewportSize() ?? (await popup.evaluate(() => ({ width: innerWidth, height: innerHeight })));
    const image = await picture(popup, { x: 0, y: 0, width, height });
    const ground = luminance(mostFrequent(colours(image, {})));
    assert.ok(colorScheme === "dark" ? ground < 0.05 : ground > 0.8, `the window has the luminance ${ground}`);
  }
  await popup.close();
  await panel().getByRole("img", { name: "Plot", exact: true }).waitFor();
  await hasReadableColours(page, "dark");
});

test("the image of a camera is shown in its own window, and again when this window is closed", async () => {
  const isShown = (of) => until(async () => !isBlank(await picture(of, await of.locator("canvas.picture").boundingBox())), "the image");
  await isShown(page);
  const opened = page.waitForEvent("popup");
  await press("Arrange images");
  await press("Open in a separate window");
  const popup = await opened;
  await popup.locator("canvas.picture").waitFor();
  await isShown(popup);
  await popup.close();
  await page.locator("canvas.picture").waitFor();
  await isShown(page); // the simulation is paused, so no new image arrives
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
