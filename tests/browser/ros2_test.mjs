// Tests the switch "Publish to ROS 2" of the form: `gsv ros2 topics`, in a separate process, lists
// the topics of the simulation that the page creates.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import process from "node:process";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { openBrowser, openPage } from "./browser.mjs";
import { program, startServe } from "./server.mjs";
import { phaseIs, settled } from "./viewing.mjs";

const run = promisify(execFile);
const hasRos2 = fs.existsSync(path.join(path.dirname(program()), "..", "lib", "gsv", "gsv-ros2.so"));
process.env.ROS_DOMAIN_ID = String(81 + (process.pid % 20)); // tests/ros2/domains.py says which domains the tests use

let folder;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-ros2-"));
  server = await startServe(["--recordings", folder]);
  browser = await openBrowser({ width: 1200, height: 780 });
  ({ page, faults } = await openPage(browser, server.url));
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const press = (name) => page.getByRole("button", { name, exact: true }).click();
const field = (label) => page.getByLabel(label, { exact: true });

async function answered() {
  await page.locator('.set-up[aria-busy="false"]').waitFor();
  await settled(page);
}

async function topics() {
  const { stdout } = await run(program(), ["ros2", "topics", "--seconds", "3"]);
  return stdout;
}

test("a gsv without the plug-in shows why there is no switch", { skip: hasRos2 && "ROS 2 is built" }, async () => {
  await press("Create a simulation");
  await page.getByText("Not available: this gsv was built without ROS 2").waitFor();
});

test("until it is switched on, the process has no DDS threads and sockets", { skip: !hasRos2 && "built without ROS 2" }, async () => {
  assert.doesNotMatch(await topics(), /\/clock/);
});

test("a simulation is published in the chosen namespace", { skip: !hasRos2 && "built without ROS 2" }, async () => {
  await press("Create a simulation");
  await answered();
  await field("Publish to ROS 2").check();
  await field("Model to add").selectOption("pebble");
  await press("Add robot");
  await answered();
  await field("ROS 2 namespace").fill("fleet");
  await page.keyboard.press("Tab");
  await page.locator(".field-error").filter({ hasText: "must begin with a slash" }).waitFor();
  await field("ROS 2 namespace").fill("/fleet/one");
  await page.keyboard.press("Tab");
  await answered();
  await page.getByText("Parameters", { exact: true }).click();
  await field("Record from the start").check();
  await answered();
  await press("Create");
  await phaseIs(page, "created");
  await press("Start");
  await phaseIs(page, "running");
  const seen = await topics();
  for (const topic of ["/clock", "/tf", "/fleet/one/odom", "/fleet/one/cmd_vel"]) {
    assert.ok(seen.split(/\s+/).includes(topic), `${topic} is not among:\n${seen}`);
  }
});

test("while a simulation is published, another one is refused", { skip: !hasRos2 && "built without ROS 2" }, async () => {
  const answer = await fetch(new URL("api/simulations", server.url), {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify({ world: "office", ros2: true }),
  });
  const refused = await answer.json();
  assert.equal(refused.field, "ros2");
  assert.match(refused.error, /is published, and a ROS 2 domain has only one clock\. Remove it first/);
  const { published, reach } = await (await fetch(new URL("api/ros2", server.url))).json();
  assert.notEqual(published, "");
  assert.equal(reach, `domain ${process.env.ROS_DOMAIN_ID}, this machine only`);
});

test("the recording's scenario has the key ros2", { skip: !hasRos2 && "built without ROS 2" }, async () => {
  const { published } = await (await fetch(new URL("api/ros2", server.url))).json();
  const recording = new URL(`api/simulations/${encodeURIComponent(published)}`, server.url);
  await fetch(recording, { method: "DELETE" });
  const [file] = fs.readdirSync(folder).filter((name) => name.endsWith(".mcap"));
  assert.match(fs.readFileSync(path.join(folder, file), "latin1"), /\nros2: \{namespaces: \{pebble: \/fleet\/one\}\}/);
});

test("there were no other errors in the page", () => {
  assert.deepEqual(
    faults.filter((fault) => !/status of 4(00|22)/.test(fault)), // refusals, which the browser logs
    [],
  );
});
