// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import { simulationStatus } from "../../page/testApp";
import { scene } from "../../scene/testScene";
import { testPorts } from "../contract/testPorts";
import { mount } from "./PhysicsPanel";
import type { StepCost, StepCostsMessage } from "./stepCosts";
import { StepCosts, paceSentence } from "./stepCosts";

function cost(step: number, more: Partial<StepCost> = {}): StepCost {
  return { step: BigInt(step), held_up_by: "", behaviours_s: 0, devices_s: 0, bodies_s: 0, observers_s: 0, idle_s: 0, ...more };
}

function message(steps: number, sum: Partial<StepCost>, more: Partial<StepCostsMessage> = {}): StepCostsMessage {
  return { steps: BigInt(steps), sum: cost(steps, sum), hold_ups: [], longest: [], ...more };
}

const RUNNING = simulationStatus("running", { realTimeFactor: 0.5, targetFactor: 1 });

test("the reason for a slow run is the part that takes most of its computing time", () => {
  const costs = new StepCosts();
  expect(paceSentence(RUNNING, costs)).toBe("No step yet.");
  costs.add(message(10, { bodies_s: 0.9, observers_s: 0.1 }));
  expect(paceSentence(RUNNING, costs)).toBe(
    "The simulation runs at 0.50× real time, not at the target 1.00×. Motion and contacts take 90 % of the time. A larger step, fewer bodies or planar kinematics would be faster.",
  );
  const hold_ups = [{ robot: "a", steps: 4n, total_s: 9, longest_s: 5 }];
  costs.add(message(10, { behaviours_s: 9 }, { hold_ups }));
  expect(paceSentence({ ...RUNNING, mode: "lockstep" }, costs)).toBe(
    "Lockstep: the simulation runs as fast as its steps allow, at 0.50× real time. Behaviours take 90 % of the time, most of all the behaviour of a.",
  );
  expect(paceSentence({ ...RUNNING, realTimeFactor: 1 }, costs)).toBe("The simulation runs at its target speed.");
  const idle = new StepCosts();
  idle.add(message(10, { idle_s: 1, bodies_s: 0.1, observers_s: 0.15, devices_s: 0.1 }));
  expect(paceSentence(RUNNING, idle)).toContain("Other programs on this machine delay the steps");
});

test("delays are summed over the last seconds, and the longest steps are sorted", () => {
  const costs = new StepCosts();
  const held = (robot: string, total_s: number) => ({ robot, steps: 2n, total_s, longest_s: total_s / 2 });
  costs.add(message(2, {}, { hold_ups: [held("a", 1), held("b", 4)], longest: [cost(3, { bodies_s: 1 }), cost(4, { bodies_s: 3 })] }));
  costs.add(message(2, {}, { hold_ups: [held("a", 6)], longest: [cost(9, { behaviours_s: 2 })] }));
  expect(costs.holdUps).toEqual([
    { robot: "a", steps: 4, total: 7, longest: 3 },
    { robot: "b", steps: 2, total: 4, longest: 2 },
  ]);
  expect(costs.longest(2).map(({ step }) => step)).toEqual([4n, 9n]);
});

test("the panel shows gravity, step, costs and the waterfall, and reads only while it is in sight", async () => {
  const parameter = vi.fn(async (name: string) => (name === "/gsv/gravity_z_m_s2" ? -1.62 : 0.005));
  const { ports, topics } = testPorts({ scene: scene({ bodies: [] }), status: RUNNING }, { parameter });
  const { body, whileOpen } = mount(ports);
  expect(topics.read).toEqual([]);
  const end = whileOpen!();
  await vi.waitFor(() => expect(body.textContent).toContain("-1.62 m/s² along z"));
  expect(body.textContent).toContain("5.00 ms");
  const hold_ups = [{ robot: "a", steps: 2n, total_s: 0.05, longest_s: 0.03 }];
  topics.send("/gsv/step_costs", message(2, { behaviours_s: 0.05, bodies_s: 0.01 }, { hold_ups, longest: [cost(7, { held_up_by: "a", behaviours_s: 0.03 })] }));
  expect([...body.querySelectorAll(".waterfall tbody td")].map(({ textContent }) => textContent)).toEqual(["7", "", "a", "30.00 ms"]);
  body.querySelector<HTMLButtonElement>(".panel-table button")!.click();
  expect(ports.robots.select).toHaveBeenCalledWith("a");
  end();
  expect(topics.read).toEqual([]);
});
