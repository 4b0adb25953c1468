import { expect, test } from "vitest";
import { EMPTY_SCENARIO } from "../api/scenario";
import { readScenario, scenarioFile, scenarioFileName } from "./scenarioFile";

const HOUSE = { ...EMPTY_SCENARIO, name: "two rooms", world: "office", record: true };

// jsdom's Blob has no text().
const textOf = (blob: Blob) => new Response(blob).text();

test("what is to be recorded is saved under a name that gsv run can use, and loaded as a wish", async () => {
  const text = await textOf(scenarioFile(HOUSE));
  expect(JSON.parse(text).record).toBe("two rooms.mcap");
  const file = { name: scenarioFileName(HOUSE), size: text.length, text: async () => text };
  expect(file.name).toBe("two rooms.yaml");
  expect((await readScenario(file)).scenario).toEqual(HOUSE);
});

test("what is not to be recorded says nothing of it", async () => {
  const text = await textOf(scenarioFile({ ...HOUSE, record: false }));
  expect(JSON.parse(text)).toEqual({ name: "two rooms", world: "office" });
});
