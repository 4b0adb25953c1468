import { expect, test } from "vitest";
import { parseCommands } from "./commands";

test("commands are read with their parameters' types, units, ranges and defaults", () => {
  const z = { name: "z", type: "number", unit: "m/s²", summary: "upwards", required: false, minimum: -100, maximum: 100 };
  const json = [{ name: "set_gravity", summary: "Set gravity", parameters: [{ ...z, default_meaning: "the world's" }] }];
  expect(parseCommands(json)).toEqual([
    {
      name: "set_gravity",
      summary: "Set gravity",
      parameters: [
        {
          name: "z",
          type: "number",
          unit: "m/s²",
          summary: "upwards",
          isRequired: false,
          minimum: -100,
          maximum: 100,
          otherwise: "the world's",
        },
      ],
    },
  ]);
  const count = { name: "count", type: "integer", default: 1 };
  expect(parseCommands([{ name: "step", parameters: [count] }])[0]!.parameters[0]).toMatchObject({
    minimum: -Infinity,
    maximum: Infinity,
    otherwise: "1",
    unit: "",
  });
});

test("an invalid description is rejected", () => {
  expect(() => parseCommands({})).toThrow("commands: expected a list, found an object");
  expect(() => parseCommands([{ name: "a", parameters: [{ name: "b", type: "vector" }] }])).toThrow("does not know");
});
