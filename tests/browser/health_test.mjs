// Tests that the page shows what is wrong: the robots in trouble with the reasons, what a behaviour
// printed before it died, and the violated expectations.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import process from "node:process";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { SHARP, keepPicture } from "./documentation.mjs";
import { startServer } from "./server.mjs";
import { until } from "./viewing.mjs";

// A behaviour that drives into obstacles.
const BLIND = `#!/usr/bin/python3
import gsv

class Blind(gsv.Behaviour):
    def run(self, robot):
        robot.drive(0.4, 0.0)
        while robot.sleep_for(0.1):
            robot.drive(0.4, 0.0)

gsv.serve("blind", Blind)
`;
// A behaviour that prints a line and then fails with an exception.
const BRITTLE = `#!/usr/bin/python3
import gsv

class Brittle(gsv.Behaviour):
    def run(self, robot):
        print("one step at a time")
        robot.sleep_for(1.0)
        raise ValueError("too far")

gsv.serve("brittle", Brittle)
`;
const SCENARIO = `
world: playground
mode: real_time
duration: 3600
on_failure: go_on
robots:
  - {name: blind, model: pebble, x: 2, y: -3.5, behaviour: blind}
  - {name: brittle, model: pebble, x: -1, y: 1, behaviour: brittle}
  - {name: walker, model: pebble, x: 0, y: -1, behaviour: wander}
expect:
  - name: it arrives
    reaches: {robot: walker, x: 90, y: 0, within: 0.5}
  - name: it stays behind the line
    stays_within: {robot: blind, x: [-10, 2.2]}
  - name: it began at its place
    reaches: {robot: walker, x: 0, y: -1, within: 1}
`;

let folder;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-health-"));
  for (const [name, program] of Object.entries({ blind: BLIND, brittle: BRITTLE })) {
    fs.writeFileSync(path.join(folder, `gsv-${name}`), program, { mode: 0o755 });
  }
  fs.writeFileSync(path.join(folder, "trouble.yaml"), SCENARIO);
  process.env.PATH = `${folder}:${process.env.PATH}`;
  process.env.PYTHONPATH = path.join(process.env.GSV_BUILD_DIR, "python");
  server = await startServer([path.join(folder, "trouble.yaml")]);
  browser = await openBrowser({ width: 1280, height: 800 });
  ({ page, faults } = await openPage(browser, server.url + SHARP));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const chip = (state) => page.locator(`.health-strip button[data-state="${state}"]`);
const row = (robot) => page.locator(`[data-robot="${robot}"]`);
const labels = () => page.evaluate(() => window.gsv.labels.map(({ name }) => name));
const listed = () => page.locator("[data-robot]").evaluateAll((rows) => rows.map(({ dataset }) => dataset.robot));

test("the strip counts stuck and dead robots, and the list begins with the worst", async () => {
  await chip("stuck").filter({ hasText: "1 stuck" }).waitFor();
  await chip("dead").filter({ hasText: "1 dead" }).waitFor();
  await until(async () => (await listed()).join() === "brittle,blind,walker", "the worst first");
});

test("a click on a state shows only its robots, in the list and in the view", async () => {
  await chip("stuck").click();
  await until(async () => (await listed()).join() === "blind", "one row");
  await until(async () => (await labels()).join() === "blind", "one name");
  await chip("stuck").click();
  await until(async () => (await listed()).length === 3, "all rows");
});

test("the list and the inspector show why a robot does not move", async () => {
  await row("blind").locator(".robot-behaviour", { hasText: /stuck.* for \d+ s/ }).waitFor();
  await row("blind").click();
  const why = page.getByRole("region", { name: "State of the robot" });
  await why.getByText("Commanded", { exact: true }).waitFor();
  assert.match(await why.innerText(), /0\.40 m\/s/);
  assert.match(await why.locator(".why-sentence").innerText(), /stuck/);
});

test("the inspector shows what a behaviour printed before it died", async () => {
  await row("brittle").click();
  const output = page.getByRole("log", { name: "Output" });
  await output.getByText("one step at a time").waitFor();
  await output.getByText(/ValueError: too far/).first().waitFor();
  assert.ok((await output.locator(".warning, .error").count()) > 0);
  await keepPicture(page, "trouble");
});

test("expectations are summarised, and a panel shows each with its verdict", async () => {
  await page.getByRole("button", { name: "Expectations: 1 of 3 violated" }).click();
  const rows = page.locator("li.expectation");
  await until(async () => (await rows.count()) === 3, "three expectations");
  const verdicts = await rows.evaluateAll((all) => all.map(({ dataset }) => dataset.verdict));
  assert.deepEqual(verdicts, ["pending", "violated", "holds"]);
  assert.equal(await rows.nth(1).locator(".expectation-name").innerText(), "it stays behind the line");
  await keepPicture(page, "expectations");
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
