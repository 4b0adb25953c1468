// Tests the panels Physics and World with a run in lockstep.
import assert from "node:assert/strict";
import fs from "node:fs";
import process from "node:process";
import { after, before, test } from "node:test";
import { setTimeout } from "node:timers/promises";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { until } from "./viewing.mjs";

const HELD_MS = 500; // the time that a behaviour takes for one step

let server;
let browser;
let page;
let faults;

before(async () => {
  const robots = ["--robot", "pebble@0,-1.5", "--behaviour", "pebble=wander", "--robot", "porter@2,-3", "--behaviour", "porter=cruise"];
  server = await startServer(["playground", ...robots, "--lockstep"]);
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

// Returns the process of a behaviour that the server has started.
function processOf(behaviour) {
  const found = fs.readdirSync("/proc").filter((name) => /^\d+$/.test(name)).find((pid) => {
    try {
      const command = fs.readFileSync(`/proc/${pid}/cmdline`, "latin1");
      const stat = fs.readFileSync(`/proc/${pid}/stat`, "latin1");
      return command.includes(behaviour) && stat.slice(stat.lastIndexOf(")") + 2).split(" ")[1] === String(server.child.pid);
    } catch {
      return false; // the process has ended
    }
  });
  assert.ok(found, `the process of ${behaviour}`);
  return Number(found);
}

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
});

// Returns the numbers of milliseconds in the cells of a table.
const msOf = async (cells) => (await cells.allTextContents()).map((text) => Number(/^([\d.,]+) ms$/.exec(text)?.[1].replaceAll(",", "") ?? NaN));

test("the panel Physics shows the speed and the mean cost of each part of a step, as numbers and as bars", async () => {
  const physics = panel("Physics");
  const fact = (name) => physics.locator("dt").filter({ hasText: new RegExp(`^${name}$`) }).locator("xpath=following-sibling::dd[1]").textContent();
  assert.equal(await fact("mode"), "lockstep");
  const rows = physics.getByRole("heading", { name: "Mean cost of a step" }).locator("xpath=..").locator("tr");
  assert.deepEqual(await rows.locator("th").allTextContents(), ["Behaviours", "Devices", "Bodies", "Observers", "Idle"]);
  const [costs, widths] = await rows.evaluateAll((all) => [
    all.map((row) => Number(row.querySelector(".number").textContent.replace(" ms", ""))),
    all.map((row) => row.querySelector(".cost-bar").getBoundingClientRect().width),
  ]);
  const [cost, width] = [costs, widths].map((values) => values.reduce((sum, value) => sum + value, 0));
  assert.ok(cost > 0, `${costs}`);
  costs.forEach((ms, i) => assert.ok(Math.abs(ms / cost - widths[i] / width) < 0.03, `bars of ${widths} pixels for ${costs} ms`));
  // A run in lockstep takes its steps one after another. The page measures the real-time factor and the
  // costs over different seconds.
  const [step, factor] = [parseFloat(await fact("step")), parseFloat(await fact("real-time factor"))];
  assert.ok(factor * cost > 0.1 * step && factor * cost < 3 * step, `steps of ${step} ms in ${cost} ms, at ${factor}x`);
});

test("the waterfall names the behaviour that holds up a step, and by how much", async () => {
  const physics = panel("Physics");
  const pid = processOf("gsv-cruise");
  process.kill(pid, "SIGSTOP");
  await setTimeout(HELD_MS);
  process.kill(pid, "SIGCONT");
  const held = physics.locator(".waterfall tbody tr", { has: page.getByRole("cell", { name: "porter", exact: true }) });
  await until(async () => (await msOf(held.locator("td:last-child"))).some((ms) => ms > 0.9 * HELD_MS), "the long step of the robot porter");
  const delays = physics.locator(".panel-table tbody tr", { has: page.getByRole("button", { name: "porter", exact: true }) });
  const [, mean, most] = await msOf(delays.locator("td.number"));
  assert.ok(most > 0.9 * HELD_MS && mean < most, `${mean} ms on average, ${most} ms at most`);
  await press("Close physics");
  await until(async () => !(await page.evaluate(() => window.gsv.topics)).includes("/gsv/step_costs"), "the end of the measurement");
});

test("the panel Physics says why a run is slower than its target", async () => {
  const fast = await startServer(["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander", "--in-process", "--real-time-factor", "100000"]);
  const { page: other } = await openPage(browser, fast.url);
  await waitUntilDrawn(other);
  await other.getByRole("button", { name: "Physics", exact: true }).click();
  const sentence = other.getByRole("region", { name: "Physics", exact: true }).getByText(/^The simulation runs at [\d.]+× real time, not at the target 100000×\. /);
  await sentence.waitFor();
  await until(async () => / \d+ % of the time/.test(await sentence.textContent()), "the part that takes most of the time");
  await other.close();
  await fast.stop();
  await page.bringToFront();
});

test("the tree of the panel World contains links, joints, sensors and transforms", async () => {
  await press("World");
  const world = panel("World");
  await world.getByLabel("Search the world by name").fill("pebble");
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
