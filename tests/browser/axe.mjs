// Runs axe-core on a page of the viewer.
import assert from "node:assert/strict";
import fs from "node:fs";
import { requireFromWeb } from "./browser.mjs";

const AXE = fs.readFileSync(requireFromWeb.resolve("axe-core/axe.min.js"), "utf8");

// Returns the problems that axe-core finds, one per line.
export async function faultsOf(page) {
  await page.evaluate(AXE); // not restricted by the page's Content-Security-Policy
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return violations.flatMap(({ id, nodes }) =>
    nodes.map(
      ({ target, failureSummary }) => `${id} at ${target}: ${failureSummary.replaceAll(/\s+/g, " ")}`,
    ),
  );
}

// Checks that axe-core finds no problem in light and in dark colours.
export async function judge(page) {
  const found = {};
  for (const colorScheme of ["dark", "light"]) {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    found[colorScheme] = await faultsOf(page);
  }
  assert.deepEqual(found, { dark: [], light: [] });
}
