// Tests the page on a phone, by touch alone: every panel opens, the palette has every panel, command,
// robot, object, sensor and topic, everything is inside the screen, and sheets close after a choice. axe-core finds no problem meanwhile.
import assert from "node:assert/strict";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { judge } from "./axe.mjs";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, settled, until } from "./viewing.mjs";

const MODELS = path.join(path.dirname(fileURLToPath(import.meta.url)), "models");
const WORLD = path.join(MODELS, "workcell.sdf");
const SURVEYOR = path.join(MODELS, "surveyor.sdf");
const SCREEN = { width: 390, height: 844 };

let server;
let browser;
let page;
let faults;
let titles; // titles of all panels

before(async () => {
  const robots = ["--robot", "pebble@0,0", "--robot", `${SURVEYOR}@-2,1.5`, "--behaviour", "surveyor=wander"];
  server = await startServer([WORLD, ...robots, "--in-process"]);
  browser = await openBrowser({ ...SCREEN, touch: true });
  await browser.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
  // A changing picture keeps a browser without a graphics card busy.
  await until(() => page.evaluate(() => window.gsv.time > 0.5), "half a second");
  await ask(page, "/pause", {});
  await phaseIs(page, "paused");
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const button = (name, of = page) => of.getByRole("button", { name, exact: true });
const region = (name) => page.getByRole("region", { name, exact: true });
const palette = () => page.getByRole("dialog", { name: "Commands", exact: true });

async function isInside(locator, what) {
  await locator.waitFor();
  await until(async () => {
    const box = await locator.boundingBox();
    return box && box.x >= -1 && box.y >= -1 && box.x + box.width <= SCREEN.width + 1 && box.y + box.height <= SCREEN.height + 1;
  }, `${what} inside the screen`);
}

async function openPalette(text) {
  await button("Find").tap();
  await palette().getByRole("combobox").fill(text);
}

// Returns the names of all commands of this group.
async function commandsOf(group) {
  await openPalette(group);
  const found = await page.locator(".palette-item").evaluateAll((items) => items.map((item) => [...item.children].map((child) => child.textContent)));
  await page.keyboard.press("Escape");
  await palette().waitFor({ state: "hidden" });
  return found.filter(([of]) => of === group).map(([, label]) => label);
}

async function run(group, label) {
  await openPalette(`${group} ${label}`);
  const item = page.locator(".palette-item").filter({ has: page.getByText(group, { exact: true }) }).filter({ has: page.getByText(label, { exact: true }) });
  await isInside(palette(), "the palette");
  await item.first().tap();
  await palette().waitFor({ state: "hidden" });
}

// Some of the commands, as each takes a second or more without a graphics card.
const samplesOf = (labels) => [...new Set([labels[0], labels[labels.length >> 1], labels.at(-1)])];

async function runWithDownload(group, label) {
  const download = page.waitForEvent("download");
  await run(group, label);
  return (await download).suggestedFilename();
}

const isPressed = (name) => button(name).getAttribute("aria-pressed");
const pressedIs = (name, value) => until(async () => (await isPressed(name)) === value, `${name} ${value === "true" ? "on" : "off"}`);

test("nothing is wider than the screen, and every button is inside it or in a bar that scrolls", async () => {
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
  const outside = await page.evaluate(() =>
    [...document.querySelectorAll("button, select, input, a")]
      .filter((each) => each.checkVisibility({ visibilityProperty: true }) && !each.closest(".panel-bar, .menu-sheet, .sidebar"))
      .map((each) => ({ name: each.getAttribute("aria-label") ?? each.textContent, box: each.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 1 && (box.left < -1 || box.right > innerWidth + 1 || box.bottom > innerHeight + 1))
      .map(({ name }) => name),
  );
  assert.deepEqual(outside, []);
});

test("every panel opens by its button in the bar, and closes", async () => {
  const bar = page.getByRole("navigation", { name: "Panels", exact: true });
  titles = await bar.getByRole("button").evaluateAll((all) => all.filter((each) => !each.hidden).map((each) => each.getAttribute("aria-label")));
  assert.ok(titles.length > 10, `${titles}`);
  for (const title of titles) {
    const opens = button(title, bar);
    if ((await opens.getAttribute("aria-pressed")) === "false") await opens.tap();
    else await page.getByRole("tab", { name: title, exact: true }).tap();
    await isInside(region(title), title);
    const { width, height } = await region(title).boundingBox();
    assert.ok(width > 380 && height > 150, `${title} has ${width} x ${height}`);
    await button(`Close ${title.toLowerCase()}`).tap();
    await region(title).waitFor({ state: "detached" });
  }
});

test("the palette, the help and the menus have no accessibility problems", async () => {
  await openPalette("layout");
  await judge(page);
  await page.keyboard.press("Escape");
  for (const menu of ["Layout", "Overlays", "Share", "Speed and steps", "Viewers", "Notes"]) {
    await button(menu).tap();
    await page.getByRole("group", { name: menu, exact: true }).waitFor();
    await judge(page);
    await page.keyboard.press("Escape");
  }
  await run("Help", "Keys and gestures");
  await judge(page);
  await page.keyboard.press("Escape");
});

test("the palette has every panel, and the tab in front is in sight among many", async () => {
  assert.deepEqual((await commandsOf("Panel")).sort(), [...titles].sort());
  for (const title of titles.slice(-5)) {
    await run("Panel", title);
    await isInside(region(title), title);
    await isInside(page.getByRole("tab", { name: title, exact: true }), `the tab of ${title}`);
  }
});

test("the list of robots closes after a choice, and after a tap beside it", async () => {
  await run("Layout", "Standard");
  const list = page.getByRole("navigation", { name: "Scene", exact: true });
  for (const robot of ["pebble", "surveyor"]) {
    await button("Robots").tap();
    await isInside(list, "the list of robots");
    if (robot === "pebble") await judge(page);
    await page.locator(`[data-robot="${robot}"]`).tap();
    await list.waitFor({ state: "hidden" });
    await page.waitForFunction((name) => window.gsv.chosen[0] === name, robot);
  }
  await button("Robots").tap();
  await list.locator("summary").tap();
  await page.locator('[data-object="arm"]').tap();
  await list.waitFor({ state: "hidden" });
  await page.getByRole("region", { name: "Selected object" }).getByRole("heading", { name: "arm", exact: true }).waitFor();
  await button("Robots").tap();
  await list.waitFor();
  await page.touchscreen.tap(SCREEN.width - 10, SCREEN.height / 2);
  await list.waitFor({ state: "hidden" });
});

test("robots, objects and sensors are shown from the palette, which has all of them", async () => {
  await run("Panel", "Inspector");
  const robots = await commandsOf("Robot");
  assert.deepEqual(robots.sort(), ["pebble", "surveyor"]);
  for (const robot of robots) {
    await run("Robot", robot);
    await page.getByRole("region", { name: "Selected robot" }).getByRole("heading", { name: robot, exact: true }).waitFor();
  }
  const objects = await commandsOf("Object");
  assert.ok(objects.includes("arm"), `${objects}`);
  for (const object of samplesOf(objects)) {
    await run("Object", object);
    await page.getByRole("region", { name: "Selected object" }).getByRole("heading", { name: object, exact: true }).waitFor();
  }
  const { bodies } = await ask(page, "/scene");
  const sensors = await commandsOf("Sensor");
  assert.deepEqual([...sensors].sort(), bodies.flatMap((body) => body.sensors.map(({ name }) => `${body.name} ${name}`)).sort());
  for (const sensor of samplesOf(sensors)) {
    await run("Sensor", sensor);
    await page.getByRole("region", { name: "Selected object" }).getByRole("heading", { name: sensor.split(" ").at(-1) }).waitFor();
  }
});

test("topics are shown from the palette, which has all of them, and from the list of topics", async () => {
  const topics = await commandsOf("Topic");
  assert.ok(topics.includes("/gsv/status"), `${topics}`);
  for (const topic of samplesOf(topics)) {
    await run("Topic", topic);
    await region("Topics").getByRole("heading", { name: topic, exact: true }).waitFor();
  }
  const rows = page.locator("[data-topic]");
  await until(async () => (await rows.count()) === topics.length, "a row for each topic");
  for (const topic of ["/gsv/status", topics.at(-1)]) {
    await page.locator(`[data-topic="${topic}"]`).tap();
    await region("Topics").getByRole("heading", { name: topic, exact: true }).waitFor();
    await isInside(page.locator(".topic-message"), "the message");
  }
});

test("layouts are shown from the palette, and the menu of layouts closes after a choice", async () => {
  const layouts = await commandsOf("Layout");
  assert.equal(layouts.length, 5, `${layouts}`);
  for (const title of samplesOf(layouts)) {
    await run("Layout", title);
    await isInside(page.locator(".view"), "the view");
  }
  const sheet = page.getByRole("group", { name: "Layout", exact: true });
  await button("Layout").tap();
  await isInside(sheet, "the menu of layouts");
  await button("Drive", sheet).tap();
  await sheet.waitFor({ state: "hidden" });
  await page.getByRole("tab", { name: "Teleoperation", exact: true }).waitFor();
  await button("Layout").tap();
  await button("Standard", sheet).tap();
});

test("overlays are switched from the palette, and the menu of overlays closes after a choice", async () => {
  const overlays = await commandsOf("Overlay");
  const items = page.locator(".menu-item[aria-pressed]").locator("span:not(.check)");
  const names = (await items.allTextContents()).map((name) => name.toLowerCase());
  assert.deepEqual(overlays.map((label) => label.replace(/^(Show|Hide) /, "")).sort(), names.filter((name) => name !== "record video").sort());
  const [first] = overlays;
  await run("Overlay", first);
  const [verb, ...name] = first.split(" ");
  const other = `${verb === "Hide" ? "Show" : "Hide"} ${name.join(" ")}`;
  assert.ok((await commandsOf("Overlay")).includes(other), other);
  const sheet = page.getByRole("group", { name: "Overlays", exact: true });
  await button("Overlays").tap();
  await isInside(sheet, "the menu of overlays");
  await button("Frames", sheet).tap();
  await sheet.waitFor({ state: "hidden" });
});

// Returns what a command of the group View must show.
const VIEW = {
  Map: () => pressedIs("Map", "true"),
  "Leave the map": () => pressedIs("Map", "false"),
  Measure: async () => {
    await pressedIs("Measure", "true");
    await button("Measure").tap();
    await pressedIs("Measure", "false");
  },
  "Reset view": async () => {},
  "Top view": async () => {},
  Follow: () => pressedIs("Follow", "true"),
  Chase: () => pressedIs("Chase", "true"),
  "Robot's eye": () => pressedIs("Robot's eye", "true"),
  "Free view": () => pressedIs("Robot's eye", "false"),
  "Copy link": () => page.getByText("Link copied.").waitFor(),
  "Show all cameras": () => page.locator(".camera-grid").waitFor(),
};

test("every command of the view works from the palette, and Share closes after a choice", async () => {
  await run("Robot", "pebble");
  const found = await commandsOf("View");
  for (const label of ["Map", "Leave the map", ...found.filter((each) => each in VIEW && each !== "Map")]) {
    await run("View", label);
    await VIEW[label]();
  }
  assert.match(await runWithDownload("View", "Save image"), /\.png$/);
  assert.deepEqual(found.filter((label) => !(label in VIEW)), ["Save image", "Record video"]);
  const sheet = page.getByRole("group", { name: "Share", exact: true });
  await button("Share").tap();
  await isInside(sheet, "the menu for sharing");
  await button("Copy link", sheet).tap();
  await sheet.waitFor({ state: "hidden" });
});

test("the menus of speed, viewers and notes are inside the screen, and close after a choice", async () => {
  const speed = page.getByRole("group", { name: "Speed and steps", exact: true });
  await button("Speed and steps").tap();
  await isInside(speed, "the menu of the speed");
  await button("2×", speed).tap();
  await speed.waitFor({ state: "hidden" });
  await until(async () => (await ask(page, "")).target_factor === 2, "the speed");
  const viewers = page.getByRole("group", { name: "Viewers", exact: true });
  await button("Viewers").tap();
  await isInside(viewers, "the menu of viewers");
  await button("Take control", viewers).tap();
  await viewers.waitFor({ state: "hidden" });
  const notes = page.getByRole("group", { name: "Notes", exact: true });
  await button("Notes").tap();
  await isInside(notes, "the menu of notes");
  await notes.getByLabel("Note", { exact: true }).fill("from a phone");
  await notes.getByRole("button", { name: /^Add at/ }).tap();
  await notes.waitFor({ state: "hidden" });
  await button("Notes 1").tap();
  await notes.getByText(/from a phone$/).waitFor();
  await page.keyboard.press("Escape");
});

test("a robot is moved by its handle, and a wall is drawn, by touch", async () => {
  await run("Run", "Edit");
  await isInside(region("Edit"), "the panel Edit");
  await run("Robot", "pebble");
  await run("View", "Reset view");
  await settled(page);
  await page.waitForFunction(() => window.gsv.chosen[0] === "pebble" && window.gsv.gizmoHandle("x") !== null);
  const placeOf = async (name) => (await ask(page, "/scene")).bodies.find((body) => body.name === name)?.pose;
  const before = await placeOf("pebble");
  const [from, middle] = await page.evaluate(() => [window.gsv.gizmoHandle("x"), window.gsv.robotScreenPosition("pebble")]);
  const finger = await page.context().newCDPSession(page);
  const touch = (type, ...touchPoints) => finger.send("Input.dispatchTouchEvent", { type, touchPoints });
  await touch("touchStart", from);
  for (const part of [0.3, 0.6, 0.9]) await touch("touchMove", { x: from.x + part * (from.x - middle.x), y: from.y + part * (from.y - middle.y) });
  await touch("touchEnd");
  await until(async () => (await placeOf("pebble"))[0] - before[0] > 0.05, "the moved robot");
  const now = await placeOf("pebble");
  assert.ok(Math.abs(now[1] - before[1]) < 1e-6 && Math.abs(now[2] - before[2]) < 1e-6, `${before} to ${now}: along x only`);
  const undo = page.locator('.edit [aria-label="Undo"]:enabled');
  await undo.tap();
  await until(async () => Math.abs((await placeOf("pebble"))[0] - before[0]) < 1e-6, "the robot at its old place");
  await button("Shape", region("Edit")).tap();
  const shape = page.getByRole("group", { name: "Shape", exact: true });
  await shape.getByLabel("Shape", { exact: true }).selectOption("wall");
  await button("Draw wall", shape).tap();
  await shape.waitFor({ state: "hidden" });
  await settled(page);
  const at = await page.evaluate(() => window.gsv.robotScreenPosition("pebble"));
  // On a busy machine a tap may last so long that the browser takes it for a long press.
  await until(async () => {
    await page.touchscreen.tap(at.x - 60, at.y + 30);
    return page.getByText("where the wall ends").waitFor({ timeout: 10_000 }).then(() => true, () => false);
  }, "the beginning of the wall");
  await until(async () => {
    await page.touchscreen.tap(at.x - 10, at.y + 60);
    return page.waitForFunction(() => window.gsv.chosen[0] === "wall", undefined, { timeout: 10_000 }).then(() => true, () => false);
  }, "the wall");
  await undo.tap();
  await until(async () => (await placeOf("wall")) === undefined, "the end of the wall");
  await finger.detach();
  await run("Run", "End editing");
  await region("Edit").waitFor({ state: "detached" });
});

test("every command of the run works from the palette", async () => {
  const done = new Set();
  const take = async (label) => {
    done.add(label);
    await run("Run", label);
  };
  const seen = new Set(await commandsOf("Run"));
  const { time_s: then } = await ask(page, "");
  await take("Take one step");
  await until(async () => (await ask(page, "")).time_s > then, "a step");
  assert.match(await runWithDownload("Edit", "Save world"), /\.sdf$/);
  const speed = page.getByRole("group", { name: "Speed and steps", exact: true });
  for (const label of ["Take several steps…", "Set another speed…"]) {
    await take(label);
    await isInside(speed, "the menu of the speed");
    await page.keyboard.press("Escape");
    await speed.waitFor({ state: "hidden" });
  }
  await take("Set the speed to 5×");
  await until(async () => (await ask(page, "")).target_factor === 5, "the speed");
  await take("Edit");
  await isInside(region("Edit"), "the panel Edit");
  await judge(page);
  for (const menu of ["Shape", "Robot or object", "Save"]) {
    await button(menu, region("Edit")).tap();
    await isInside(page.getByRole("group", { name: menu, exact: true }), `the menu ${menu}`);
    await judge(page);
    await page.keyboard.press("Escape");
  }
  for (const label of await commandsOf("Run")) seen.add(label);
  await take("End editing");
  await region("Edit").waitFor({ state: "detached" });
  await take("Resume");
  await phaseIs(page, "running");
  for (const label of await commandsOf("Run")) seen.add(label);
  await take("Pause");
  await phaseIs(page, "paused");
  await take("New simulation");
  await isInside(page.locator(".set-up"), "the form for a new simulation");
  await page.locator('.set-up[aria-busy="false"]').waitFor();
  await judge(page);
  await page.locator(".set-up").getByRole("button", { name: "Cancel", exact: true }).tap();
  await page.locator(".set-up").waitFor({ state: "hidden" });
  await take("Reset");
  await phaseIs(page, "created");
  for (const label of await commandsOf("Run")) seen.add(label);
  await take("Start");
  await phaseIs(page, "running");
  await take("Stop");
  await phaseIs(page, "stopped");
  assert.deepEqual([...seen].filter((label) => !done.has(label) && label !== "Record" && !label.startsWith("Set the speed to ")), []);
});

test("the help is inside the screen, and closes", async () => {
  assert.deepEqual(await commandsOf("Help"), ["Keys and gestures", "Open documentation", "Single-key shortcuts: off"]);
  await run("Help", "Keys and gestures");
  const help = page.getByRole("dialog", { name: /Keys|Help/ });
  await isInside(help, "the help");
  await help.getByRole("button", { name: "Close" }).tap();
  await help.waitFor({ state: "hidden" });
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
