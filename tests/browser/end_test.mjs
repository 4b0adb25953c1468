// Tests a run that ends by itself, and a recording that the command line requested.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";

let folder;
let file;
let server;
let browser;
let page;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-end-"));
  file = path.join(folder, "end.mcap");
  const robots = ["--robot", "pebble@0,0", "--robot", "pebble@1,1", "--behaviour", "wander", "--in-process"];
  server = await startServer(["playground", ...robots, "--duration", "30", "--record", file]);
  browser = await openBrowser({ width: 1280, height: 800 });
  ({ page } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

test("one click does not end a recording that the command line requested", async () => {
  const record = page.getByRole("button", { name: "Record", exact: true });
  await page.locator('button.record[aria-pressed="true"]').waitFor();
  await record.click();
  const question = page.getByRole("alertdialog", { name: "End the recording?" });
  await question.getByText(file).waitFor();
  await question.getByRole("button", { name: "Continue recording" }).click();
  await question.waitFor({ state: "hidden" });
  assert.equal(await record.getAttribute("aria-pressed"), "true");
});

test("an ended run shows a summary with its replay, not a lost connection", async () => {
  const card = page.locator('.overlay[data-situation="ended"]');
  await card.getByRole("heading", { name: "Finished" }).waitFor();
  await card.getByText("2 robots · 0:30.00 simulated").waitFor();
  await page.getByText("Server ended").waitFor();
  await card.getByText(`gsv replay ${file}`).waitFor();
  assert.equal(await page.getByText("Connection lost").count(), 0);
  assert.ok(fs.statSync(file).size > 0);
  await card.getByRole("button", { name: "Show the view" }).click();
  await card.waitFor({ state: "hidden" });
});
