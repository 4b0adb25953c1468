// @vitest-environment jsdom
import { expect, test } from "vitest";
import type { SimulationStatus } from "../../api/status";
import { body, scene } from "../../scene/testScene";
import { testPorts } from "../contract/testPorts";
import { createSceneTree } from "./SceneTree";

function robot(name: string, behaviour = "") {
  const agentPhase = behaviour ? "running" : "none";
  return { name, model: name, behaviour, agentPhase, detail: "", distance: 1.5, collisions: 0 };
}

test("a station is listed as one, and counted apart from the robots", () => {
  const robots = [robot("cart", "wander"), robot("post"), robot("tower", "watch")];
  const stations = ["post", "tower"].map((name) => body(name, { isRobot: false, isStation: true }));
  const { ports } = testPorts({
    scene: scene({ bodies: [body("cart"), ...stations] }),
    status: { robots } as unknown as SimulationStatus,
  });
  const tree = createSceneTree(ports, document.createElement("div"));
  expect(tree.querySelector("h2")!.textContent).toBe("1 robot, 2 stations");
  const rows = [...tree.querySelectorAll(".robot")].map((row) => row.querySelector(".robot-behaviour")!.textContent);
  expect(rows).toEqual(["wander · running", "station", "station · watch · running"]);
});

test("without stations only robots are counted", () => {
  const { ports } = testPorts({
    scene: scene({ bodies: [body("cart")] }),
    status: { robots: [robot("cart", "wander")] } as unknown as SimulationStatus,
  });
  expect(createSceneTree(ports, document.createElement("div")).querySelector("h2")!.textContent).toBe("1 robot");
});
