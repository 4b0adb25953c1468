// Tests the page of recordings: made with the red button of a run, listed, replayed by a click, and
// linked to. Each page has its own replay.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { record, startServer } from "./server.mjs";
import { phaseIs, until } from "./viewing.mjs";

const RUN = ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander", "--seed", "3"];

let folder;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-recordings-"));
  await record(path.join(folder, "first run.mcap"), [...RUN, "--lockstep", "--duration", "6"]);
  fs.writeFileSync(path.join(folder, "half.mcap"), "this was cut off");
  server = await startServer([...RUN, "--recordings", folder]);
  browser = await openBrowser({ width: 1000, height: 640 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const item = (name) => page.locator(".recording", { has: page.getByRole("heading", { name }) });
const timeOn = (page) => page.evaluate(() => window.gsv.time);

async function goTo(page, time) {
  await page.getByLabel("Go to time").fill(String(time));
  await page.keyboard.press("Enter");
  await until(async () => (await timeOn(page)) === time, `the instant ${time}`);
}

test("a recording made with the red button is listed with its size and length", async () => {
  const button = page.getByRole("button", { name: "Record" });
  await button.click();
  await page.locator('button.record[aria-pressed="true"]').waitFor();
  await button.click();
  await page.getByText("Replay it on the page Recordings").waitFor();
  await page.getByRole("link", { name: "Recordings" }).click();
  await item("first run.mcap").getByText("0:06.00").waitFor();
  await item(/^simulation-/).getByText("messages").waitFor();
  await item("half.mcap").getByText("interrupted").waitFor();
  await keepPicture(page, "recordings");
});

test("one click replays it, and a link opens the same instant and view", async () => {
  await item("first run.mcap").getByRole("link", { name: "Replay" }).click();
  await waitUntilDrawn(page);
  await goTo(page, 4.5);
  await page.keyboard.press("Escape");
  await page.locator("body").click({ position: { x: 5, y: 5 } });
  await page.keyboard.press("l");
  await until(() => page.url().includes("#t=4.5"), "the link");
  const link = page.url();
  assert.equal(new URL(link).searchParams.get("recording"), "first run.mcap");
  const place = await page.evaluate(() => window.gsv.view);

  const other = await openBrowser({ width: 900, height: 600 });
  try {
    const { page: elsewhere, faults: otherFaults } = await openPage(other, link);
    await waitUntilDrawn(elsewhere);
    await until(async () => (await timeOn(elsewhere)) === 4.5, "the linked instant");
    const there = await elsewhere.evaluate(() => window.gsv.view);
    place.forEach((value, i) => assert.ok(Math.abs(there[i] - value) < 2e-3, `${there} is not ${place}`));
    // Each page has its own replay.
    await goTo(elsewhere, 1.25);
    assert.equal(await timeOn(page), 4.5);
    await elsewhere.keyboard.press("Escape");
    assert.deepEqual(otherFaults, []);
  } finally {
    await other.close();
  }
});

test("after a restart of the server, the replay continues at the same instant", async () => {
  await server.restart();
  await page.waitForFunction(() => document.querySelector(".overlay")?.hidden === true);
  await until(async () => (await timeOn(page)) === 4.5, "the instant of before");
  faults.length = 0; // the browser reports the refused connections
});

test("a link to a missing recording shows an error", async () => {
  // Uses a separate page: the one above may still be loading the world again, and leaving it then
  // would cause errors of the browser.
  await page.close();
  ({ page, faults } = await openPage(browser, `${server.url}?recording=gone.mcap#t=3`));
  await page.getByText("there is no recording 'gone.mcap'").waitFor();
  await page.getByRole("link", { name: "All recordings" }).click();
  await item("first run.mcap").waitFor();
  fs.rmSync(path.join(folder, "first run.mcap"));
  await item("first run.mcap").waitFor({ state: "detached" });
  assert.deepEqual(faults.filter((fault) => !/status of 404/.test(fault)), []);
  await page.goto(server.url);
  await waitUntilDrawn(page);
  await phaseIs(page, "running");
});
