// Tests the comparison of two recordings: ghosts, dashed curves, the first difference; and notes
// beside a recording.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { changedPixels, picture } from "./pixels.mjs";
import { posesAt, readPoses } from "./recorded_poses.mjs";
import { record, startServe } from "./server.mjs";
import { settled, until, viewClip } from "./viewing.mjs";

const MOVER = "pebble";
const DURATION_S = 6;

function run(yaw) {
  const robot = ["--robot", `pebble@-2,0,${yaw}`, "--behaviour", "wander"];
  return ["office", ...robot, "--lockstep", "--seed", "3", "--duration", String(DURATION_S)];
}

let folder;
let server;
let browser;
let page;
let faults;
let yesterday;
let sceneUrl; // address of the scene that the page requested last

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-compare-"));
  await record(path.join(folder, "yesterday.mcap"), run(0));
  await record(path.join(folder, "today.mcap"), run(0.5));
  yesterday = await readPoses(path.join(folder, "yesterday.mcap"));
  server = await startServe(["--recordings", folder]);
  browser = await openBrowser({ width: 1180, height: 720 });
  ({ page, faults } = await openPage(browser, `${server.url}?recording=today.mcap`));
  page.on("request", (request) => {
    if (request.url().endsWith("/scene")) sceneUrl = request.url();
  });
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const timeOn = () => page.evaluate(() => window.gsv.time);
const ghost = () => page.evaluate((robot) => window.gsv.ghostPosition(robot), MOVER);

async function standAt(time) {
  await page.getByLabel("Go to time").fill(String(time));
  await page.keyboard.press("Enter");
  await until(async () => (await timeOn()) === time, `the instant ${time}`);
}

// Zooms in, so that the robot and its ghost are more than a few pixels wide.
async function approach() {
  await settled(page);
  const { x, y } = await page.evaluate((robot) => window.gsv.robotScreenPosition(robot), MOVER);
  await page.mouse.move(x, y);
  for (let turns = 0; turns < 14; turns += 1) await page.mouse.wheel(0, -240);
  await settled(page);
}

// Returns the scene that the page requested last.
function shownScene() {
  return page.evaluate(async (url) => (await fetch(url)).json(), sceneUrl);
}

// Returns the position of the robot in the second recording, at the instant that the page shows.
async function ghostIsRight() {
  const { bodies, poses: list } = await shownScene();
  const entry = list.findIndex(({ body, link }) => bodies[body].name === MOVER && link === null);
  await until(async () => {
    const [place, time] = [await ghost(), await timeOn()];
    const { poses } = posesAt(yesterday, time);
    const [x, y] = poses.subarray(7 * entry, 7 * entry + 2);
    return place !== null && Math.hypot(place.x - x, place.y - y) < 1e-9;
  }, "the ghost at its place");
}

test("a note is saved beside the recording, and is there after a reload", async () => {
  await standAt(2);
  await page.getByRole("button", { name: "Notes" }).click();
  await page.getByLabel("Note", { exact: true }).fill("turns too late");
  await page.getByRole("button", { name: "Add at 0:02.00" }).click();
  await page.locator(".note-list").getByText("turns too late").waitFor();
  const saved = JSON.parse(fs.readFileSync(path.join(folder, "today.mcap.notes.json"), "utf8"));
  assert.equal(saved.version, 1);
  assert.equal(saved.notes[0].time_s, 2);
  assert.match(saved.notes[0].text, /turns too late$/);
  await page.reload();
  await waitUntilDrawn(page);
  const mark = page.getByRole("button", { name: /^0:02.00 note · .*turns too late/ });
  await mark.waitFor();
  await standAt(4);
  await page.getByRole("button", { name: "Notes" }).click();
  await page.locator(".note-list").getByRole("button", { name: "0:02.00", exact: true }).click();
  await until(async () => (await timeOn()) === 2, "the instant of the note");
  await page.getByRole("button", { name: "Notes" }).click();
  await page.getByRole("button", { name: "Remove the note at 0:02.00" }).click();
  await mark.waitFor({ state: "detached" });
  assert.deepEqual(JSON.parse(fs.readFileSync(path.join(folder, "today.mcap.notes.json"), "utf8")).notes, []);
  await page.keyboard.press("Escape");
});

test("the robots of another recording are ghosts at the same simulated time", async () => {
  await standAt(4);
  await approach();
  const clip = await viewClip(page);
  const alone = await picture(page, clip);
  await page.getByRole("button", { name: "Compare with…" }).click();
  await page.locator(".compare-list").getByText("yesterday.mcap").click();
  await ghostIsRight();
  await settled(page);
  const purple = (r, g, b) => b > 1.15 * g && r > 1.02 * g;
  const changed = () => picture(page, clip).then((both) => changedPixels(alone, both, purple));
  await until(async () => (await changed()) > 40, "the ghost's shape");
  await standAt(5.5);
  await ghostIsRight();
});

test("the first difference is a mark that names the topic that differs", async () => {
  const mark = page.getByRole("button", { name: /first difference/ });
  await mark.waitFor();
  await mark.click();
  await page.getByRole("button", { name: "Compare with…" }).click();
  await page.locator(".compare-verdict").getByText("First difference from yesterday.mcap at").waitFor();
  assert.match(await page.locator(".compare-verdict").textContent(), /yaw[^]*pebble/);
  await page.keyboard.press("Escape");
});

test("the curves of the second recording are dashed beside those of the first", async () => {
  await standAt(4);
  await page.locator(`[data-robot="${MOVER}"]`).click();
  await page.getByRole("button", { name: "Plots" }).first().click();
  const plot = page.getByRole("img", { name: "Plot" });
  await page.getByLabel("Add a curve").selectOption({ label: "x" });
  await page.getByText("at 0:04.00", { exact: true }).waitFor();
  // Both curves have the same colour, so one curve alone has fewer pixels of this colour.
  const coloured = () =>
    plot.evaluate((plotted) => {
      const canvas = plotted.matches("canvas") ? plotted : plotted.querySelector("canvas");
      if (!canvas) return 0; // the page makes the canvas when the first values arrive
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        const [r, g, b, a] = data.subarray(i, i + 4);
        if (a > 100 && Math.max(r, g, b) - Math.min(r, g, b) > 60) count += 1;
      }
      return count;
    });
  let both = 0;
  let before = -1;
  await until(async () => {
    [before, both] = [both, await coloured()];
    return both > 100 && both === before;
  }, "the curves");
  await keepPicture(page, "compare");
  await page.getByRole("button", { name: "Compare with…" }).click();
  await page.getByRole("button", { name: "Stop comparing" }).click();
  await page.keyboard.press("Escape");
  assert.equal(await ghost(), null);
  await until(async () => (await coloured()) < 0.85 * both, "the second curve to go");
});

test("both recordings play together", async () => {
  await page.getByRole("button", { name: "Compare with…" }).click();
  await page.locator(".compare-list").getByText("yesterday.mcap").click();
  await standAt(1);
  await ghostIsRight();
  const from = await ghost();
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await until(async () => (await timeOn()) > 3, "playing");
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await ghostIsRight();
  const to = await ghost();
  assert.ok(Math.hypot(to.x - from.x, to.y - from.y) > 0.1, "the ghost stood still");
  assert.deepEqual(faults, []);
});

test("the ghosts are shown on images that the server draws", async () => {
  const drawn = await openPage(browser, `${server.url}?recording=today.mcap&view=server`);
  page = drawn.page;
  page.on("request", (request) => {
    if (request.url().endsWith("/scene")) sceneUrl = request.url();
  });
  await page.locator(".drawn-view").waitFor();
  await waitUntilDrawn(page);
  await standAt(4);
  await approach();
  const purple = () =>
    page.locator(".drawn-view").evaluate((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        const [r, g, b] = data.subarray(i, i + 3);
        if (b > 1.3 * g && b > r && r > 1.02 * g) count += 1;
      }
      return count;
    });
  const alone = await purple();
  await page.getByRole("button", { name: "Compare with…" }).click();
  await page.locator(".compare-list").getByText("yesterday.mcap").click();
  await ghostIsRight();
  await until(async () => (await purple()) > alone + 40, "the ghost's shape");
  await keepPicture(page, "compare_drawn");
  await page.getByRole("button", { name: "Compare with…" }).click();
  await page.getByRole("button", { name: "Stop comparing" }).click();
  await until(async () => (await purple()) <= alone, "the ghost to go");
  assert.deepEqual(drawn.faults, []);
});
