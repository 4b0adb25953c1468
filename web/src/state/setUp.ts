// The state of a set-up: the present scenario, its former versions, and its problems.
import type { Behaviours, ModelChoice } from "../api/SetUpApi";
import type { Ros2Support } from "../api/ros2";
import type { RobotList, Scenario } from "../api/scenario";

// An error in the form for a new simulation.
export interface Wrong {
  // the server's name of the field, such as "robots[1].model"; empty if the error concerns no field
  field: string;
  sentence: string;
}

// The worlds, models and behaviours that can be chosen.
export interface Choices {
  worlds: string[];
  models: ModelChoice[];
  behaviours: Behaviours | null; // null if unknown
  ros2: Ros2Support | null; // null if unknown
}

// A world from the user's machine.
export interface UploadedWorld {
  name: string; // its path among the uploaded files
  path: string; // its path on the server's machine
}

// The state of the form for a new simulation.
export interface SetUp extends Choices {
  uploaded: UploadedWorld[]; // the newest is first
  scenario: Scenario;
  past: Scenario[]; // the newest is last
  future: Scenario[];
  wrong: Wrong | null;
  warnings: string[]; // parts of the files that could not be read
  poses: Float64Array | null; // poses of the scene that is shown; null if unknown
  isBusy: boolean; // whether a request is pending
  // true while nothing can be created, because data is being loaded or the simulation is being
  // created
  isHeld: boolean;
}

// Returns the server's sentence. The paths of uploaded files are replaced by the names that the
// user knows.
export function inTheirWords(sentence: string, uploaded: readonly UploadedWorld[]): string {
  const folders = uploaded.filter(({ name, path }) => path.endsWith(name)).map(({ name, path }) => path.slice(0, -name.length));
  return folders.reduce((said, folder) => (folder === "" ? said : said.replaceAll(folder, "")), sentence);
}

const MOST_PAST = 100;

export function changed(setUp: SetUp, scenario: Scenario): SetUp {
  return { ...setUp, scenario, past: [...setUp.past, setUp.scenario].slice(-MOST_PAST), future: [] };
}

export function undone(setUp: SetUp): SetUp {
  const scenario = setUp.past.at(-1);
  if (!scenario) return setUp;
  return { ...setUp, scenario, past: setUp.past.slice(0, -1), future: [...setUp.future, setUp.scenario] };
}

export function redone(setUp: SetUp): SetUp {
  const scenario = setUp.future.at(-1);
  if (!scenario) return setUp;
  return { ...setUp, scenario, past: [...setUp.past, setUp.scenario], future: setUp.future.slice(0, -1) };
}

const ROBOT_FIELD = /^(robots|avatars)\[(\d+)\](?:\.(\w+))?$/;
// The fields that have their own input in a robot's row.
const ROBOT_INPUTS = ["name", "model", "behaviour", "behaviour_constraint", "drive", "x", "y", "yaw"];

// Returns the robot and the input to which a field belongs; null if the field belongs to no robot.
export function robotOfField(field: string): { list: RobotList; index: number; input: string } | null {
  const [, list, index, input = ""] = ROBOT_FIELD.exec(field) ?? [];
  if (!list) return null;
  return {
    list: list as RobotList,
    index: Number(index),
    input: ROBOT_INPUTS.includes(input) ? input : "",
  };
}

const PEDESTRIANS_FIELD = /^pedestrians\[(\d+)\](?:\.(\w+))?/;

// Returns the group of pedestrians and the input to which a field belongs; null if it belongs to no
// group.
export function pedestriansOfField(field: string): { index: number; input: string } | null {
  const found = PEDESTRIANS_FIELD.exec(field);
  return found && { index: Number(found[1]), input: found[2] ?? "" };
}
