// Tests the workspace: panels are docked, tabbed, moved, maximised and closed; layouts are saved,
// linked and shared as files. On a phone, all controls can be reached.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { ask, until } from "./viewing.mjs";

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  await browser.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const press = (name, of = page) => of.getByRole("button", { name, exact: true }).click();
const part = (name, of = page) => of.getByRole("region", { name, exact: true });
const boxOf = (name, of = page) => part(name, of).boundingBox();

async function chooseLayout(title, of = page) {
  await press("Layout", of);
  await of.getByRole("group", { name: "Layout" }).getByRole("button", { name: title, exact: true }).click();
}

function overlap(a, b) {
  const width = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
  const height = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
  return Math.max(0, Math.round(width) - 1) * Math.max(0, Math.round(height) - 1);
}

test("no panel covers the view", async () => {
  await chooseLayout("Debug a behaviour");
  const view = await page.locator(".view").boundingBox();
  assert.ok(view.width > 400 && view.height > 250, JSON.stringify(view));
  for (const name of ["Inspector", "Images", "Plots", "Log"]) {
    const box = await boxOf(name);
    assert.ok(box.width > 100 && box.height > 80, `${name} has ${JSON.stringify(box)}`);
    assert.equal(overlap(view, box), 0, name);
  }
});

test("the tools of a narrow panel of plots have two lines, and the button to save is beside others", async () => {
  const tools = part("Plots").locator(".panel-tools");
  const box = await tools.boundingBox();
  assert.ok(box.width < 450 && box.height < 100, JSON.stringify(box));
  const [events, save] = [await tools.getByText("Events", { exact: true }).boundingBox(), await tools.getByRole("button", { name: "Save as CSV" }).boundingBox()];
  assert.ok(Math.abs(events.y + events.height / 2 - save.y - save.height / 2) < 4, JSON.stringify({ events, save }));
  assert.ok(save.x + save.width <= box.x + box.width, "the button is inside the panel");
});

test("buttons have words in a window of 1,200 px, and tooltips at any width", async () => {
  const buttons = page.locator(".toolbar button:visible, .view-tools button:visible, .panel-bar button:visible");
  for (const width of [1200, 1100]) {
    await page.setViewportSize({ width, height: 768 });
    await chooseLayout("Standard");
    const found = await buttons.evaluateAll((all) =>
      all.map((each) => {
        const word = each.querySelector(".word")?.getBoundingClientRect();
        const frame = each.getBoundingClientRect();
        const isInside = word && word.width > 0 && word.left >= frame.left - 1 && word.right <= frame.right + 1 && word.bottom <= frame.bottom + 1;
        return { name: each.getAttribute("aria-label") ?? each.textContent, hasTooltip: each.title !== "", hasWord: Boolean(isInside) || each.innerText.trim() !== "" };
      }),
    );
    assert.ok(found.length > 25, `${found.length} buttons`);
    assert.deepEqual(found.filter(({ hasTooltip }) => !hasTooltip), []);
    if (width >= 1200) assert.deepEqual(found.filter(({ hasWord }) => !hasWord), []);
  }
  await page.setViewportSize({ width: 1366, height: 768 });
});

test("the buttons of panels and of the run are in groups", async () => {
  const bar = page.getByRole("navigation", { name: "Panels" });
  const groups = await bar.getByRole("group").evaluateAll((all) =>
    all.map((group) => ({
      name: group.getAttribute("aria-label"),
      boxes: [...group.querySelectorAll("button")].filter((button) => button.checkVisibility()).map((button) => button.getBoundingClientRect()),
    })),
  );
  assert.deepEqual(groups.map(({ name }) => name), ["Look", "Control", "Data", "Health"]);
  assert.equal(groups.reduce((sum, { boxes }) => sum + boxes.length, 0), await bar.getByRole("button").count());
  // The gap between two groups is larger than the gaps inside a group.
  const gaps = (boxes) => boxes.slice(1).map((box, i) => Math.max(box.left - boxes[i].right, box.top - boxes[i].bottom));
  const inside = Math.max(...groups.flatMap(({ boxes }) => gaps(boxes)));
  const between = Math.min(...groups.slice(1).map(({ boxes }, i) => gaps([groups[i].boxes.at(-1), boxes[0]])[0]));
  assert.ok(between > inside + 3, `${between} pixels between groups, ${inside} inside`);
  const run = page.getByRole("group", { name: "Run", exact: true }).getByRole("button");
  const names = (await run.evaluateAll((all) => all.filter((each) => each.checkVisibility()).map((each) => each.textContent.trim() || each.getAttribute("aria-label"))));
  for (const name of ["Pause", "Step", "Stop", "Reset", "Edit"]) assert.ok(names.includes(name), `${names}`);
});

test("the page is dark if the system is", async () => {
  await chooseLayout("Watch a crowd");
  await press("Plots");
  await part("Plots").waitFor();
  const brightness = async (clip) => {
    const { data } = await picture(page, clip);
    return data.reduce((sum, value, i) => (i % 4 === 3 ? sum : sum + value), 0) / (0.75 * data.length);
  };
  for (const [colorScheme, isRight] of [["dark", (value) => value < 70], ["light", (value) => value > 185]]) {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    for (const name of ["Plots", "Log"]) {
      await page.getByRole("tab", { name, exact: true }).click();
      const clip = await boxOf(name);
      await until(async () => isRight(await brightness(clip)), `${name} in ${colorScheme} colours`);
    }
    for (const place of [".toolbar", ".panel-bar"]) {
      const value = await brightness(await page.locator(place).boundingBox());
      assert.ok(isRight(value), `${place} has the brightness ${value} in ${colorScheme} colours`);
    }
  }
});

test("the layout Drive shows a camera and the pad beside the view", async () => {
  await chooseLayout("Drive");
  const view = await page.locator(".view").boundingBox();
  for (const name of ["Images", "Teleoperation"]) {
    const box = await boxOf(name);
    assert.ok(box.width > 300 && box.height > 150 && box.x >= view.x + view.width, `${name} has ${JSON.stringify({ box, view })}`);
  }
  await page.getByText("No robot can be driven").waitFor(); // the only robot has a behaviour
});

// The names of the tabs of each part, in the order of the page.
const tabsOfParts = (of = page) =>
  of.locator(".dv-groupview").evaluateAll((parts) =>
    parts.map((each) => [...each.querySelectorAll('[role="tab"]')].map((tab) => tab.getAttribute("aria-label")).join()).filter((names) => names !== ""),
  );

test("a tab is dropped on the tabs of another part", async () => {
  await chooseLayout("Debug a behaviour");
  await part("Plots").waitFor();
  const former = await boxOf("Plots");
  assert.deepEqual((await tabsOfParts()).sort(), ["Images", "Inspector", "Log", "Plots", "View"]);
  await page.getByRole("tab", { name: "Log", exact: true }).dragTo(page.getByRole("tab", { name: "Plots", exact: true }));
  await until(async () => (await tabsOfParts()).some((names) => names === "Log,Plots" || names === "Plots,Log"), "the log beside the plots");
  // The log is in front, in the place of the plots and in its own former place.
  const log = await boxOf("Log");
  assert.ok(Math.abs(log.x - former.x) < 3 && log.width > 1.5 * former.width, JSON.stringify({ log, former }));
  await page.getByRole("tab", { name: "Plots", exact: true }).click();
  await part("Plots").waitFor();
  assert.equal(await part("Log").isVisible(), false);
});

test("a link that is copied after a rearrangement opens the same arrangement", async () => {
  await press("Arrange plots");
  await press("Move to the left of the view");
  await until(async () => ((await boxOf("Plots"))?.x ?? 1e9) < (await page.locator(".view").boundingBox()).x, "the plots at the left");
  await press("Share");
  await press("Copy link");
  await page.getByText("Link copied.").waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const [tabs, plots] = [await tabsOfParts(), await boxOf("Plots")];
  await chooseLayout("Standard"); // and the browser stores this layout
  const { page: linked } = await openPage(browser, link);
  await waitUntilDrawn(linked);
  await part("Plots", linked).waitFor();
  assert.deepEqual(await tabsOfParts(linked), tabs);
  const again = await boxOf("Plots", linked);
  for (const key of ["x", "y", "width", "height"]) assert.ok(Math.abs(again[key] - plots[key]) < 8, JSON.stringify({ again, plots }));
  await linked.close();
});

test("a tab is dragged beside the view", async () => {
  await chooseLayout("Watch a crowd");
  const tab = page.getByRole("tab", { name: "Log", exact: true });
  const view = await page.locator(".view").boundingBox();
  await tab.dragTo(page.locator(".view"), { targetPosition: { x: view.width - 20, y: view.height / 2 } });
  await until(async () => ((await boxOf("Log"))?.x ?? 0) > view.x + view.width / 3, "the log at the right of the view");
  assert.equal(overlap(await page.locator(".view").boundingBox(), await boxOf("Log")), 0);
});

test("a panel is moved without a drag, maximised, restored and closed", async () => {
  await chooseLayout("Watch a crowd");
  await page.getByRole("tab", { name: "Status", exact: true }).click();
  await press("Arrange status");
  await press("Move to the left of the view");
  await until(async () => ((await boxOf("Status"))?.x ?? 1e9) < (await page.locator(".view").boundingBox()).x, "the status at the left");
  const former = (await boxOf("Status")).width;
  await press("Arrange status");
  await press("Maximise");
  const whole = await page.locator(".workspace").boundingBox();
  await until(async () => (await boxOf("Status"))?.width > whole.width - 10, "the whole workspace");
  await press("Arrange status");
  await press("Restore the size");
  await until(async () => Math.abs((await boxOf("Status")).width - former) < 5, "its former size");
  await press("Close status");
  await part("Status").waitFor({ state: "detached" });
  assert.equal(await page.getByRole("button", { name: "Status", exact: true }).getAttribute("aria-pressed"), "false");
});

test("a border between two parts is moved", async () => {
  await chooseLayout("Standard");
  const before = await boxOf("Inspector");
  const y = before.y + before.height / 3;
  await page.mouse.move(before.x, y);
  await page.mouse.down();
  await page.mouse.move(before.x - 120, y, { steps: 5 });
  await page.mouse.up();
  const after = await boxOf("Inspector");
  assert.ok(Math.abs(after.width - before.width - 120) < 12, `${before.width} became ${after.width}`);
});

test("a layout is saved by name, and there again after the page was loaded anew", async () => {
  await chooseLayout("Watch a crowd");
  await press("Plots");
  await part("Plots").waitFor();
  await press("Layout");
  await page.getByLabel("Name of the layout").fill("Night shift");
  await press("Save");
  await page.getByText("Layout Night shift saved in this browser.").waitFor();
  await page.keyboard.press("Escape");
  await page.reload();
  await waitUntilDrawn(page);
  await part("Plots").waitFor(); // the layout is as it was left
  await chooseLayout("Standard");
  await part("Inspector").waitFor();
  await part("Plots").waitFor({ state: "detached" });
  await chooseLayout("Night shift");
  await part("Plots").waitFor();
});

test("a layout is exported to a file, and imported from it", async () => {
  await chooseLayout("Replay a failure");
  await part("Log").waitFor();
  await press("Layout");
  const download = page.waitForEvent("download");
  await press("Export layout");
  const file = path.join(browser.profile, "layout.json");
  await (await download).saveAs(file);
  const told = JSON.parse(fs.readFileSync(file, "utf8"));
  assert.equal(told.gsv_layout, 1);
  assert.match(told.layout, /log/);
  await chooseLayout("Standard");
  await part("Log").waitFor({ state: "detached" });
  await page.getByLabel("Layout file").setInputFiles(file);
  await part("Log").waitFor();
  fs.writeFileSync(file, "{}");
  await page.getByLabel("Layout file").setInputFiles(file);
  await page.getByText('layout.json is no layout: it has no "gsv_layout".').waitFor();
});

test("a link opens its layout; an invalid one shows an error and the standard layout", async () => {
  const { page: linked } = await openPage(browser, `${server.url}#layout=c(view~500,status.log*~500)`);
  await waitUntilDrawn(linked);
  await part("Log", linked).waitFor();
  assert.deepEqual(
    await linked.getByRole("tab").evaluateAll((tabs) => tabs.map((tab) => tab.getAttribute("aria-label"))),
    ["View", "Status", "Log"],
  );
  await linked.goto(`${server.url}#layout=r(view`);
  await linked.getByText(/^The layout in the page's address cannot be shown: expected ~ and a share/).waitFor();
  await part("Inspector", linked).waitFor();
  await linked.close();
});

test("Esc ends Maximise, and keeps the selection", async () => {
  await chooseLayout("Watch a crowd");
  await page.locator("[data-robot]").first().click();
  await page.getByRole("tab", { name: "Status", exact: true }).click();
  const { height } = await boxOf("Status");
  await press("Arrange status");
  await press("Maximise");
  await until(async () => (await boxOf("Status")).height > height + 100, "the maximised panel");
  await page.keyboard.press("Escape");
  await until(async () => Math.abs((await boxOf("Status")).height - height) < 2, "the panel of its former size");
  await page.waitForFunction(() => window.gsv.chosen[0] === "pebble");
});

test("many tabs give way to the buttons of their part", async () => {
  await chooseLayout("Standard");
  for (const name of ["World", "Teleoperation", "Joints", "Commands"]) await press(name);
  const [part, close] = [page.locator(".dv-groupview", { has: page.getByRole("tab", { name: "Commands" }) }), page.getByRole("button", { name: "Close commands" })];
  const [whole, box] = [await part.boundingBox(), await close.boundingBox()];
  assert.ok(box.x + box.width <= whole.x + whole.width + 1, JSON.stringify({ whole, box }));
  await close.click();
  await page.getByRole("tab", { name: "Commands", exact: true }).waitFor({ state: "detached" });
});

test("a panel is moved to its own window, and back", async () => {
  await chooseLayout("Watch a crowd");
  await page.getByRole("tab", { name: "Status", exact: true }).click();
  await press("Arrange status");
  const opened = page.waitForEvent("popup");
  await press("Open in a separate window");
  const popup = await opened;
  await popup.locator(".panel.status tbody tr").first().waitFor();
  // The window has the page's style, and its panel is up to date.
  const look = (of) => of.evaluate(() => [getComputedStyle(document.body).fontFamily, getComputedStyle(document.querySelector(".panel.status")).color].join());
  assert.equal(await look(popup), await look(page).catch(() => look(popup)));
  const { time_s } = await ask(page, "");
  await popup.waitForFunction((then) => {
    const [, minutes, seconds] = /(\d+):(\d+\.\d+)/.exec(document.querySelector(".panel.status").innerText) ?? [];
    return 60 * minutes + Number(seconds) > then;
  }, time_s);
  await popup.close();
  await page.locator(".panel.status tbody tr").first().waitFor();
});

test("topics are listed with types and rates, and a field of any message is read and plotted", async () => {
  await chooseLayout("Watch a crowd");
  await press("Topics");
  await page.getByLabel("Text in topic or type").fill("/gsv/status");
  const row = page.locator(".topic-list tbody tr").first();
  await row.getByText("gsv_msgs/msg/SimulationStatus").waitFor();
  await row.getByRole("button", { name: "/gsv/status" }).click();
  const tree = page.locator(".message-tree");
  await tree.getByText('"real_time"').waitFor();
  await tree.getByText("robots", { exact: true }).click();
  await tree.locator("summary", { hasText: "[0]" }).getByText("pebble").waitFor();
  const [rate, bandwidth] = [2, 3].map((column) => async () => Number(await row.locator("td").nth(column).textContent()));
  await until(async () => (await rate()) > 0 && (await bandwidth()) > 0, "a rate and a bandwidth");
  // A status has a few hundred bytes.
  const bytes = (1000 * (await bandwidth())) / (await rate());
  assert.ok(bytes > 50 && bytes < 5000, `${bytes} bytes for each message`);
  const clipboard = () => page.evaluate(() => navigator.clipboard.readText());
  await press("Freeze this message");
  await press("Copy mode");
  await until(async () => (await clipboard()) === "real_time", "the copied field");
  await press("Copy the message as JSON");
  await until(async () => (await clipboard()).startsWith("{"), "the copied message");
  assert.equal(JSON.parse(await clipboard()).robots[0].name, "pebble");
  await press("Plot step");
  await page.locator(".plot-legend").getByText("gsv status step").waitFor();
});

test("the command palette finds commands, robots, topics and panels", async () => {
  const find = async (text) => {
    await page.keyboard.press("Control+k");
    await page.getByRole("combobox", { name: "Command, robot, topic or panel" }).fill(text);
    await page.keyboard.press("Enter");
    await page.locator("dialog.palette").waitFor({ state: "hidden" });
  };
  await find("layout standard");
  await part("Inspector").waitFor();
  await find("robot pebble");
  await page.getByRole("region", { name: "Selected robot" }).getByRole("heading", { name: "pebble" }).waitFor();
  await find("topic /gsv/events");
  await part("Topics").getByRole("heading", { name: "/gsv/events" }).waitFor();
  await find("run pause");
  await page.waitForFunction(() => window.gsv.phase === "paused");
});

test("the key of a command is changed in the help, and stored", async () => {
  await chooseLayout("Standard");
  await page.keyboard.press("?");
  const help = page.getByRole("dialog", { name: "Help" });
  const key = help.getByRole("button", { name: "I: change the key", exact: true });
  await key.click();
  await page.keyboard.press("z");
  await help.getByRole("button", { name: "Z: change the key", exact: true }).waitFor();
  await page.keyboard.press("Escape");
  await help.waitFor({ state: "hidden" });
  await page.reload();
  await waitUntilDrawn(page);
  await page.keyboard.press("i");
  await page.keyboard.press("z");
  await part("Status").waitFor(); // two presses of a key of this panel would have closed it again
  assert.equal(await page.locator(".panel-bar").getByRole("button", { name: "Status", exact: true }).getAttribute("title"), "Status of the simulation, its robots and the server (Z)");
});

test("on a phone every panel, view and layout can be reached", async () => {
  await page.setViewportSize({ width: 390, height: 780 });
  await chooseLayout("Standard");
  await press("Status");
  await page.locator(".panel.status tbody tr").first().waitFor();
  const [view, status] = [await page.locator(".view").boundingBox(), await boxOf("Status")];
  assert.ok(view.width > 380 && status.width > 380 && status.y > view.y + 100, JSON.stringify({ view, status }));
  await press("Robots");
  await page.locator("[data-robot]").first().click();
  await page.locator("[data-robot]").first().waitFor({ state: "hidden" }); // the sheet closes after a choice
  await page.getByRole("tab", { name: "Inspector", exact: true }).click();
  await page.getByRole("region", { name: "Selected robot" }).waitFor();
  const outside = await page.evaluate(() =>
    [...document.querySelectorAll("button:not([hidden])")]
      .filter((button) => button.checkVisibility() && !button.closest(".panel-bar, .menu-sheet, [hidden]"))
      .map((button) => ({ name: button.getAttribute("aria-label") ?? button.textContent, box: button.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0 && (box.left < -1 || box.right > innerWidth + 1))
      .map(({ name }) => name),
  );
  assert.deepEqual(outside, []);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
