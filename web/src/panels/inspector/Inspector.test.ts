// @vitest-environment jsdom
import { expect, test } from "vitest";
import type { SimulationStatus } from "../../api/status";
import { testPorts } from "../contract/testPorts";
import { createInspector } from "./Inspector";

function statusOf(agentPhase: string): SimulationStatus {
  const robot = { name: "a", behaviour: "wander", agentPhase, collisions: 0, distance: 0, detail: "", model: "" };
  return { robots: [robot] } as unknown as SimulationStatus;
}

test("the output of a dead behaviour stands directly below the reason of its death", () => {
  const { ports, store } = testPorts({ status: statusOf("running"), selection: "a" });
  const inspector = createInspector(ports);
  const above = () => inspector.querySelector(".output")!.previousElementSibling!.className;
  expect(above()).toBe("detail");
  store.set({ status: statusOf("dead") });
  expect(above()).toBe("why");
  store.set({ status: statusOf("running") });
  expect(above()).toBe("detail");
});
