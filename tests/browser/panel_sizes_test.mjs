// Opens every panel of the registry in a window in light and dark colours, and on a phone. Each time
// axe-core finds no problem, the panel is in sight, and the keyboard focus is visible on every control.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { faultsOf } from "./axe.mjs";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { controlsWithoutVisibleFocus } from "./focus.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, until } from "./viewing.mjs";

const PHONE = { width: 390, height: 760 };
const SIZES = [
  { name: "in light colours", width: 1366, height: 768, colorScheme: "light" },
  { name: "in dark colours", width: 1366, height: 768, colorScheme: "dark" },
  { name: "on a phone", ...PHONE, colorScheme: "light" },
  { name: "on a phone in dark colours", ...PHONE, colorScheme: "dark" },
];
// The panel Expectations exists only if the scenario has expectations.
const SCENARIO = `
world: playground
mode: real_time
duration: 3600
robots:
  - {name: walker, model: pebble, x: 0, y: -1.5, behaviour: wander}
  - {name: free, model: pebble, x: 2, y: -3}
expect:
  - name: it stays inside
    stays_within: {robot: walker, x: [-20, 20]}
  - name: it arrives
    reaches: {robot: walker, x: 90, y: 0, within: 0.5}
`;

// The titles in the registry's source, in its order.
const REGISTRY = new URL("../../web/src/panels/registry.ts", import.meta.url);
const TITLES = [...fs.readFileSync(REGISTRY, "utf8").matchAll(/^ {4}title: "(.+)",$/gm)].map(([, title]) => title);

let folder;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-panels-"));
  const file = path.join(folder, "panels.yaml");
  fs.writeFileSync(file, SCENARIO);
  server = await startServer([file, "--in-process"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
  await page.locator('[data-robot="walker"]').click();
  // A changing picture keeps a browser without a graphics card busy.
  await until(() => page.evaluate(() => window.gsv.time > 1), "a second");
  await ask(page, "/pause", {});
  await phaseIs(page, "paused");
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

const bar = () => page.getByRole("navigation", { name: "Panels" });

async function resize({ width, height, colorScheme }) {
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
}

async function open(title) {
  const button = bar().getByRole("button", { name: title, exact: true });
  if ((await button.getAttribute("aria-pressed")) !== "true") await button.click();
  await page.getByRole("tab", { name: title, exact: true }).click();
  const panel = page.getByRole("region", { name: title, exact: true });
  await panel.waitFor();
  // The content is loaded after the panel.
  await until(async () => (await panel.innerText()).trim().length > title.length, `the content of ${title}`);
  return panel;
}

async function close(title) {
  await page.getByRole("button", { name: `Close ${title.toLowerCase()}`, exact: true }).click();
  await page.getByRole("region", { name: title, exact: true }).waitFor({ state: "detached" });
}

test("the bar has a button for each panel of the registry", async () => {
  assert.ok(TITLES.length > 10, `the registry has ${TITLES}`);
  await until(async () => (await bar().getByRole("button").count()) === TITLES.length, "the buttons of all panels");
  const names = await bar().getByRole("button").evaluateAll((all) => all.map((button) => button.getAttribute("aria-label")));
  assert.deepEqual([...names].sort(), [...TITLES].sort());
});

for (const title of TITLES) {
  test(`the panel ${title} has no accessibility problems, is in sight and shows the focus at each size`, async () => {
    const found = {};
    const outside = {};
    const unseen = {};
    for (const size of SIZES) {
      await resize(size);
      const panel = await open(title);
      found[size.name] = await faultsOf(page);
      unseen[size.name] = await controlsWithoutVisibleFocus(page);
      const box = await panel.boundingBox();
      const isInside = box.x >= -1 && box.y >= -1 && box.x + box.width <= size.width + 1 && box.y + box.height <= size.height + 1;
      if (!isInside || box.height < 80) outside[size.name] = box;
    }
    await resize(SIZES[0]);
    await close(title);
    const nothing = Object.fromEntries(SIZES.map(({ name }) => [name, []]));
    assert.deepEqual(found, nothing);
    assert.deepEqual(unseen, nothing);
    assert.deepEqual(outside, {});
  });
}

test("a control without a focus ring would be found", async () => {
  await page.evaluate(() => {
    const rules = new CSSStyleSheet();
    rules.replaceSync("* { outline: none !important; box-shadow: none !important; border-color: red !important; background: none !important; }");
    document.adoptedStyleSheets.push(rules);
  });
  assert.ok((await controlsWithoutVisibleFocus(page)).length > 10);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
