// Tests the history of a running simulation: scrubbing while the simulation continues, with marks,
// notes and plots, and the return to the present.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { changedPixels, isBlank, picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { ask, settled, until, viewClip } from "./viewing.mjs";

const MOVER = "pebble";
const RUN = [
  "office",
  ...["--robot", `${MOVER}@-2,0`, "--behaviour", "wander"],
  ...["--seed", "3"],
];

let folder;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-past-"));
  server = await startServer([...RUN, "--recordings", folder]);
  browser = await openBrowser({ width: 1180, height: 720 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
  await slider().waitFor();
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const slider = () => page.getByRole("slider", { name: /^Time in the/ });
const timeOn = () => page.evaluate(() => window.gsv.time);
const runTime = async () => (await ask(page, "")).time_s;
const place = () => page.evaluate((robot) => window.gsv.robotPosition(robot), MOVER);
const live = () => page.getByRole("button", { name: "Live", exact: true });

async function scrubTo(time) {
  await slider().evaluate((input, wanted) => {
    input.value = String(wanted);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, time);
  await until(async () => Math.abs((await timeOn()) - time) < 0.01, `the instant ${time}`);
}

test("the timeline spans the run from its start, and grows with it", async () => {
  await until(async () => (await runTime()) > 6, "six simulated seconds");
  assert.equal(await slider().getAttribute("aria-label"), "Time in the run");
  assert.ok(Number(await slider().getAttribute("min")) < 1.5, "it begins late");
  assert.equal(await page.getByTestId("replay-end").textContent(), " live");
});

test("one scrubs back while the run continues: the page shows where the robot was", async () => {
  const clip = await viewClip(page);
  await scrubTo(2);
  await live().waitFor();
  await until(async () => Math.abs((await place()).time - 2) < 0.3, "the poses of that instant");
  const there = await place();
  assert.equal(await page.getByTestId("connection").textContent(), "Replay");
  const runThen = await runTime();
  await until(async () => (await runTime()) > runThen + 1, "the run to continue");
  assert.ok(Math.abs((await timeOn()) - 2) < 0.01, "the page has left the instant");
  await settled(page);
  const then = await picture(page, clip);
  assert.equal(isBlank(then), false);

  await scrubTo(5);
  await until(async () => Math.abs((await place()).time - 5) < 0.3, "the poses of another instant");
  const later = await place();
  assert.ok(Math.hypot(later.x - there.x, later.y - there.y) > 0.2, "the robot did not move");
  await settled(page);
  assert.ok(changedPixels(then, await picture(page, clip)) > 50, "the picture is the same");
  // After a return to the same instant, the robot must be at the same position.
  await scrubTo(2);
  await until(async () => Math.abs((await place()).time - there.time) < 1e-6, "the same poses");
  assert.deepEqual(await place(), there);
});

test("the past plays, and Live returns to the run", async () => {
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await until(async () => (await timeOn()) > 2.5, "playing");
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await live().click();
  await page.getByRole("group", { name: "Run" }).waitFor();
  await until(async () => Math.abs((await timeOn()) - (await runTime())) < 2, "the time of the run");
  const now = await timeOn();
  await until(async () => (await timeOn()) > now + 0.5, "the run on the page");
  assert.equal(await page.getByTestId("connection").textContent(), "Live");
});

test("a note is a mark for all viewers, also one on a past instant, and is in recordings", async () => {
  const record = page.getByRole("button", { name: "Record" });
  await record.click();
  await page.locator('button.record[aria-pressed="true"]').waitFor();
  await scrubTo(3);
  await page.getByRole("button", { name: "Notes" }).click();
  await page.getByLabel("Note", { exact: true }).fill("turns here");
  await page.getByRole("button", { name: "Add at 0:03.00" }).click();
  await page.locator(".note-list").getByText("turns here").waitFor();
  await page.keyboard.press("Escape");
  await keepPicture(page, "past");
  await live().click();

  const other = await openBrowser({ width: 900, height: 600 });
  try {
    const { page: elsewhere, faults: otherFaults } = await openPage(other, server.url);
    await waitUntilDrawn(elsewhere);
    await elsewhere.getByRole("button", { name: /^0:03.00 note · .*turns here/ }).waitFor();
    assert.deepEqual(otherFaults, []);
  } finally {
    await other.close();
  }
  await page.locator('button.record[aria-pressed="true"]').click();
  await page.getByText("Replay it on the page Recordings").waitFor();
  const [name] = fs.readdirSync(folder).filter((each) => each.endsWith(".mcap"));
  const events = await page.evaluate(async (recording) => {
    const { base } = await (await fetch(`api/recordings/${encodeURIComponent(recording)}/replay`, { method: "POST", body: "{}" })).json();
    const [{ name }] = await (await fetch(`${base}api/simulations`)).json();
    return (await fetch(`${base}api/simulations/${encodeURIComponent(name)}/events`)).json();
  }, name);
  const note = events.find(({ event }) => event === "note");
  assert.equal(note?.time_s, 3);
  assert.match(note.detail, /turns here$/);
});

test("a plot of a run begins at the start of the server's history", async () => {
  await page.locator(`[data-robot="${MOVER}"]`).click();
  await page.getByRole("button", { name: "Plots" }).first().click();
  await page.getByLabel("Add a curve").selectOption({ label: "x" });
  const csv = async () => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Save as CSV" }).click(),
    ]);
    return fs.readFileSync(await download.path(), "utf8").trim().split("\n").slice(1);
  };
  let rows = [];
  await until(async () => {
    rows = await csv();
    return rows.length > 20 && Number(rows[0].split(",")[0]) < 2;
  }, "values of the past");
  const times = rows.map((row) => Number(row.split(",")[0]));
  assert.deepEqual(times, [...times].sort((a, b) => a - b));
  assert.ok(times.at(-1) > 6, "the values of the run are missing");
});

test("after a reset the timeline begins anew", async () => {
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByRole("button", { name: "Reset", exact: true }).click();
  await until(async () => (await runTime()) === 0, "the reset");
  await page.getByRole("button", { name: "Start", exact: true }).click();
  await until(async () => (await timeOn()) > 3, "three simulated seconds");
  await until(async () => Number(await slider().getAttribute("max")) < 60 && Number(await slider().getAttribute("min")) < 1.5, "the new span");
  assert.equal(await page.getByRole("button", { name: /turns here/ }).count(), 0);
  assert.deepEqual(faults, []);
});
