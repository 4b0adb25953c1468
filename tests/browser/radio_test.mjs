// Tests robots that communicate by radio, as in the tutorial on swarms. The page draws a line
// between the sender and each receiver of a message.
import assert from "node:assert/strict";
import path from "node:path";
import process from "node:process";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { until, viewClip } from "./viewing.mjs";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
process.env.PYTHONPATH = path.join(process.env.GSV_BUILD_DIR ?? "", "python");
process.env.PATH = `${path.join(root, "examples/tutorial")}:${process.env.PATH}`;

let server;
let browser;
let page;
let faults;

before(async () => {
  const places = ["-4,-4", "4,-4", "-4,4", "0,-4", "-4,0"];
  const robots = places.flatMap((place) => ["--robot", `pebble@${place}`]);
  server = await startServer(["playground", ...robots, "--behaviour", "gather"]);
  browser = await openBrowser({ width: 1024, height: 680 });
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
  await page.keyboard.press("t");
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

// The colour of a link, blended with the background where the line is thin.
function violetPixels({ data }) {
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    const [r, g, b] = data.subarray(i, i + 3);
    if (b > 150 && b > r + 50 && r > g + 20) count += 1;
  }
  return count;
}

const seen = async () => violetPixels(await picture(page, await viewClip(page)));

test("a line connects a sender with each receiver while the overlay is on", async () => {
  await until(async () => (await seen()) > 100, "the links between robots");
  await keepPicture(page, "radio");
  await page.keyboard.press("-");
  await until(async () => (await seen()) < 5, "a picture without them");
  await page.keyboard.press("-");
  await until(async () => (await seen()) > 100, "the links again");
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
