// The movement and the drive that were chosen for robots. Neither the scene nor the status contains
// them, so they are read from the scenario of the saved world.
import type { SetUpApi } from "../api/SetUpApi";
import type { RobotSetUp } from "../api/scenario";
import { parseScenarioText } from "./scenarioFile";

export type RobotChoice = Pick<RobotSetUp, "movement" | "drive">;

// The choices by robot. A robot without an entry has the movement and the drive of its model.
export type RobotChoices = ReadonlyMap<string, RobotChoice>;

// Reads the choices of all robots of the simulation. Does not include avatars, which have no
// choices. Throws an error if the server cannot save the world.
export async function readRobotChoices(api: Pick<SetUpApi, "saveWorld">, simulation: string): Promise<RobotChoices> {
  const saved = await api.saveWorld(simulation, `${simulation}.sdf`);
  const { scenario } = await parseScenarioText(saved.scenario);
  return new Map(scenario.robots.map(({ name, movement, drive }) => [name, { movement, drive }]));
}
