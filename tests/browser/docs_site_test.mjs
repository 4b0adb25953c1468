// Tests the documentation site on the real server: the help sheet opens it, its search works, and
// no page contacts another host. Skipped if the site was not built because mkdocs is missing.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";

let server;
let browser;
let isBuilt = false;

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@0,0"]);
  isBuilt = (await fetch(`${server.url}docs/`)).ok;
  browser = await openBrowser();
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

function testOfSite(name, body) {
  test(name, async (context) => (isBuilt ? body() : context.skip("the site is not built: install mkdocs and doxygen")));
}

testOfSite("the help sheet opens the site beside the viewer", async () => {
  const { page, faults } = await openPage(browser, server.url);
  await waitUntilDrawn(page);
  await page.keyboard.press("?");
  const [opened] = await Promise.all([
    browser.context.waitForEvent("page"),
    page.getByRole("link", { name: "Open documentation" }).click(),
  ]);
  await opened.getByRole("heading", { name: "GSV", level: 1 }).waitFor();
  assert.equal(new URL(opened.url()).pathname, "/docs/");
  assert.deepEqual(faults, []);
  await opened.close();
  await page.close();
});

testOfSite("the search finds a page, which opens", async () => {
  const { page, faults } = await openPage(browser, `${server.url}docs/`);
  await page.bringToFront(); // a page in the background draws no frames
  await page.getByPlaceholder("Search").fill("sonar");
  const results = page.locator(".md-search-result__item a");
  await results.first().waitFor();
  assert.ok((await results.count()) > 1);
  await results.first().click();
  await page.waitForURL((url) => url.pathname !== "/docs/");
  await page.locator("h1").first().waitFor();
  assert.deepEqual(faults, []);
  await page.close();
});

testOfSite("the C++ reference is linked, and its search finds a class", async () => {
  const { page, faults } = await openPage(browser, `${server.url}docs/reference.html`);
  await page.getByRole("link", { name: "C++", exact: true }).click();
  await page.waitForURL(/\/docs\/reference\/cpp\/index\.html$/);
  await page.locator("#MSearchField").pressSequentially("RemoteRobot");
  const results = page.frameLocator("iframe[name=MSearchResults]");
  await results.getByText("RemoteRobot", { exact: true }).first().waitFor();
  // Pages of doxygen declare no icon, so the browser requests /favicon.ico.
  assert.deepEqual(faults.filter((fault) => !fault.includes("/favicon.ico")), []);
  await page.close();
});
