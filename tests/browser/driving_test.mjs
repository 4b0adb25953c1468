// Tests manual control: keys, the pad and a gamepad drive a robot through a door, and a slider
// moves a joint of an arm. Two viewers cannot drive the same robot at once.
import assert from "node:assert/strict";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, until } from "./viewing.mjs";

const MODELS = path.join(path.dirname(fileURLToPath(import.meta.url)), "models");
const WORLD = path.join(MODELS, "workcell.sdf");
const DESK_ARM = path.join(MODELS, "desk_arm.sdf");
const DOOR_X = 2; // m

let server;
let browser;
let page;
let faults;

before(async () => {
  const robots = ["--robot", "pebble@0,0", "--robot", "porter@-1.5,-1.5", "--behaviour", "porter=wander", "--robot", `${DESK_ARM}@-3,3`];
  server = await startServer([WORLD, ...robots]);
  browser = await openBrowser({ width: 1366, height: 768 });
  await browser.context.addInitScript(() => {
    window.pads = [];
    window.padReads = 0;
    navigator.getGamepads = () => {
      window.padReads += 1;
      return window.pads;
    };
  });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const press = (name, of = page) => of.getByRole("button", { name, exact: true }).click();
const panel = (name, of = page) => of.getByRole("region", { name, exact: true });
const pad = (of = page) => of.getByRole("application", { name: "Driving pad" });
const placeOf = (robot, of = page) => of.evaluate((name) => window.gsv.robotPosition(name), robot);
const movesOn = async (robot, least) => {
  const then = await placeOf(robot);
  await until(async () => Math.hypot((await placeOf(robot)).x - then.x, (await placeOf(robot)).y - then.y) > least, `${robot} to move`);
};

async function standsStill(robot) {
  await until(async () => {
    const then = await placeOf(robot);
    await page.waitForFunction((time) => window.gsv.time > time + 0.5, then.time);
    const now = await placeOf(robot);
    return Math.hypot(now.x - then.x, now.y - then.y) < 0.005;
  }, `${robot} to stand`);
}

test("keys drive a robot without a behaviour through the door, and releasing them stops it", async () => {
  await press("Teleoperation");
  const choice = panel("Teleoperation").getByRole("combobox", { name: "Robot to drive" });
  // The other robot has a behaviour, and desk_arm has no drive.
  await until(async () => JSON.stringify(await choice.locator("option").allTextContents()) === '["pebble"]', "the list with pebble only");
  await pad().focus();
  await page.keyboard.down("w");
  await until(async () => (await placeOf("pebble")).x > DOOR_X + 0.5, "the robot behind the door");
  await panel("Teleoperation").getByText(/pebble: 0.50 m\/s/).waitFor();
  await page.keyboard.up("w");
  await panel("Teleoperation").getByText("Stopped").waitFor();
  await standsStill("pebble");
  const { robots } = await ask(page, "");
  assert.equal(robots.find(({ name }) => name === "pebble").collisions, 0);
});

test("keys belong to the pad while it has the focus, and losing the focus stops the robot", async () => {
  await pad().focus();
  await page.keyboard.down("s");
  await movesOn("pebble", 0.1);
  await page.evaluate(() => document.activeElement.blur());
  await standsStill("pebble");
  await page.keyboard.up("s");
  const then = await placeOf("pebble");
  await page.keyboard.press("w");
  await standsStill("pebble");
  const now = await placeOf("pebble");
  assert.ok(Math.hypot(now.x - then.x, now.y - then.y) < 0.02, "a key beside the pad drives nothing");
});

test("the pad is dragged by mouse", async () => {
  const box = await pad().boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height * 0.9, { steps: 3 });
  await movesOn("pebble", 0.1);
  await page.mouse.up();
  await standsStill("pebble");
});

test("the pad is dragged by a finger, and lifting it stops the robot", async () => {
  const touches = await page.context().newCDPSession(page);
  const touch = (type, ...points) => touches.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await touches.send("Emulation.setTouchEmulationEnabled", { enabled: true });
  const { x, y, width, height } = await pad().boundingBox();
  const [middle, then] = [{ x: x + width / 2, y: y + height / 2 }, await placeOf("pebble")];
  await touch("touchStart", middle);
  // The finger leaves the pad and must still drive: the page must not scroll, and must not use the
  // gesture for anything else.
  for (const share of [0.3, 0.1, -0.2]) await touch("touchMove", { ...middle, y: y + share * height });
  await panel("Teleoperation").getByText("pebble: 0.50 m/s, 0.00 rad/s").waitFor();
  await movesOn("pebble", 0.1);
  assert.ok((await placeOf("pebble")).x > then.x, "a finger at the top drives ahead");
  await touch("touchEnd");
  await panel("Teleoperation").getByText("Stopped", { exact: true }).waitFor();
  await standsStill("pebble");
  await touches.send("Emulation.setTouchEmulationEnabled", { enabled: false });
  await touches.detach();
});

// Ways to take the focus from the window of the page, and to give it back. The events are those of
// Chromium: Playwright's emulation, in which each page has the focus, is off meanwhile.
const WAYS_TO_LEAVE = {
  "another tab is brought to the front": async () => {
    const other = await page.context().newPage();
    await other.bringToFront();
    return async () => {
      await other.close();
      await page.bringToFront();
    };
  },
  "the window is minimised": async (devtools) => {
    const { windowId } = await devtools.send("Browser.getWindowForTarget");
    const set = (windowState) => devtools.send("Browser.setWindowBounds", { windowId, bounds: { windowState } });
    await set("minimized");
    return () => set("normal");
  },
};

// Leaves the page in this way, calls `look`, and returns to the page.
async function whileLeft(leave, look) {
  const devtools = await page.context().newCDPSession(page);
  const hasFocus = (isWanted) => page.waitForFunction((wanted) => document.hasFocus() === wanted, isWanted, { polling: 50 });
  await devtools.send("Emulation.setFocusEmulationEnabled", { enabled: false });
  await page.bringToFront();
  await hasFocus(true);
  const comeBack = await leave(devtools);
  try {
    await hasFocus(false);
    await look();
  } finally {
    await comeBack();
    await hasFocus(true);
    await devtools.send("Emulation.setFocusEmulationEnabled", { enabled: true });
    await devtools.detach();
  }
}

// The command of a robot, as the server reports it.
async function commandOf(robot) {
  const [{ name }] = await (await fetch(new URL("api/simulations", server.url))).json();
  const { robots } = await (await fetch(new URL(`api/simulations/${encodeURIComponent(name)}/health`, server.url))).json();
  return robots.find((each) => each.name === robot).command;
}
const drives = (robot) => until(async () => (await commandOf(robot)).linear_m_s !== 0, `a command to ${robot}`);
// The page repeats its command several times a second, so a command of 0 that stays is the page's.
async function isStopped(robot) {
  await until(async () => (await commandOf(robot)).linear_m_s === 0, `a command of 0 to ${robot}`);
  const then = await placeOf(robot);
  while ((await placeOf(robot)).time < then.time + 0.5) assert.equal((await commandOf(robot)).linear_m_s, 0);
}

for (const [way, leave] of Object.entries(WAYS_TO_LEAVE)) {
  test(`the robot stops if ${way} while a key is held`, async () => {
    await pad().focus();
    await page.keyboard.down("s");
    await drives("pebble");
    await whileLeft(leave, () => isStopped("pebble"));
    // The key is still held. It must be released and pressed again.
    await page.keyboard.down("s");
    await isStopped("pebble");
    await page.keyboard.up("s");
    await page.keyboard.down("s");
    await drives("pebble");
    await page.keyboard.up("s");
    await isStopped("pebble");
  });

  test(`the robot stops if ${way} while the stick of a gamepad is pushed`, async () => {
    const tilt = (ahead) => page.evaluate((y) => (window.pads = [{ index: 0, id: "Test pad", connected: true, axes: [0, y, 0, 0] }]), -ahead);
    const read = async () => {
      const then = await page.evaluate(() => window.padReads);
      await page.waitForFunction((reads) => window.padReads > reads + 1, then);
    };
    await tilt(1);
    await panel("Teleoperation").getByText(/Gamepad connected: Test pad/).waitFor();
    await drives("pebble");
    await whileLeft(leave, () => isStopped("pebble"));
    await isStopped("pebble"); // although the stick is still pushed
    await tilt(0);
    await read();
    await tilt(1);
    await drives("pebble");
    await tilt(0);
    await isStopped("pebble");
    await page.evaluate(() => (window.pads = []));
    await read();
  });
}

test("a gamepad drives the robot, which stops when the gamepad is disconnected", async () => {
  await page.evaluate(() => (window.pads = [{ index: 0, id: "Test pad", connected: true, axes: [0, -1, 0, 0] }]));
  await panel("Teleoperation").getByText(/Gamepad connected: Test pad/).waitFor();
  await movesOn("pebble", 0.1);
  await page.evaluate(() => (window.pads = [null]));
  await panel("Teleoperation").getByText("The gamepad was disconnected. The robot stops.").waitFor();
  await standsStill("pebble");
});

test("a second viewer cannot drive the same robot, and sees the reason", async () => {
  const { page: second } = await openPage(browser, server.url);
  await second.waitForFunction(() => window.gsv !== undefined);
  await panel("Teleoperation", second).getByText("Others are watching this simulation. Take control first.").waitFor();
  await press("Take control", panel("Teleoperation", second));
  await panel("Teleoperation", second).getByText("Others are watching").waitFor({ state: "hidden" });
  await page.bringToFront();
  await panel("Teleoperation").getByText(/ has control\.$/).waitFor();
  const then = await placeOf("pebble");
  await pad().focus();
  await page.keyboard.press("w", { delay: 300 });
  await standsStill("pebble");
  const now = await placeOf("pebble");
  assert.ok(Math.hypot(now.x - then.x, now.y - then.y) < 0.02, "the first viewer drives nothing");
  await second.close();
  await panel("Teleoperation").getByText(/ has control\.$/).waitFor({ state: "hidden" });
});

test("the server refuses to drive a robot that its behaviour controls", async () => {
  const { error } = await ask(page, "/robots/porter/drive", { linear_m_s: 1 });
  assert.equal(error, "'porter' is controlled by its behaviour 'wander'. Add a robot without a behaviour to control it yourself.");
});

test("an arm's joint is moved by its slider, and shows its limits", async () => {
  await press("Joints");
  const joints = panel("Joints");
  await joints.getByRole("combobox", { name: "Body" }).selectOption("arm");
  const shoulder = joints.locator('[data-joint="shoulder"]');
  await shoulder.getByText("-1.500 rad to 1.500 rad, at most 2.000 rad/s, at most 60.0 N m").waitFor();
  await shoulder.getByRole("slider").focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("PageUp");
  const wanted = Number(await shoulder.getByRole("slider").inputValue());
  assert.ok(wanted > 0.5, `the slider stands at ${wanted}`);
  const position = async () => (await ask(page, "/bodies/arm/joints")).joints.find(({ name }) => name === "shoulder").position;
  await until(async () => Math.abs((await position()) - wanted) < 0.02, "the joint where the slider stands");
  await until(async () => Math.abs(parseFloat(await shoulder.locator(".joint-state").textContent()) - wanted) < 0.03, "its position in the panel");
  await joints.getByLabel("Degrees", { exact: true }).check();
  await shoulder.getByText(/-85.9 ° to 85.9 °/).waitFor();
  const slide = joints.locator('[data-joint="slide"]');
  await slide.getByLabel("slide: position as a number").fill("0.2");
  await page.keyboard.press("Enter");
  await until(async () => Math.abs((await ask(page, "/bodies/arm/joints")).joints[1].position - 0.2) < 0.01, "the slide at 0.2 m");
});

test("the inspector opens the joints of its robot, and a slider keeps its value while the simulation is paused", async () => {
  await page.locator('[data-robot="desk_arm"]').click();
  await page.getByRole("tab", { name: "Inspector", exact: true }).click();
  await press("Move joints");
  const joints = panel("Joints");
  await until(async () => (await joints.getByRole("combobox", { name: "Body" }).inputValue()) === "desk_arm", "the joints of desk_arm");
  const elbow = joints.locator('[data-joint="elbow"]');
  await elbow.waitFor();
  await joints.getByLabel("Degrees", { exact: true }).uncheck();
  await ask(page, "/pause", {});
  await joints.getByText("The simulation is paused. Commands are applied when it runs.").waitFor();
  await elbow.getByRole("slider").focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("PageUp");
  const wanted = Number(await elbow.getByRole("slider").inputValue());
  assert.ok(wanted > 0.5, `the slider stands at ${wanted}`);
  await elbow.getByText(`${wanted.toFixed(3)} rad is applied when the simulation resumes.`).waitFor();
  // Reports of the paused joint do not move the slider.
  for (let i = 0; i < 6; i++) await page.waitForResponse((response) => response.url().endsWith("/joints"));
  assert.equal(Number(await elbow.getByRole("slider").inputValue()), wanted);
  await press("Resume", joints);
  const position = async () => (await ask(page, "/bodies/desk_arm/joints")).joints[0].position;
  await until(async () => Math.abs((await position()) - wanted) < 0.02, "the joint where the slider stands");
  await elbow.getByText("is applied when").waitFor({ state: "hidden" });
});

test("the panel for driving says that the simulation is paused, and resumes it", async () => {
  await ask(page, "/pause", {});
  await page.getByRole("tab", { name: "Teleoperation", exact: true }).click();
  const driving = panel("Teleoperation");
  await driving.getByText("The simulation is paused. Resume it to drive.").waitFor();
  await press("Resume", driving);
  await driving.getByText("The simulation is paused.").waitFor({ state: "hidden" });
  await phaseIs(page, "running");
  await page.getByRole("tab", { name: "Joints", exact: true }).click();
});

test("the panel shows why the joints of a robot with a behaviour cannot be moved", async () => {
  const joints = panel("Joints");
  await joints.getByRole("combobox", { name: "Body" }).selectOption("porter");
  await joints.getByText("'porter' is controlled by its behaviour 'wander'. Add a robot without a behaviour to control it yourself.").waitFor();
  assert.equal(await joints.getByRole("slider").first().isDisabled(), true);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults.filter((fault) => !fault.includes("status of 409")), []);
});
