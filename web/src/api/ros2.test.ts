import { expect, test } from "vitest";
import { PLAIN_ROS2, parseRos2, ros2Json } from "./ros2";
import { EMPTY_SCENARIO, newRobot, parseScenario, scenarioJson } from "./scenario";

const pebble = { ...newRobot(EMPTY_SCENARIO, "pebble"), namespace: "/fleet/one" };

test("without settings the key is true, and switched off it is omitted", () => {
  expect(scenarioJson({ ...EMPTY_SCENARIO, world: "maze", ros2: PLAIN_ROS2 })).toEqual({ world: "maze", ros2: true });
  expect(scenarioJson({ ...EMPTY_SCENARIO, world: "maze", robots: [pebble] }).ros2).toBeUndefined();
});

test("namespaces are written by the names of their robots", () => {
  const ros2 = { ...PLAIN_ROS2, cmd_vel: "twist_stamped", others: { guard: "/" } };
  const json = { cmd_vel: "twist_stamped", namespaces: { guard: "/", pebble: "/fleet/one" } };
  expect(ros2Json(ros2, [pebble])).toEqual(json);
  expect(parseRos2(json, [{ ...pebble, namespace: "" }])).toEqual({ ros2, robots: [pebble] });
});

test("a saved file is loaded unchanged", () => {
  const scenario = { ...EMPTY_SCENARIO, world: "maze", robots: [pebble], ros2: { ...PLAIN_ROS2, distro: "humble" } };
  expect(parseScenario(JSON.parse(JSON.stringify(scenarioJson(scenario))))).toEqual({ scenario, left: [] });
});
