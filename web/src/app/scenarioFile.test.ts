import { expect, test } from "vitest";
import { EMPTY_SCENARIO } from "../api/scenario";
import { readScenario, scenarioFile, scenarioFileName } from "./scenarioFile";

const HOUSE = { ...EMPTY_SCENARIO, name: "two rooms", world: "office", record: true };

// Response is used, because jsdom's Blob has no text().
const textOf = (blob: Blob) => new Response(blob).text();

test("a recording is saved with a name for gsv run, and loaded as a choice", async () => {
  const text = await textOf(scenarioFile(HOUSE));
  expect(JSON.parse(text).record).toBe("two rooms.mcap");
  const file = { name: scenarioFileName(HOUSE), size: text.length, text: async () => text };
  expect(file.name).toBe("two rooms.yaml");
  expect((await readScenario(file)).scenario).toEqual(HOUSE);
});

test("a scenario without recording does not mention it", async () => {
  const text = await textOf(scenarioFile({ ...HOUSE, record: false }));
  expect(JSON.parse(text)).toEqual({ name: "two rooms", world: "office" });
});
