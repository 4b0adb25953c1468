// The settings for publishing a simulation to ROS 2 nodes: the key `ros2` of a scenario
// (docs/formats/scenario.md).
import type { JsonObject } from "./json";
import { objectAt, textOr } from "./json";

// The ROS 2 settings of a simulation that is being set up.
export interface Ros2SetUp {
  cmd_vel: string; // message type of cmd_vel; empty for the server's default
  // ROS 2 distribution of the nodes that communicate with gsv; empty for the server's default.
  distro: string;
  range: string; // discovery range; empty for the server's default
  others: Record<string, string>; // namespaces of robots that the scenario does not list
}

// Whether the server can publish new simulations in ROS 2.
export interface Ros2Support {
  isAvailable: boolean;
  reason: string; // why the server cannot publish
  reach: string; // the ROS 2 domain, and which machines it reaches
  published: string; // the simulation that is published now; empty if there is none
}

export const PLAIN_ROS2: Ros2SetUp = { cmd_vel: "", distro: "", range: "", others: {} };

interface Named {
  name: string;
  model: string;
  namespace?: string; // if empty: the robot's name
}

// Returns the settings as JSON, without settings that equal the defaults.
export function ros2Json({ others, ...settings }: Ros2SetUp, robots: readonly Named[]): JsonObject | true {
  const chosen = robots.flatMap((robot) => (robot.namespace ? [[nameOf(robot), robot.namespace] as const] : []));
  const namespaces = { ...others, ...Object.fromEntries(chosen) };
  const json: JsonObject = Object.fromEntries(Object.entries(settings).filter(([, value]) => value !== ""));
  if (Object.keys(namespaces).length > 0) json.namespaces = namespaces;
  return Object.keys(json).length > 0 ? json : true;
}

// Returns the settings, and the robots with their namespaces.
export function parseRos2<Robot extends Named>(value: unknown, robots: Robot[]): { ros2: Ros2SetUp | null; robots: Robot[] } {
  if (value === undefined || value === null || value === false) return { ros2: null, robots };
  if (value === true) return { ros2: PLAIN_ROS2, robots };
  const json = objectAt(value, "ros2");
  const given = Object.entries(objectAt(json.namespaces ?? {}, "ros2.namespaces"));
  const namespaces = new Map(given.map(([robot, namespace]) => [robot, textOr(namespace, "")]));
  const named = robots.map((robot) => ({ ...robot, namespace: namespaces.get(nameOf(robot)) ?? "" }));
  for (const robot of robots) namespaces.delete(nameOf(robot));
  const settings = { cmd_vel: textOr(json.cmd_vel, ""), distro: textOr(json.distro, ""), range: textOr(json.range, "") };
  return { ros2: { ...settings, others: Object.fromEntries(namespaces) }, robots: named };
}

export function parseRos2Support(value: unknown): Ros2Support {
  const json = objectAt(value, "ros2");
  return {
    isAvailable: json.available === true,
    reason: textOr(json.reason, ""),
    reach: textOr(json.reach, ""),
    published: textOr(json.published, ""),
  };
}

function nameOf({ name, model }: Named): string {
  return name || model;
}
