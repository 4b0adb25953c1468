// Scenario files: the page saves JSON, which is also YAML, and loads any YAML. The YAML reader is
// fetched when it is first needed.
import type { Scenario } from "../api/scenario";
import { parseScenario, scenarioJson } from "../api/scenario";

export type TextFile = Pick<File, "name" | "size" | "text">;

const LARGEST_BYTES = 1_000_000;

export function scenarioFileName(scenario: Scenario): string {
  return `${titleOf(scenario)}.yaml`;
}

// In a scenario for the server, `record` may be true, and the server then chooses a name. In a file
// for `gsv run`, `record` must be a name.
export function scenarioFile(scenario: Scenario): Blob {
  const json = scenarioJson(scenario);
  if (scenario.record) json.record = `${titleOf(scenario)}.mcap`;
  return new Blob([`${JSON.stringify(json, null, 2)}\n`], { type: "application/yaml" });
}

function titleOf({ name, world }: Scenario): string {
  const title = name || world.split("/").at(-1) || "simulation";
  return title.replace(/[^\p{L}\p{N} _.-]+/gu, "_").slice(0, 80);
}

// Reads a scenario file. If the file is not a scenario, throws an error with a text for the user.
export async function readScenario(file: TextFile): Promise<ReturnType<typeof parseScenario>> {
  try {
    if (file.size > LARGEST_BYTES) throw new Error("a scenario file must not be larger than 1 MB");
    return await parseScenarioText(await file.text());
  } catch (error) {
    const reason = (error as Error).message.split("\n")[0];
    throw new Error(`${file.name} cannot be read as a scenario: ${reason}`);
  }
}

// Parses the text of a scenario, in YAML or JSON. If it is not a scenario, throws an error.
export async function parseScenarioText(text: string): Promise<ReturnType<typeof parseScenario>> {
  return parseScenario(await parse(text));
}

async function parse(text: string): Promise<unknown> {
  try {
    return JSON.parse(text);
  } catch {
    const { parse } = await import("yaml");
    return parse(text);
  }
}
