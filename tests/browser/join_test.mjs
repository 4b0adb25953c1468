// Tests the page for joining simulations: two instances at one broker, and a relay of one of them.
import assert from "node:assert/strict";
import { mkdtemp, readdir, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import process from "node:process";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { startServe, startServer, startView } from "./server.mjs";
import { phaseIs } from "./viewing.mjs";

const RUN = ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander"];

let here;
let elsewhere;
let relay;
let broker;
let browser;
let page;
let faults;

before(async () => {
  here = await startServe(["--name", "workbench"]);
  ({ broker } = await (await fetch(`${here.url}api/instances`)).json());
  elsewhere = await startServer([...RUN, "--broker", broker]);
  browser = await openBrowser({ width: 1000, height: 640 });
  ({ page, faults } = await openPage(browser, `${here.url}join.html`));
});

after(async () => {
  await browser?.close();
  await relay?.stop();
  await elsewhere?.stop();
  await here?.stop();
});

const instance = (name) => page.locator(".instance", { has: page.getByRole("heading", { name }) });

test("every instance is listed with its simulations, and this one is marked", async () => {
  await instance("workbench · this one").getByText("No simulation is running.").waitFor();
  const link = instance("gsv run").getByRole("link", { name: "simulation" });
  await link.waitFor();
  assert.equal(await link.getAttribute("href"), `${elsewhere.url}?simulation=simulation`);
  await keepPicture(page, "join");
});

test("one click shows the simulation of the other instance", async () => {
  await instance("gsv run").getByRole("link", { name: "simulation" }).click();
  await waitUntilDrawn(page);
  await phaseIs(page, "running");
  assert.deepEqual(await page.evaluate(() => window.gsv.robots), ["pebble"]);
  assert.equal(new URL(page.url()).origin, new URL(elsewhere.url).origin);
  await page.goBack();
});

test("an instance is relayed by its offer's name, and disappears from the list when it has ended", async () => {
  relay = await startView(["gsv run", "--broker", broker]);
  const names = await (await fetch(`${relay.url}api/simulations`)).json();
  assert.deepEqual(names.map(({ name }) => name), ["simulation"]);
  await page.reload();
  await instance("gsv run").waitFor();
  await elsewhere.stop();
  await instance("gsv run").waitFor({ state: "detached" });
  await instance("workbench · this one").waitFor();
  assert.deepEqual(faults.filter((fault) => !fault.startsWith("request to another host")), []);
});

test("the next server lists the simulations of a killed one until they are dismissed", async () => {
  const folder = await mkdtemp(path.join(tmpdir(), "gsv-join-"));
  process.env.XDG_STATE_HOME = folder;
  const serve = ["--name", "doomed", "--recordings", folder];
  const doomed = await startServe(serve);
  const body = JSON.stringify({ name: "arena", world: "playground" });
  await fetch(`${doomed.url}api/simulations`, { method: "POST", body, headers: { "content-type": "application/json" } });
  const notes = path.join(folder, "gsv", "servers");
  const isNoted = async () => {
    const files = (await readdir(notes)).filter((name) => name.endsWith(".json"));
    const texts = await Promise.all(files.map((name) => readFile(path.join(notes, name), "utf8")));
    return texts.some((text) => text.includes('"arena"'));
  };
  while (!(await isNoted())) await new Promise(setImmediate);
  await doomed.kill();
  const next = await startServe(serve);
  try {
    await page.goto(`${next.url}join.html`);
    await page.getByText(/^arena on doomed \(process \d+\) was lost at about 0\.0 s/).waitFor();
    await keepPicture(page, "lost");
    await page.getByRole("button", { name: "Dismiss arena" }).click();
    await page.locator(".lost").waitFor({ state: "detached" });
    await instance("doomed · this one").waitFor();
  } finally {
    await next.stop();
    await rm(folder, { recursive: true, force: true });
  }
});
