// The commands of a simulation, as the server describes them (GET …/commands in docs/api.yaml).
import { listAt, numberOr, objectAt, textAt, textOr } from "./json";

export type CommandValue = number | boolean | string;
export type CommandArguments = Record<string, CommandValue>;

const TYPES = ["number", "integer", "flag", "text"] as const;

// A parameter of a command: its type, unit, range and default.
export interface CommandParameter {
  name: string;
  type: (typeof TYPES)[number];
  unit: string; // empty: none
  summary: string;
  isRequired: boolean;
  minimum: number; // infinite if there is no bound
  maximum: number;
  // The default as a text. If there is no default, describes what an absent argument means. Empty
  // if the server gives neither.
  otherwise: string;
}

// A command with its parameters.
export interface CommandDescription {
  name: string;
  summary: string;
  parameters: CommandParameter[];
}

export function parseCommands(json: unknown): CommandDescription[] {
  return listAt(json, "commands").map((each, i) => {
    const where = `commands[${i}]`;
    const command = objectAt(each, where);
    return {
      name: textAt(command.name, `${where}.name`),
      summary: textOr(command.summary, ""),
      parameters: listAt(command.parameters, `${where}.parameters`).map((parameter) =>
        parseParameter(parameter, `${where}.parameters`),
      ),
    };
  });
}

function parseParameter(json: unknown, where: string): CommandParameter {
  const parameter = objectAt(json, where);
  const name = textAt(parameter.name, `${where}.name`);
  const type = TYPES.find((each) => each === parameter.type);
  if (type === undefined) throw new Error(`${where}: "${name}" has a type that this page does not know`);
  return {
    name,
    type,
    unit: textOr(parameter.unit, ""),
    summary: textOr(parameter.summary, ""),
    isRequired: parameter.required === true,
    minimum: numberOr(parameter.minimum, -Infinity),
    maximum: numberOr(parameter.maximum, Infinity),
    otherwise: parameter.default === undefined ? textOr(parameter.default_meaning, "") : String(parameter.default),
  };
}
