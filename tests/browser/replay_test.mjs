// Tests a recording in a real browser: made by a real run, seeked by mouse and keys, and played to
// its end.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { changedPixels, isBlank, picture } from "./pixels.mjs";
import { posesAt, readPoses } from "./recorded_poses.mjs";
import { record, startReplay } from "./server.mjs";
import { ask, phaseIs, settled, until, viewClip } from "./viewing.mjs";

const DURATION_S = 6;
const RUN = [
  "office",
  ...["b21r@-5,-1.5,0", "pebble@-2,0"].flatMap((robot) => ["--robot", robot]),
  ...["--behaviour", "wander", "--lockstep", "--seed", "3", "--duration", String(DURATION_S)],
];
const MOVER = "pebble";
const SAME_INSTANT_S = 1e-6;
const SAME_PLACE_M = 1e-9;
const THUMB_PX = 16;

let folder;
let recorded;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-replay-"));
  const file = path.join(folder, "run.mcap");
  await record(file, RUN);
  recorded = await readPoses(file);
  server = await startReplay([file, "--paused"]);
  browser = await openBrowser({ width: 1024, height: 680 });
  ({ page, faults } = await openPage(browser, `${server.url}?quality=high`));
  await waitUntilDrawn(page);
  await slider().waitFor();
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const slider = () => page.getByRole("slider", { name: "Time in the recording" });
const replay = () => ask(page, "/replay");
const pageTime = () => page.evaluate(() => window.gsv.time);

// Waits until page and server are at the same instant, and returns it.
async function agreedTime() {
  let time;
  await until(async () => {
    ({ time_s: time } = await replay());
    return Math.abs((await pageTime()) - time) < SAME_INSTANT_S;
  }, "one time on the page and the server");
  return time;
}

async function standsAt(wanted, tolerance = SAME_INSTANT_S) {
  await until(async () => Math.abs((await replay()).time_s - wanted) <= tolerance, `the instant ${wanted}`);
  return agreedTime();
}

async function placeOnSlider(time) {
  const box = await slider().boundingBox();
  const share = time / DURATION_S;
  return { x: box.x + THUMB_PX / 2 + share * (box.width - THUMB_PX), y: box.y + box.height / 2 };
}

// The tolerance: one pixel of the slider, and the possible error of its thumb.
async function sliderTolerance() {
  return (4 * DURATION_S) / (await slider().boundingBox()).width;
}

async function clickAt(time) {
  const { x, y } = await placeOnSlider(time);
  await page.mouse.click(x, y);
  return standsAt(time, await sliderTolerance());
}

// Checks that page, server and recording agree on the robots' poses at this instant.
async function robotsAreRight(time) {
  const expected = posesAt(recorded, time);
  await page.waitForFunction(
    ([robot, wanted]) => Math.abs((window.gsv.robotPosition(robot)?.time ?? -1) - wanted) < 1e-6,
    [MOVER, expected.time],
  );
  const { bodies, poses } = await ask(page, "/scene");
  const { robots } = await ask(page, "");
  assert.equal(robots.length, 2);
  for (const { name, pose } of robots) {
    const entry = poses.findIndex(({ body, link }) => bodies[body].name === name && link === null);
    const [x, y] = expected.poses.subarray(7 * entry, 7 * entry + 2);
    const shown = await page.evaluate((robot) => window.gsv.robotPosition(robot), name);
    assert.ok(Math.hypot(shown.x - x, shown.y - y) < SAME_PLACE_M, `the page's ${name} at ${time} s`);
    assert.ok(Math.hypot(pose.x_m - x, pose.y_m - y) < SAME_PLACE_M, `the server's ${name} at ${time} s`);
  }
}

async function press(name) {
  await page.getByRole("button", { name, exact: true }).click();
}

test("a recording has a timeline, and no buttons of live simulations", async () => {
  assert.equal(isBlank(await picture(page, await viewClip(page))), false);
  assert.equal(await page.getByTestId("replay-end").textContent(), " / 0:06.00");
  assert.equal(await slider().getAttribute("aria-valuetext"), "0:00.00 of 0:06.00");
  assert.equal(await page.getByRole("group", { name: "Run" }).count(), 0);
  assert.equal(await page.getByTestId("connection").textContent(), "Replay");
});

// A canvas that gets another size is empty until the next frame, which may be half a second later.
test("the view keeps its image until it is drawn in another size", async () => {
  const drawn = page.evaluate(
    () =>
      new Promise((resolve) => {
        const canvas = document.querySelector(".view > canvas");
        const width = Object.getOwnPropertyDescriptor(HTMLCanvasElement.prototype, "width");
        const lookAfterwards = () => {
          delete canvas.width;
          const pixels = new Uint8Array(4 * canvas.width * canvas.height);
          const gl = canvas.getContext("webgl2");
          gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          resolve(pixels.some((value) => value !== 0 && value !== 255));
        };
        Object.defineProperty(canvas, "width", {
          configurable: true,
          get: () => width.get.call(canvas),
          set: (value) => {
            width.set.call(canvas, value);
            queueMicrotask(lookAfterwards);
          },
        });
      }),
  );
  const { width, height } = page.viewportSize();
  await page.setViewportSize({ width: width - 50, height });
  assert.equal(await drawn, true);
  await page.setViewportSize({ width, height });
});

test("events are marked at their times, and a click goes there", async () => {
  const events = await ask(page, "/events");
  assert.deepEqual(
    // The events also contain collisions, which depend on where the behaviour drives.
    events.filter(({ event }) => event !== "collision").map(({ event, time_s }) => [event, time_s]),
    [
      ["started", 0],
      ["finished", DURATION_S],
    ],
  );
  const mark = page.getByRole("button", { name: "0:06.00 finished" });
  await mark.hover();
  await mark.locator(".mark-text").waitFor();
  await mark.click();
  await robotsAreRight(await standsAt(DURATION_S));
});

test("a click on the slider seeks forwards and backwards", async () => {
  const seen = [];
  for (const time of [1.5, 4.5, 1.5]) {
    const stood = await clickAt(time);
    await robotsAreRight(stood);
    seen.push(await page.evaluate((robot) => window.gsv.robotPosition(robot), MOVER));
  }
  assert.ok(Math.hypot(seen[1].x - seen[0].x, seen[1].y - seen[0].y) > 0.2, "the robot did not move");
  assert.deepEqual(seen[2], seen[0]);
});

test("the image of an instant does not depend on the direction of the seek", async () => {
  const clip = await viewClip(page);
  const pictures = [];
  for (const time of [1, 5, 1]) {
    await ask(page, "/seek", { time_s: time });
    await robotsAreRight(await standsAt(time));
    await settled(page);
    pictures.push(await picture(page, clip));
  }
  assert.equal(isBlank(pictures[0]), false);
  const other = changedPixels(pictures[0], pictures[1]);
  const same = changedPixels(pictures[0], pictures[2]);
  assert.ok(other > 100, `only ${other} pixels changed over four seconds`);
  assert.ok(same < 0.1 * other, `${same} pixels differ between two pictures of one instant`);
});

test("the status and the camera image belong to the same instant", async () => {
  for (const time of [4.1, 2.1]) {
    await ask(page, "/seek", { time_s: time });
    await standsAt(time);
    const { distance_m } = (await ask(page, "")).robots.find(({ name }) => name === MOVER);
    const row = page.locator(`[data-robot="${MOVER}"]`);
    await row.getByText(`${distance_m.toFixed(2)} m`, { exact: true }).waitFor();
    // There is an image every second.
    await page
      .locator(".picture-time")
      .getByText(`0:0${Math.floor(time)}.00`, { exact: true })
      .waitFor();
  }
});

test("dragging seeks one instant at a time and ends at the release", async () => {
  await page.evaluate(() => {
    const { fetch } = window;
    const seeks = (window.testSeeks = { underWay: 0, most: 0 });
    window.fetch = async (input, init) => {
      if (!String(input).endsWith("/seek")) return fetch(input, init);
      seeks.most = Math.max(seeks.most, ++seeks.underWay);
      return fetch(input, init).finally(() => (seeks.underWay -= 1));
    };
  });
  const from = await placeOnSlider(1);
  const to = await placeOnSlider(5);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 12 });
  await page.mouse.up();
  await robotsAreRight(await standsAt(5, await sliderTolerance()));
  assert.equal(await page.evaluate(() => window.testSeeks.most), 1);
});

test("keys step by recorded poses, by ten with Shift, and go to the ends", async () => {
  const times = recorded.map(({ time }) => time);
  await slider().focus();
  await page.keyboard.press("Home");
  await standsAt(0);
  await page.keyboard.press("Shift+ArrowRight");
  await robotsAreRight(await standsAt(times[10]));
  for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowRight");
  await robotsAreRight(await standsAt(times[13]));
  await page.keyboard.press("ArrowLeft");
  await standsAt(times[12]);
  await page.keyboard.press("Shift+ArrowLeft");
  await robotsAreRight(await standsAt(times[2]));
  await page.keyboard.press("End");
  await robotsAreRight(await standsAt(DURATION_S));
  assert.equal(await slider().getAttribute("aria-valuetext"), "0:06.00 of 0:06.00");
});

test("it plays at another speed to the end, and then from the start", async () => {
  await ask(page, "/seek", { time_s: 0 });
  await standsAt(0);
  await page.getByRole("combobox", { name: "Speed" }).selectOption("5");
  await until(async () => (await replay()).speed === 5, "the speed");
  await press("Play");
  await phaseIs(page, "finished");
  await robotsAreRight(await standsAt(DURATION_S));
  assert.equal((await ask(page, "")).target_factor, 5);
  await page.getByRole("combobox", { name: "Speed" }).selectOption("0.1");
  await until(async () => (await replay()).speed === 0.1, "the speed");
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press("Space");
  await phaseIs(page, "running");
  assert.ok((await replay()).time_s < DURATION_S);
  await page.keyboard.press("Space");
  await phaseIs(page, "paused");
  await robotsAreRight(await agreedTime());
});

test("with loop it starts again at the end", async () => {
  await press("Loop");
  await until(async () => (await replay()).loop, "the loop");
  await page.getByRole("combobox", { name: "Speed" }).selectOption("10");
  await until(async () => (await replay()).speed === 10, "the speed");
  await ask(page, "/seek", { time_s: DURATION_S - 1 });
  await standsAt(DURATION_S - 1);
  await press("Play");
  await page.waitForFunction((end) => window.gsv.time < end - 1, DURATION_S);
  await press("Pause");
  await phaseIs(page, "paused");
  await press("Loop");
  await until(async () => !(await replay()).loop, "the loop's end");
});

test("the layout Replay a failure shows the log, plots and the timeline of a recording", async () => {
  await press("Layout");
  await page.getByRole("group", { name: "Layout" }).getByRole("button", { name: "Replay a failure", exact: true }).click();
  const panel = (name) => page.getByRole("region", { name, exact: true });
  await panel("Log").locator(".log-line").first().waitFor();
  await page.locator(`[data-robot="${MOVER}"]`).click();
  await panel("Inspector").getByRole("button", { name: "Plot speed" }).click();
  await panel("Plots").getByRole("list", { name: "Curves" }).getByText(`${MOVER} speed`).waitFor();
  // The curve is that of the whole recording, although the page shows one instant.
  const curve = panel("Plots").getByRole("img", { name: "Plot", exact: true }).locator("canvas").first();
  const widthOfCurve = () =>
    curve.evaluate((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const columns = new Set();
      for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200 && data[i + 2] > 180 && data[i] < 120) columns.add((i / 4) % canvas.width);
      return columns.size / canvas.width;
    });
  await until(async () => (await widthOfCurve()) > 0.3, "the curve of the speed");
  const boxes = await Promise.all([page.locator(".view"), page.locator(".timeline"), ...["Log", "Plots", "Inspector", "Images"].map(panel)].map((each) => each.boundingBox()));
  for (const [i, a] of boxes.entries()) {
    assert.ok(a.width > 80 && a.height > 25 && a.x + a.width <= 1025 && a.y + a.height <= 681, JSON.stringify(a));
    for (const b of boxes.slice(i + 1)) {
      const isApart = a.x + a.width <= b.x + 1 || b.x + b.width <= a.x + 1 || a.y + a.height <= b.y + 1 || b.y + b.height <= a.y + 1;
      assert.ok(isApart, JSON.stringify({ a, b }));
    }
  }
});

test("it works on a phone's screen with dark colours, and both pages show the same instant", async () => {
  const phone = await openBrowser({ width: 390, height: 760, colorScheme: "dark" });
  try {
    const small = await openPage(phone, server.url);
    await waitUntilDrawn(small.page);
    const button = small.page.getByRole("button", { name: "Go to the end", exact: true });
    await button.click();
    await small.page.waitForFunction((end) => window.gsv.time === end, DURATION_S);
    await robotsAreRight(await standsAt(DURATION_S));
    const overflow = await small.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.equal(overflow, 0);
    const outside = await small.page.evaluate(() =>
      [...document.querySelectorAll(".timeline button:not(.mark), .timeline select, .timeline input")]
        .filter((each) => {
          const { left, right, bottom } = each.getBoundingClientRect();
          return left < 0 || right > innerWidth || bottom > innerHeight;
        })
        .map((each) => each.getAttribute("aria-label")),
    );
    assert.deepEqual(outside, []);
    assert.deepEqual(small.faults, []);
  } finally {
    await phone.close();
  }
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
