// Tests plots as they are drawn: curves of any field, expressions, paths, and marks of events.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { judge } from "./axe.mjs";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, settled, until } from "./viewing.mjs";

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
  await page.locator('[data-robot="pebble"]').click();
  await press("Plots");
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const panel = () => page.getByRole("region", { name: "Plots", exact: true });
const press = (name) => page.getByRole("button", { name, exact: true }).click();
const choose = (name, value) => panel().getByRole("combobox", { name }).selectOption(value);
const legend = () => panel().getByRole("list", { name: "Curves" });
const charts = () => panel().getByRole("img", { name: "Plot", exact: true }).locator("canvas");

// Returns the number of pixels with a colour: blue for the first curve, or the colour of the second
// curve.
async function pixelsOf(colour) {
  return charts().evaluateAll((canvases, name) => {
    const isOf = { blue: (r, g, b) => b > 180 && r < 120, orange: (r, g, b) => r > 180 && b < 120 && g > 60 && g < 160 }[name];
    let found = 0;
    for (const canvas of canvases) {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200 && isOf(data[i], data[i + 1], data[i + 2])) found += 1;
    }
    return found;
  }, colour);
}

// Pauses the run at an instant at which the robot moves, and returns the values of the curves. The
// robot turns on the spot now and then, so that one pause may not suffice.
async function valuesWhenMoving() {
  for (;;) {
    await press("Pause");
    await phaseIs(page, "paused");
    await settled(page);
    const values = (await legend().locator("li .number").allTextContents()).slice(1).map(parseFloat);
    if (values[0] > 0) return values;
    const { time_s: time } = await ask(page, "");
    await press("Start");
    await until(async () => (await ask(page, "")).time_s > time + 0.5, "half a simulated second");
  }
}

test("a value and an expression that uses it are two curves in two charts", async () => {
  await choose("Add a curve", "robot speed");
  await press("Expression…");
  await panel().getByLabel("Expression", { exact: true }).fill("{pebble speed} *");
  await press("Add");
  await panel().getByText("The expression is not complete.").waitFor();
  await panel().getByLabel("Expression", { exact: true }).fill("3.6 * {pebble speed}");
  await press("Add");
  await legend().getByText("3.6 * {pebble speed}").waitFor();
  await until(async () => (await pixelsOf("blue")) > 50 && (await pixelsOf("orange")) > 50, "both curves");
  assert.equal(await charts().count(), 2, "a chart for each unit");
  const [speed, product] = await valuesWhenMoving();
  assert.ok(Math.abs(product - 3.6 * speed) < 0.005, `${product} is not 3.6 times ${speed}`);
});

test("an event is marked where it happened, and named under the pointer", async () => {
  await choose("Time shown", "null");
  const box = await panel().getByRole("img", { name: "Plot", exact: true }).boundingBox();
  // The instant of the pause is the newest one, at the right edge of the axis.
  await until(async () => {
    for (const left of [10, 11, 12, 13, 14, 16, 18]) {
      await page.mouse.move(box.x + box.width - left, box.y + box.height / 2);
      if (await legend().getByText(/paused/).count()) return true;
    }
    return false;
  }, "the pause");
});

test("a curve against another one is a path", async () => {
  await press("Remove 3.6 * {pebble speed}");
  await press("Remove pebble speed");
  await choose("Add a curve", "robot x");
  await choose("Add a curve", "robot y");
  await choose("Horizontal axis", "robot pebble x");
  await press("Resume");
  await phaseIs(page, "running");
  await until(async () => (await charts().count()) === 1 && (await pixelsOf("orange")) > 40, "the path of y against x");
  assert.equal(await pixelsOf("blue"), 0, "x itself is no curve");
  await choose("Horizontal axis", "");
  await until(async () => (await pixelsOf("blue")) > 20, "x against time");
});

test("a field of a topic that is not a robot's value is plotted", async () => {
  await press("Topics");
  await page.getByLabel("Text in topic or type").fill("/gsv/poses");
  await page.locator(".topic-list").getByRole("button", { name: "/gsv/poses" }).click();
  await press("Plot step");
  await legend().getByText("gsv poses step").waitFor();
  const { step } = await ask(page, "");
  await until(async () => parseFloat((await legend().locator("li .number").allTextContents()).at(-1)) > step, "the newest step");
});

test("on a phone, plots with curves have no accessibility problems", async () => {
  await page.setViewportSize({ width: 390, height: 780 });
  await page.getByRole("tab", { name: "Plots", exact: true }).click();
  await until(async () => (await pixelsOf("blue")) > 5, "the curve");
  await judge(page);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
