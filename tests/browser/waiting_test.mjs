// Tests that the page shows which behaviour delays a simulation in lockstep.
import assert from "node:assert/strict";
import fs from "node:fs";
import process from "node:process";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { startServer } from "./server.mjs";
import { settled } from "./viewing.mjs";

const SIMULATION = ["playground", "--lockstep", "--robot", "pebble", "--behaviour", "wander", "--deadline", "600"];

let server;
let browser;
let page;

before(async () => {
  server = await startServer(SIMULATION);
  browser = await openBrowser({ width: 1024, height: 680 });
  ({ page } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

// Returns a process that the server has started.
function childCalled(name) {
  const { pid } = server.child;
  const children = fs.readFileSync(`/proc/${pid}/task/${pid}/children`, "utf8").trim().split(" ").map(Number);
  const found = children.find((child) => fs.readFileSync(`/proc/${child}/comm`, "utf8").trim() === name);
  assert.ok(found, `the server has not started ${name}`);
  return found;
}

test("a stopped behaviour is named until it continues", async () => {
  const waiting = page.getByTestId("waiting");
  const behaviour = childCalled("gsv-wander");
  process.kill(behaviour, "SIGSTOP");
  try {
    await page.waitForFunction(() => document.querySelector("[data-testid=waiting]").textContent !== "");
    const sentence = await waiting.textContent();
    assert.match(sentence, new RegExp(`^waiting for pebble \\(wander on .+:${behaviour}\\) since \\d+\\.\\d s$`));
    // The counter continues, although nothing moves.
    await page.waitForFunction(
      (then) => document.querySelector("[data-testid=waiting]").textContent !== then,
      sentence,
    );
    assert.equal(await waiting.isVisible(), true);
    await page.keyboard.press("h");
    const diagnostics = page.getByRole("region", { name: "Diagnostics" });
    await diagnostics.getByText(/running, waits for pebble/).waitFor();
    await diagnostics.getByText("viewers", { exact: true }).waitFor();
    await page.waitForFunction(() => /updates dropped for this page\d/.test(document.querySelector(".diagnostics").textContent));
    await settled(page);
    await keepPicture(page, "diagnostics");
  } finally {
    process.kill(behaviour, "SIGCONT");
  }
  await page.waitForFunction(() => document.querySelector("[data-testid=waiting]").textContent === "");
  await page.getByRole("region", { name: "Diagnostics" }).getByText("1 robot OK.").waitFor();
  const then = await page.evaluate(() => window.gsv.time);
  await page.waitForFunction((time) => window.gsv.time > time, then);
});
