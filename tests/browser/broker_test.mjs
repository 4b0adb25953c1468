// Tests the broker page in a real browser, with the broker of a real simulation.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { gsv, startServer } from "./server.mjs";

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(["office", "--robot", "b21r@-5,-1.5,0", "--behaviour", "wander"]);
  browser = await openBrowser({ width: 1024, height: 680 });
  ({ page, faults } = await openPage(browser, `${server.url}broker.html`));
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

async function find(constraint) {
  await page.getByLabel("Constraint").fill(constraint);
  await page.getByRole("button", { name: "Find" }).click();
}

async function choose(type) {
  await page.locator(`[data-type="${type}"]`).click();
  await page.getByRole("heading", { name: type, exact: true }).waitFor();
}

test("the types and offers of the running simulation are shown", async () => {
  await choose("gsv::SimulationService");
  await page.getByText("1 offer", { exact: true }).waitFor();
  assert.match(await page.locator(".offer .properties").innerText(), /viewer_url/);
});

test("a constraint shows the matching offers", async () => {
  await choose("gsv::SimulationService");
  await find("cores >= 1 and exist viewer_url");
  await page.getByText("1 of 1 offer matches", { exact: true }).waitFor();
  assert.equal(await page.locator(".term[data-result='true']").count(), 2);
});

test("a constraint that does not match shows the failed term", async () => {
  await choose("gsv::SimulationService");
  await find("cores >= 1 and pid < 0 and wings == 2");
  await page.getByText("0 of 1 offer matches", { exact: true }).waitFor();
  assert.match(await page.locator(".term[data-result='false']").innerText(), /pid < 0/);
  assert.match(await page.locator(".term[data-result='no value']").innerText(), /the offer has no property wings/);
  await keepPicture(page, "broker");
});

test("an invalid constraint shows the broker's sentence", async () => {
  await find("cores >= ");
  assert.match(await page.getByRole("alert").innerText(), /cores/);
  faults.splice(0, faults.length, ...faults.filter((fault) => !/status of 400/.test(fault)));
});

test("links are shown with their state", async () => {
  const { broker } = await (await fetch(`${server.url}api/broker/types`)).json();
  const links = (...words) => gsv(["links", ...words, "--broker", broker]);
  await links("add", "itself", broker);
  await page.reload();
  await page.locator(".link[data-answers='true']", { hasText: "itself" }).waitFor();
  await links("remove", "itself");
});

test("the viewer links to it and back, and there were no script errors", async () => {
  await page.getByTitle("The simulation").click();
  await waitUntilDrawn(page); // a page that is left while it loads reports errors about missing data
  await page.getByRole("link", { name: "Broker", exact: true }).click();
  await page.getByRole("heading", { name: "Broker", exact: true }).waitFor();
  assert.deepEqual(faults, []);
});
