// The panels Physics and World, as they show a run in lockstep.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { until } from "./viewing.mjs";

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander", "--lockstep"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const press = (name) => page.getByRole("button", { name, exact: true }).click();
const panel = (name) => page.getByRole("region", { name, exact: true });

test("the panel Physics shows gravity, the step, the time of steps, and the behaviour that delays them", async () => {
  await press("Physics");
  const physics = panel("Physics");
  await physics.getByText(/^[\d.]+ ms$/).first().waitFor();
  await physics.getByText("-9.80 m/s² along z").or(physics.getByText("-9.81 m/s² along z")).waitFor();
  await physics.getByText(/^Lockstep: the simulation runs as fast as its steps allow/).waitFor();
  await physics.locator(".panel-table").getByRole("button", { name: "pebble" }).waitFor();
  const rows = physics.locator(".waterfall tbody tr");
  await until(async () => (await rows.count()) > 5, "the longest steps");
  const steps = (await rows.locator("td:first-child").allTextContents()).map((text) => Number(text.replaceAll(",", "")));
  assert.deepEqual(steps, [...steps].sort((a, b) => a - b));
  const widths = await rows.first().locator(".cost-bar").evaluateAll((bars) => bars.map((bar) => bar.getBoundingClientRect().width));
  assert.ok(Math.max(...widths) > 2, `a bar is seen: ${widths}`);
  assert.ok((await page.evaluate(() => window.gsv.topics)).includes("/gsv/step_costs"));
  await press("Close physics");
  await until(async () => !(await page.evaluate(() => window.gsv.topics)).includes("/gsv/step_costs"), "the end of the measurement");
});

test("the panel Physics says why a run is slower than its target", async () => {
  const fast = await startServer(["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander", "--in-process", "--real-time-factor", "100000"]);
  const { page: other } = await openPage(browser, fast.url);
  await waitUntilDrawn(other);
  await other.getByRole("button", { name: "Physics", exact: true }).click();
  const sentence = other.getByRole("region", { name: "Physics", exact: true }).getByText(/^The simulation runs at [\d.]+× of real time, not at 100000×\. /);
  await sentence.waitFor();
  await until(async () => / \d+ % of the time/.test(await sentence.textContent()), "the part that takes most of the time");
  await other.close();
  await fast.stop();
  await page.bringToFront();
});

test("the tree of the panel World contains links, joints, sensors and transforms", async () => {
  await press("World");
  const world = panel("World");
  await world.getByLabel("Name in the world").fill("pebble");
  await world.locator('[data-node="pebble"]').click();
  const part = world.getByRole("region", { name: "Selected part" });
  await part.getByText(/^-?[\d.]+, -?[\d.]+, -?[\d.]+ m$/).waitFor();
  const position = () => part.locator("dd").nth(4).textContent();
  const then = await position();
  await until(async () => (await position()) !== then, "the robot to move");
  await world.locator('[data-node="pebble::joint::left_wheel_joint"]').click();
  await part.getByText(/^-?[\d.]+ rad$/).waitFor();
  await world.locator("summary", { hasText: "Transforms" }).click();
  await world.locator('[data-node="tf::pebble/base_link"]').click();
  await part.getByText("map", { exact: true }).waitFor();
  await part.getByText(/^\d+\.\d\d s$/).first().waitFor();
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
