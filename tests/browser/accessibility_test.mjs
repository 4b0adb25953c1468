// Runs axe-core on every page, in light and dark colours. It checks names, roles, contrast and
// more.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { judge } from "./axe.mjs";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { record, startReplay, startServer } from "./server.mjs";

const WATCH = "watching-0123456789abcdef";
const RUN = ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander"];

let folder;
let live;
let replay;
let browser;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-accessibility-"));
  const file = path.join(folder, "run.mcap");
  await record(file, [...RUN, "--lockstep", "--duration", "2"]);
  live = await startServer([...RUN, "--recordings", folder]);
  await pauseAt(live.url);
  replay = await startReplay([file, "--paused"]);
  browser = await openBrowser({ width: 1100, height: 700 });
});

after(async () => {
  await browser?.close();
  await live?.stop();
  await replay?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

async function pauseAt(url) {
  const [{ name }] = await (await fetch(`${url}api/simulations`)).json();
  const headers = { "content-type": "application/json" };
  const answer = await fetch(`${url}api/simulations/${name}/pause`, { method: "POST", headers, body: "{}" });
  assert.equal(answer.status, 200);
}

// Waits until this page is the only viewer. The page of an earlier test may still be counted. If the
// number changes while axe-core looks at the page, it compares the old name with the new text.
async function alone(page) {
  await page.locator('button[aria-label="Viewers"]').waitFor({ state: "attached" });
}

// A robot is selected, its sensors are read, and a value is plotted. The simulation is paused,
// because a changing image keeps a browser without a graphics card busy.
async function openFilled(url) {
  const { page } = await openPage(browser, url);
  await waitUntilDrawn(page);
  await alone(page);
  await page.locator("[data-robot]").first().click();
  // The browser stores the layout: an earlier test may have left another panel in front.
  await page.getByRole("tab", { name: "Inspector", exact: true }).click();
  await page.getByRole("button", { name: "Plot speed" }).click();
  await page.locator('[data-sensor="sonar_00"] dd').waitFor();
  return page;
}

test("the viewer with all panels and the sheet of keys has no accessibility problems", async () => {
  const page = await openFilled(live.url);
  await page.getByRole("button", { name: "Diagnostics" }).click();
  await page.getByText("open files").waitFor();
  await page.getByRole("button", { name: "Status", exact: true }).click();
  await page.locator(".status tbody tr").first().waitFor();
  await page.getByRole("button", { name: "Overlays", exact: true }).click();
  await judge(page);
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Topics", exact: true }).click();
  await page.locator('[data-topic="/gsv/status"]').click();
  await page.locator(".tree-line").first().waitFor();
  await page.getByRole("button", { name: "Layout", exact: true }).click();
  await judge(page);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+k");
  await page.locator(".palette-item").first().waitFor();
  await judge(page);
  await page.keyboard.press("Escape");
  await page.keyboard.press("?");
  await page.getByRole("dialog").waitFor();
  await judge(page);
  await page.close();
});

// Opens a panel, unless it is open and in sight.
async function openPanel(page, name) {
  const button = page.getByRole("button", { name, exact: true });
  if ((await button.getAttribute("aria-pressed")) !== "true") await button.click();
  await page.getByRole("tab", { name, exact: true }).click();
}

for (const [size, width, height] of [
  ["a wide window", 1366, 768],
  ["a phone", 390, 780],
]) {
  test(`plots, teleoperation, joints, images, world and physics in ${size}`, async () => {
    const { page } = await openPage(browser, live.url);
    await page.setViewportSize({ width, height });
    await waitUntilDrawn(page);
    await alone(page);
    await openPanel(page, "Teleoperation");
    await page.getByText("No robot can be driven").waitFor();
    await openPanel(page, "Plots");
    await page.getByRole("button", { name: "Expression…" }).click();
    await page.getByLabel("Expression", { exact: true }).fill("2 *");
    await page.getByRole("button", { name: "Add", exact: true }).click();
    await judge(page);
    await openPanel(page, "Joints");
    await page.locator("[data-joint]").first().waitFor();
    await openPanel(page, "Physics");
    await page.getByRole("heading", { name: "Mean cost of a step" }).waitFor();
    await judge(page);
    await openPanel(page, "Images");
    await page.getByRole("combobox", { name: "Camera" }).waitFor();
    await openPanel(page, "World");
    await page.locator('[data-node="pebble"]').click();
    await page.getByRole("region", { name: "Selected part" }).getByText("robot", { exact: true }).waitFor();
    await judge(page);
    await page.close();
  });
}

test("the number of viewers is a part of the name of their button", async () => {
  const first = (await openPage(browser, live.url)).page;
  const second = (await openPage(browser, live.url)).page;
  await second.getByRole("button", { name: "Viewers 2", exact: true }).waitFor();
  await judge(second);
  await second.close();
  await first.close();
});

test("editing and the set-up form have no accessibility problems", async () => {
  const page = await openFilled(live.url);
  await page.getByRole("button", { name: "Edit", exact: true }).click();
  await page.getByRole("region", { name: "Edit" }).waitFor();
  await judge(page);
  for (const menu of ["Shape", "Robot or object", "Save"]) {
    await page.getByRole("button", { name: menu, exact: true }).click();
    await page.getByRole("group", { name: menu, exact: true }).waitFor();
    await judge(page);
    await page.keyboard.press("Escape");
  }
  await page.getByRole("button", { name: "New simulation" }).click();
  await page.getByRole("button", { name: "Add robot" }).click();
  await page.locator('.set-up[aria-busy="false"]').waitFor();
  await page.getByText("Parameters", { exact: true }).click();
  await page.getByLabel("Real-time factor (simulated seconds per second)").fill("-1");
  await page.keyboard.press("Tab");
  await page.locator(".field-error", { hasText: "a number from" }).waitFor();
  await judge(page);
  await page.close();
});

test("the page for joining has no accessibility problems", async () => {
  const { page } = await openPage(browser, `${live.url}join.html`);
  await page.locator(".joinable").first().waitFor();
  await judge(page);
  await page.close();
});

test("the page of recordings has no accessibility problems", async () => {
  const { page } = await openPage(browser, `${live.url}recordings.html`);
  await page.locator(".recording").first().waitFor();
  await judge(page);
  fs.writeFileSync(path.join(folder, "broken.mcap"), "no recording");
  await page.reload();
  await page.getByText("interrupted").waitFor();
  await judge(page);
  await page.close();
});

test("a replay with its log has no accessibility problems", async () => {
  const page = await openFilled(replay.url);
  await page.getByRole("button", { name: "Log", exact: true }).click();
  await page.locator(".log-line").first().waitFor();
  await judge(page);
  await page.close();
});

test("the token forms and an empty page of recordings have no accessibility problems", async () => {
  const empty = fs.mkdtempSync(path.join(folder, "empty-"));
  const server = await startServer([...RUN, "--watch-token", WATCH, "--recordings", empty]);
  try {
    const { page } = await openPage(browser, server.url);
    await page.getByText("This server requires a token").waitFor();
    await judge(page);
    await page.getByLabel("Token").fill("not the right one");
    await page.keyboard.press("Enter");
    await page.getByText("this token is wrong").waitFor();
    await judge(page);
    for (const name of ["recordings", "join", "broker"]) {
      await page.goto(`${server.url}${name}.html`);
      await page.getByText("this token is wrong").first().waitFor();
      await judge(page);
    }
    await page.goto(`${server.url}recordings.html#token=${WATCH}`);
    await page.reload();
    await page.getByText("No recordings yet").waitFor();
    await judge(page);
    await page.close();
  } finally {
    await server.stop();
  }
});

test("the broker page has no accessibility problems", async () => {
  const { page } = await openPage(browser, `${live.url}broker.html`);
  await page.locator('[data-type="gsv::SimulationService"]').click();
  await page.locator(".offer").first().waitFor();
  await judge(page);
});
