// A simulation that is being set up: its world, its robots and its options, in metres, radians and
// seconds. It is sent to the server as JSON. This JSON is also a valid scenario file
// (docs/formats/scenario.md), because each JSON text is YAML.
import type { JsonObject } from "./json";
import { listAt, numberOr, objectAt, textOr } from "./json";
import type { PedestrianSetUp } from "./pedestrians";
import { parsePedestrians, pedestriansJson } from "./pedestrians";
import type { Ros2SetUp } from "./ros2";
import { parseRos2, ros2Json } from "./ros2";

// The start pose of a robot on the floor: metres, and yaw in radians.
export interface Placed {
  x: number;
  y: number;
  yaw: number;
}

// A robot or avatar of a simulation that is being set up.
export interface RobotSetUp {
  name: string;
  model: string;
  place: Placed | null; // if null: the first free place
  behaviour: string; // name of the behaviour's offer; empty for none
  constraint: string; // used instead of `behaviour`: a constraint that selects an offer at the broker
  movement: "" | "planar" | "rigid"; // if empty: the movement of the model
  drive: string; // KIND[,KEY=VALUE]…; if empty: the model's drive, or a guessed drive if the model has none
  namespace?: string; // namespace of the robot's ROS 2 topics; if empty: the robot's name
}

export type RobotList = "robots" | "avatars";

export interface Scenario {
  name: string; // if empty: the server chooses a name
  world: string;
  mode: "real_time" | "lockstep";
  real_time_factor: number; // 0 means the factor of the world file
  step: number; // 0 means the world's own step
  duration: number; // 0 means until the simulation is stopped
  seed: number;
  record: boolean;
  robots: RobotSetUp[];
  avatars: RobotSetUp[];
  pedestrians: PedestrianSetUp[];
  ros2: Ros2SetUp | null; // null if the simulation is not published to ROS 2 nodes
}

const FORMER_FACTOR = "factor"; // the former name of real_time_factor in scenario files

export const EMPTY_SCENARIO: Scenario = {
  name: "",
  world: "",
  mode: "real_time",
  real_time_factor: 0,
  step: 0,
  duration: 0,
  seed: 0,
  record: false,
  robots: [],
  avatars: [],
  pedestrians: [],
  ros2: null,
};

export function newRobot(scenario: Scenario, model: string): RobotSetUp {
  const name = freeName(scenario, model);
  return { name, model, place: null, behaviour: "", constraint: "", movement: "", drive: "", namespace: "" };
}

// Returns the model's name (the last part of a path). If this name is in use, a number is appended.
export function freeName(scenario: Scenario, model: string): string {
  const name = model.split("/").filter(Boolean).at(-1)?.replace(/\.\w+$/, "") || "robot";
  const taken = new Set([...scenario.robots, ...scenario.avatars].map((robot) => robot.name));
  if (!taken.has(name)) return name;
  let number = 2;
  while (taken.has(`${name}_${number}`)) number += 1;
  return `${name}_${number}`;
}

export function withRobot(scenario: Scenario, list: RobotList, robot: RobotSetUp): Scenario {
  return { ...scenario, [list]: [...scenario[list], robot] };
}

export function withoutRobot(scenario: Scenario, list: RobotList, index: number): Scenario {
  return { ...scenario, [list]: scenario[list].filter((_, i) => i !== index) };
}

export function withChangedRobot(
  scenario: Scenario,
  list: RobotList,
  index: number,
  change: Partial<RobotSetUp>,
): Scenario {
  return {
    ...scenario,
    [list]: scenario[list].map((robot, i) => (i === index ? { ...robot, ...change } : robot)),
  };
}

// Returns the list that contains the robot with this name, and its index there. Returns null if
// there is no such robot.
export function findRobot(scenario: Scenario, name: string): { list: RobotList; index: number } | null {
  for (const list of ["robots", "avatars"] as const) {
    const index = scenario[list].findIndex((robot) => robot.name === name);
    if (index >= 0) return { list, index };
  }
  return null;
}

// Returns the scenario as JSON, without values that equal the defaults.
export function scenarioJson(scenario: Scenario): JsonObject {
  const { robots, avatars, pedestrians, ros2, ...rest } = scenario;
  const json: JsonObject = {};
  for (const [key, value] of Object.entries(rest)) {
    if (key === "world" || value !== EMPTY_SCENARIO[key as keyof Scenario]) json[key] = value;
  }
  if (robots.length > 0) json.robots = robots.map(robotJson);
  if (avatars.length > 0) json.avatars = avatars.map(robotJson);
  if (pedestrians.length > 0) json.pedestrians = pedestrians.map(pedestriansJson);
  if (ros2) json.ros2 = ros2Json(ros2, robots);
  return json;
}

export function robotJson(robot: RobotSetUp): JsonObject {
  const { name, model, place, behaviour, constraint, movement, drive } = robot;
  return {
    ...(name && { name }),
    ...(model && { model }),
    ...place,
    ...(behaviour && { behaviour }),
    ...(constraint && { behaviour_constraint: constraint }),
    ...(movement && { movement }),
    ...(drive && { drive }),
  };
}

// Parses a scenario. If `value` is not a scenario, throws an error that names the wrong key. `left`
// lists the keys that the page does not know; they are ignored.
export function parseScenario(value: unknown): { scenario: Scenario; left: string[] } {
  const json = objectAt(value, "the file");
  const { ros2, robots } = parseRos2(json.ros2, parseRobots(json.robots, "robots"));
  const scenario: Scenario = {
    name: textOr(json.name, ""),
    world: textOr(json.world, ""),
    mode: json.mode === "lockstep" ? "lockstep" : "real_time",
    real_time_factor: numberOr(json.real_time_factor ?? json[FORMER_FACTOR], 0),
    step: numberOr(json.step, 0),
    duration: numberOr(json.duration, 0),
    seed: numberOr(json.seed, 0),
    record: json.record !== undefined && json.record !== null && json.record !== false,
    robots,
    avatars: parseRobots(json.avatars, "avatars"),
    pedestrians: parsePedestrians(json.pedestrians),
    ros2,
  };
  return { scenario, left: Object.keys(json).filter((key) => !(key in scenario) && key !== FORMER_FACTOR) };
}

function parseRobots(value: unknown, where: RobotList): RobotSetUp[] {
  return listAt(value ?? [], where).map((each, i) => {
    const robot = objectAt(each, `${where}[${i}]`);
    const isPlaced = typeof robot.x === "number" && typeof robot.y === "number";
    const movement = robot.movement;
    return {
      name: textOr(robot.name, ""),
      model: textOr(robot.model, ""),
      place: isPlaced
        ? { x: numberOr(robot.x, 0), y: numberOr(robot.y, 0), yaw: numberOr(robot.yaw, 0) }
        : null,
      behaviour: textOr(robot.behaviour, ""),
      constraint: textOr(robot.behaviour_constraint, ""),
      movement: movement === "planar" || movement === "rigid" ? movement : "",
      drive: textOr(robot.drive, ""),
      namespace: "",
    };
  });
}
