// Tests the viewer in a real browser with a real simulation: what a user sees and clicks.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { SHARP, keepPicture } from "./documentation.mjs";
import { around, changedPixels, cut, isBlank, isBlue, isRed, isYellow, picture, showsLabel } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import * as viewing from "./viewing.mjs";
import { until } from "./viewing.mjs";

const MIDDLE_PX = 4; // lies within the smallest robot, seen from above
const ROBOT_PX = 28; // maximum width of a robot in the view
const SIMULATION = [
  "office",
  ...["b21r@-5,-1.5,0", "b21r@5,1.6,180deg", "rover4@0,0", "pebble@-2,0", "pebble@2,0,180deg"].flatMap(
    (robot) => ["--robot", robot],
  ),
  ...["--behaviour", "wander"],
  ...["--avatar", "avatar@-6.5,0"],
];
const STEPS_TO_MOVE = 300; // three simulated seconds: enough for a robot to leave its place

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(SIMULATION);
  browser = await openBrowser({ width: 1024, height: 680 });
  ({ page, faults } = await openPage(browser, server.url + SHARP));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const phaseIs = (phase, of = page) => viewing.phaseIs(of, phase);

async function press(name, of = page) {
  await of.getByRole("button", { name, exact: true }).click();
}

async function show(part, shown) {
  await press("Overlays");
  const button = page.getByRole("button", { name: part, exact: true });
  if ((await button.getAttribute("aria-pressed")) !== String(shown)) await button.click();
  await page.keyboard.press("Escape");
  await button.waitFor({ state: "hidden" });
}

// Requests the page's server directly, without the page's code.
const ask = (path, body) => viewing.ask(page, path, body);
const settled = (of = page) => viewing.settled(of);
const viewClip = (of = page) => viewing.viewClip(of);

async function pause() {
  const phase = await page.evaluate(() => window.gsv.phase);
  if (phase === "running") await press("Pause");
  await phaseIs("paused");
  await settled();
}

async function resume() {
  await press("Resume");
  await phaseIs("running");
}

function isWithin(clip, { x, y }, margin) {
  const isInX = x > clip.x + margin && x < clip.x + clip.width - margin;
  return isInX && y > clip.y + margin && y < clip.y + clip.height - margin;
}

async function robotsInView() {
  return page.evaluate(() => {
    const places = window.gsv.robots.map((name) => ({ name, at: window.gsv.robotScreenPosition(name) }));
    return places.filter(({ at }) => at !== null);
  });
}

test("the view of the world is not blank", async () => {
  await phaseIs("running");
  assert.equal(isBlank(await picture(page, await viewClip())), false);
});

test("names are drawn over the view, and a click on a name selects its robot", async () => {
  await pause();
  const label = await page.evaluate(() => {
    const isInSight = ({ x, y, width, height }) => document.elementFromPoint(x + width / 2, y + height / 2)?.tagName === "CANVAS";
    return window.gsv.labels.find(isInSight);
  });
  assert.ok(showsLabel(await picture(page, label)), "the name is not readable");
  await page.mouse.move(label.x + label.width / 2, label.y + label.height / 2);
  const cursor = () => page.evaluate(() => getComputedStyle(document.querySelector(".view > canvas")).cursor);
  await until(async () => (await cursor()) === "pointer", "the pointer of a link");
  await page.mouse.click(label.x + label.width / 2, label.y + label.height / 2);
  await page.getByRole("heading", { name: label.name, exact: true }).first().waitFor();
  await until(async () => {
    const [first] = await page.evaluate(() => window.gsv.labels);
    return first.name === label.name && first.kind.startsWith("label selected");
  }, "the selected name");
  await settled();
  const [selected] = await page.evaluate(() => window.gsv.labels);
  const seen = await picture(page, selected);
  await page.getByText(`Names in the view: ${label.name}`).waitFor({ state: "attached" }); // for screen readers
  await page.keyboard.press("Escape");
  await settled();
  const blue = changedPixels(await picture(page, selected), seen, isBlue);
  assert.ok(blue > 0.5 * selected.width * selected.height, `only ${blue} pixels are blue`);
  await resume();
});

test("a lost canvas is reported, and the image returns", async () => {
  await show("Names", false);
  const clip = await viewClip();
  await page.evaluate(() => {
    const gl = document.querySelector(".view > canvas").getContext("webgl2");
    window.testContext = gl.getExtension("WEBGL_lose_context");
    window.testContext.loseContext();
  });
  await page.getByText("The 3D view has stopped").waitFor();
  await page.evaluate(() => window.testContext.restoreContext());
  await page.getByText("The 3D view has stopped").waitFor({ state: "detached" });
  await until(async () => !isBlank(await picture(page, clip)), "the picture after the loss");
  await show("Names", true);
});

test("a running simulation has buttons, and a timeline of the history that the server keeps", async () => {
  await page.getByRole("button", { name: "Step", exact: true }).waitFor();
  await page.getByRole("slider", { name: "Time in the run" }).waitFor();
  assert.equal(await page.getByRole("group", { name: "Playback" }).count(), 0);
});

test("every control has a name", async () => {
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, select, input")]
      .filter((each) => {
        const label = each.labels?.[0]?.textContent;
        return !(each.getAttribute("aria-label") ?? label ?? each.textContent).trim();
      })
      .map((each) => each.outerHTML),
  );
  assert.deepEqual(nameless, []);
});

test("pause freezes the simulated time, resume lets it go on", async () => {
  await pause();
  const frozen = (await ask("")).time_s;
  for (let i = 0; i < 20; i++) assert.equal((await ask("")).time_s, frozen);
  assert.ok(Math.abs((await page.evaluate(() => window.gsv.time)) - frozen) < 1e-6);
  await resume();
  await page.waitForFunction((then) => window.gsv.time > then + 0.2, frozen);
});

test("a menu sets the number of steps and the real-time factor", async () => {
  await pause();
  const before = await ask("");
  await press("Speed and steps");
  const sheet = page.getByRole("group", { name: "Speed and steps" });
  await sheet.getByLabel("Number of steps to take").fill("25");
  await press("Take steps");
  await until(async () => (await ask("")).step === before.step + 25, "the steps");
  await phaseIs("paused");
  await page.getByRole("button", { name: "2×", exact: true }).click();
  await page.getByTestId("factor").getByText("/ 2.00×").waitFor();
  assert.equal((await ask("")).target_factor, 2);
  await sheet.getByLabel("Simulated seconds per second of wall-clock time").fill("0.5");
  await page.keyboard.press("Enter");
  await page.getByTestId("factor").getByText("/ 0.50×").waitFor();
  await page.getByRole("button", { name: "1×", exact: true }).click();
  await page.getByTestId("factor").getByText("/ 1.00×").waitFor();
  await page.keyboard.press("Escape");
  await sheet.waitFor({ state: "hidden" });
  await resume();
});

// The view is from above, where no wall hides a robot. A desk may hide one, so only half of several
// must be visible. After a robot has left, its former place must show something else.
test("robots are drawn at their projected places, and leave them when they move", async () => {
  await pause();
  for (const part of ["Beams", "Names", "Grid"]) await show(part, false);
  await page.keyboard.press("t");
  await settled();
  const clip = await viewClip();
  const robots = (await robotsInView()).filter(({ at }) => isWithin(clip, at, MIDDLE_PX));
  assert.ok(robots.length > 0, "no robot is in the picture");
  const here = await picture(page, clip);
  // Returns the robots whose former places no robot covers any more.
  const deserted = async () => {
    const now = (await robotsInView()).map(({ at }) => at);
    return robots.map(({ at }) =>
      now.every((other) => Math.hypot(other.x - at.x, other.y - at.y) > ROBOT_PX),
    );
  };
  // A wandering robot may rotate for some seconds.
  let left = await deserted();
  const enough = Math.min(robots.length, 3);
  for (let tries = 0; tries < 20 && left.filter(Boolean).length < enough; tries++) {
    const { step } = await ask("");
    await ask("/step", { count: STEPS_TO_MOVE });
    await until(async () => (await ask("")).step >= step + STEPS_TO_MOVE, "the steps");
    await phaseIs("paused");
    await settled();
    left = await deserted();
  }
  const without = await picture(page, clip);
  const middle = ({ x, y }) => around({ x: x - clip.x, y: y - clip.y }, MIDDLE_PX);
  const judged = robots
    .filter((robot, i) => left[i])
    .map(({ name, at }) => {
      const changed = changedPixels(cut(here, middle(at)), cut(without, middle(at)));
      return { name, wasThere: changed > 0.5 * MIDDLE_PX ** 2 };
    });
  const seen = judged.filter(({ wasThere }) => wasThere);
  assert.ok(judged.length > 0, "no robot moved away from its place");
  assert.ok(seen.length > 0, "no robot was seen at its place");
  assert.ok(
    seen.length >= judged.length / 2,
    `seen at their places: ${seen.length} of ${JSON.stringify(judged)}`,
  );
  await page.keyboard.press("r");
  await settled();
});

test("beams are drawn in red or yellow, and only while they are shown", async () => {
  const clip = await viewClip();
  await show("Beams", false);
  await settled();
  const without = await picture(page, clip);
  await show("Beams", true);
  await settled();
  const drawn = await picture(page, clip);
  const changed = changedPixels(without, drawn);
  const coloured = changedPixels(without, drawn, (r, g, b) => isRed(r, g, b) || isYellow(r, g, b));
  assert.ok(coloured > 40, `only ${coloured} pixels of beams`);
  assert.ok(coloured > 0.6 * changed, `${changed} pixels changed, ${coloured} of them red or yellow`);
});

test("a click on a robot selects it and shows where it is", async () => {
  const clip = await viewClip();
  const robot = (await robotsInView()).find(({ at }) => at.x < clip.x + clip.width - 10);
  await page.mouse.click(robot.at.x, robot.at.y);
  const inspector = page.getByRole("region", { name: "Selected robot" });
  const title = await inspector.getByRole("heading").textContent();
  // Another robot may be in front of it.
  assert.ok((await robotsInView()).some(({ name }) => name === title));
  const { pose } = (await ask("")).robots.find(({ name }) => name === title);
  const shown = await inspector.locator(".inspector-rows dd").first().textContent();
  const [x, y] = shown.split(",").map(Number.parseFloat);
  assert.ok(Math.hypot(x - pose.x_m, y - pose.y_m) < 0.02, `${shown} is not ${JSON.stringify(pose)}`);
  await keepPicture(page, "run");
  await page.keyboard.press("Escape");
  await inspector.waitFor({ state: "hidden" });
});

test("keys work: views, help, space", async () => {
  await page.keyboard.press("r");
  await settled();
  const robot = (await robotsInView())[0].name;
  const place = () => page.evaluate((name) => window.gsv.robotScreenPosition(name), robot);
  const first = await place();
  await page.keyboard.press("t");
  await settled();
  const fromAbove = await place();
  assert.notDeepEqual(fromAbove, first);
  await page.keyboard.press("r");
  await settled();
  const again = await place();
  assert.ok(Math.hypot(again.x - first.x, again.y - first.y) < 2, "R does not bring the first view back");
  await page.keyboard.press("?");
  await page.getByRole("dialog", { name: "Help" }).waitFor();
  await page.keyboard.press("Escape");
  await page.getByRole("dialog", { name: "Help" }).waitFor({ state: "hidden" });
  // A button that has the focus receives Space itself.
  await page.evaluate(() => document.activeElement?.blur());
  await page.keyboard.press("Space");
  await phaseIs("running");
});

test("the camera's images arrive and are not blank", async () => {
  const canvas = page.locator("canvas.picture");
  await page.waitForFunction(() => document.querySelector("canvas.picture").width > 1);
  const colours = await canvas.evaluate((each) => {
    const { data } = each.getContext("2d").getImageData(0, 0, each.width, each.height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4)
      seen.add(((data[i] >> 4) << 8) | ((data[i + 1] >> 4) << 4) | (data[i + 2] >> 4));
    return seen.size;
  });
  assert.ok(colours >= 8, `the camera's picture has ${colours} colours`);
  const time = page.locator(".picture-time");
  const then = await time.textContent();
  await page.waitForFunction((text) => document.querySelector(".picture-time").textContent !== text, then);
});

test("keys drive the avatar, and releasing them stops it", async () => {
  const { bodies } = await ask("/scene");
  const { name } = bodies.find(({ is_avatar }) => is_avatar);
  const avatar = async () => (await ask("")).robots.find((robot) => robot.name === name);
  const start = (await avatar()).distance_m;
  await page.keyboard.down("w");
  await until(async () => (await avatar()).distance_m > start + 0.2, "the avatar's motion");
  await page.keyboard.up("w");
  await until(async () => {
    const { distance_m: before } = await avatar();
    const time = await page.evaluate(() => window.gsv.time);
    await page.waitForFunction((then) => window.gsv.time > then + 0.3, time);
    return (await avatar()).distance_m === before;
  }, "the avatar's standing still");
  await page.locator(`[data-robot="${name}"]`).click();
  const outside = await picture(page, await viewClip());
  await page.keyboard.press("v");
  await until(async () => {
    const inside = await picture(page, await viewClip());
    return changedPixels(outside, inside) > 0.3 * inside.width * inside.height;
  }, "the view from the avatar's eyes");
  await keepPicture(page, "walk");
  await page.keyboard.press("o");
  await page.keyboard.press("Escape");
  await page.keyboard.press("r");
});

test("two browsers show the same phase after clicks in either", async () => {
  const other = await openBrowser({ width: 900, height: 600, colorScheme: "dark" });
  try {
    const second = await openPage(other, server.url);
    await waitUntilDrawn(second.page);
    await phaseIs("running", second.page);
    await press("Pause");
    await phaseIs("paused", second.page);
    await second.page.getByRole("button", { name: "Resume", exact: true }).waitFor();
    await press("Resume", second.page);
    await phaseIs("running");
    await page.getByRole("button", { name: "Pause", exact: true }).waitFor();
    assert.deepEqual(second.faults, []);
  } finally {
    await other.close();
  }
});

test("the simulation's name can be read in a window of any width", async () => {
  const { width, height } = page.viewportSize();
  try {
    for (const narrow of [1280, 1240, 1200, 1121, 1120, 1024, 960, 800, 360]) {
      await page.setViewportSize({ width: narrow, height });
      const [shown, whole] = await page
        .locator(".simulation-choice h1")
        .evaluate(({ clientWidth, scrollWidth }) => [clientWidth, scrollWidth]);
      assert.ok(shown >= whole && whole > 0, `${shown} of ${whole} pixels in a window of ${narrow}`);
    }
  } finally {
    await page.setViewportSize({ width, height });
  }
});

test("it works on a phone's screen", async () => {
  const phone = await openBrowser({ width: 390, height: 760 });
  try {
    const small = await openPage(phone, server.url);
    await waitUntilDrawn(small.page);
    const overflow = await small.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.equal(overflow, 0);
    await press("Robots", small.page);
    assert.deepEqual(
      await small.page.locator(".sidebar-pages a:visible").evaluateAll((links) => links.map((link) => link.getAttribute("href"))),
      ["join.html", "recordings.html", "broker.html"],
    );
    await small.page.locator("[data-robot]").first().click();
    await small.page.getByRole("region", { name: "Selected robot" }).waitFor();
    await press("Pause", small.page);
    await phaseIs("paused", small.page);
    await press("Resume", small.page);
    await phaseIs("running");
    assert.deepEqual(small.faults, []);
  } finally {
    await phone.close();
  }
});

test("stop ends the simulation, and the buttons show this", async () => {
  await press("Stop");
  await phaseIs("stopped");
  assert.equal(await page.getByRole("button", { name: "Stop", exact: true }).isDisabled(), true);
  assert.equal(await page.getByRole("button", { name: "Reset", exact: true }).isDisabled(), false);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});

test("after a restart of the server the open page reconnects by itself", async () => {
  await phaseIs("stopped");
  await server.restart();
  await phaseIs("running");
  const then = await page.evaluate(() => window.gsv.time);
  await page.waitForFunction((time) => window.gsv.time !== time, then);
  const frames = await page.evaluate(() => window.gsv.frames);
  await page.waitForFunction((then) => window.gsv.frames > then + 2, frames);
  assert.equal(isBlank(await picture(page, await viewClip())), false);
});
