// Takes a screenshot of a viewer, as for the documentation.
//
//   node screenshot.mjs URL FILE.png [--size 1280x800] [--view default|top|robot] [--select ROBOT]
//                       [--theme light|dark] [--after SIMULATED_SECONDS] [--only-view]
//
// --view robot follows the selected robot (or the first). --after waits until the simulated time is
// at least SIMULATED_SECONDS. --only-view omits the panels around the 3D view.
import process from "node:process";
import { parseArgs } from "node:util";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";

const LONGEST_WAIT_MS = 120_000;

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    size: { type: "string", default: "1280x800" },
    view: { type: "string", default: "default" },
    select: { type: "string" },
    theme: { type: "string", default: "light" },
    after: { type: "string", default: "0" },
    "only-view": { type: "boolean", default: false },
  },
});
const [url, file] = positionals;
const [width, height] = values.size.split("x").map(Number);
if (!url || !file || !(width > 0 && height > 0) || !["default", "top", "robot"].includes(values.view)) {
  console.error(
    "usage: screenshot.mjs URL FILE.png [--size WxH] [--view default|top|robot] [--select ROBOT] [--theme light|dark] [--after SIMULATED_SECONDS] [--only-view]",
  );
  process.exit(2);
}

const address = new URL(url);
address.searchParams.set("quality", "high");
const browser = await openBrowser({ width, height, colorScheme: values.theme });
try {
  const { page } = await openPage(browser, address.href);
  await waitUntilDrawn(page, LONGEST_WAIT_MS);
  if (values.select) await page.locator(`[data-robot="${values.select}"]`).dispatchEvent("click");
  if (values.view === "top") await page.keyboard.press("t");
  if (values.view === "robot") await page.keyboard.press("f");
  await page.waitForFunction((after) => window.gsv.time >= after, Number(values.after), {
    timeout: LONGEST_WAIT_MS,
  });
  const frames = await page.evaluate(() => window.gsv.frames);
  await page.waitForFunction(
    (then) => window.gsv.frames > then + 3 || window.gsv.phase !== "running",
    frames,
  );
  const target = values["only-view"] ? page.locator(".view") : page;
  await target.screenshot({ path: file });
} finally {
  await browser.close();
}
