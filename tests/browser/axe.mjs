// Runs axe-core on a page of the viewer.
import assert from "node:assert/strict";
import fs from "node:fs";
import { requireFromWeb } from "./browser.mjs";

const AXE = fs.readFileSync(requireFromWeb.resolve("axe-core/axe.min.js"), "utf8");

const RULES_OF_COLOURS = ["color-contrast", "link-in-text-block"];

// Returns the problems that axe-core finds with these rules (default: all), one per line.
export async function faultsOf(page, rules = null) {
  await page.evaluate(AXE); // not restricted by the page's Content-Security-Policy
  const { violations } = await page.evaluate(
    (runOnly) => window.axe.run(document, { resultTypes: ["violations"], ...(runOnly && { runOnly }) }),
    rules,
  );
  return violations.flatMap(({ id, nodes }) =>
    nodes.map(
      ({ target, failureSummary }) => `${id} at ${target}: ${failureSummary.replaceAll(/\s+/g, " ")}`,
    ),
  );
}

// Checks that axe-core finds no problem in light colours, and none with colours in dark ones.
export async function judge(page) {
  const found = {};
  for (const [colorScheme, rules] of [
    ["dark", RULES_OF_COLOURS],
    ["light", null],
  ]) {
    await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
    found[colorScheme] = await faultsOf(page, rules);
  }
  assert.deepEqual(found, { dark: [], light: [] });
}
