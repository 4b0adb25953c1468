// The robots of a simulation as they are listed: status, kind and health.
import { robotsOf } from "../api/scene";
import type { SceneDescription } from "../api/scene";
import type { RobotStatus } from "../api/status";
import type { Health } from "./health";
import { stateOf } from "./health";
import type { ListedRobot, RobotKind } from "./robotList";
import type { State } from "./State";

export function listedRobots({ status, health, scene }: State): readonly ListedRobot[] {
  const robots = status?.robots;
  const isKnown = latest.robots === robots && latest.health === health && latest.scene === scene;
  if (!isKnown) latest = { robots, health, scene, listed: listed(robots ?? [], health, scene) };
  return latest.listed;
}

// Cached, because several parts of the page need it after each change.
let latest: {
  robots: readonly RobotStatus[] | undefined;
  health: Health | null;
  scene: SceneDescription | null;
  listed: readonly ListedRobot[];
} = { robots: undefined, health: null, scene: null, listed: [] };

function listed(robots: readonly RobotStatus[], health: Health | null, scene: SceneDescription | null): ListedRobot[] {
  const kinds = kindsOf(scene);
  return robots.map((robot) => {
    const kind = kinds.get(robot.name) ?? "robot";
    const state = stateOf(health, robot);
    return {
      status: robot,
      kind,
      state: kind === "station" && state === "moving" ? "unknown" : state, // a station has no drive
      health: health?.robots.get(robot.name) ?? null,
    };
  });
}

const knownKinds = new WeakMap<SceneDescription, Map<string, RobotKind>>();

// Returns the kinds of avatars and stations, by name. All other bodies in the list are robots.
function kindsOf(scene: SceneDescription | null): ReadonlyMap<string, RobotKind> {
  if (!scene) return new Map();
  let kinds = knownKinds.get(scene);
  if (!kinds) {
    kinds = new Map();
    for (const { name, isAvatar, isStation } of robotsOf(scene)) {
      if (isAvatar || isStation) kinds.set(name, isAvatar ? "avatar" : "station");
    }
    knownKinds.set(scene, kinds);
  }
  return kinds;
}
