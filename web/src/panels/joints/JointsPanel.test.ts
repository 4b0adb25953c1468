// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { BodyJoints, Joint } from "../../api/joints";
import { body, scene } from "../../scene/testScene";
import { simulationStatus } from "../../page/testApp";
import { testPorts } from "../contract/testPorts";
import { mount } from "./JointsPanel";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const ELBOW: Joint = {
  name: "elbow",
  kind: "revolute",
  unit: "rad",
  position: Math.PI / 4,
  velocity: 0,
  minimum: -Math.PI / 2,
  maximum: Math.PI / 2,
  maxVelocity: 2,
  maxEffort: Infinity,
  command: null,
  refusal: "",
};
const JOINT = { name: "elbow", kind: "revolute", link: null, pose: [0, 0, 0, 0, 0, 0, 1], axis: [0, 0, 1] } as never;

async function opened(told: Partial<BodyJoints>) {
  const joints = vi.fn(async () => ({ time: 0, joints: [ELBOW], refusal: "", ...told }));
  const bodies = [body("wall", { isRobot: false }), body("arm", { isRobot: false, joints: [JOINT] })];
  const commandJoint = vi.fn(async () => {});
  const { ports, store } = testPorts({ scene: scene({ bodies }), status: simulationStatus("running") }, {}, { joints, commandJoint });
  const { body: element, tools, whileOpen } = mount(ports);
  document.body.replaceChildren(...tools!, element);
  const end = whileOpen!();
  await vi.advanceTimersByTimeAsync(10);
  return { commandJoint, joints, store, end, slider: () => document.querySelector<HTMLInputElement>('input[type="range"]')! };
}

test("a joint is shown with its limits, and moved by its slider and by its number", async () => {
  const { commandJoint, slider, end } = await opened({});
  expect(document.querySelector(".joint-state")!.textContent).toBe("0.785 rad, 0.000 rad/s");
  expect(document.body.textContent).toContain("-1.571 rad to 1.571 rad, at most 2.000 rad/s");
  slider().value = "1.2";
  slider().dispatchEvent(new Event("input"));
  await vi.advanceTimersByTimeAsync(1);
  const [, , , kind, value] = commandJoint.mock.calls.at(-1)! as unknown as [string, string, string, string, number];
  expect([kind, Math.round(value * 100)]).toEqual(["position", 120]);
  const degrees = document.querySelector<HTMLInputElement>('input[type="checkbox"]')!;
  degrees.checked = true;
  await vi.advanceTimersByTimeAsync(250);
  expect(document.querySelector(".joint-state")!.textContent).toBe("45.0 °, 0.0 °/s");
  const field = document.querySelector<HTMLInputElement>('input[type="number"]')!;
  field.value = "900";
  field.dispatchEvent(new Event("change"));
  await vi.advanceTimersByTimeAsync(1);
  expect((commandJoint.mock.calls.at(-1) as unknown as unknown[])[4]).toBeCloseTo(Math.PI / 2);
  end();
});

test("while the simulation is paused, a joint keeps the set value and says when it is applied", async () => {
  const { commandJoint, slider, end, store, joints } = await opened({});
  store.set({ status: simulationStatus("paused") });
  slider().value = "1.2";
  slider().dispatchEvent(new Event("input"));
  await vi.advanceTimersByTimeAsync(5000);
  expect(commandJoint).toHaveBeenCalledTimes(1);
  expect(Number(slider().value)).toBeCloseTo(1.2, 1);
  expect(document.body.textContent).toMatch(/1\.2\d\d rad is applied when the simulation resumes\./);
  expect(document.body.textContent).toContain("The simulation is paused. Commands are applied when it runs.");
  store.set({ status: simulationStatus("running") });
  joints.mockImplementation(async () => ({ time: 1, joints: [{ ...ELBOW, command: { kind: "position", value: 0.9 } }], refusal: "" }));
  await vi.advanceTimersByTimeAsync(1500);
  expect(Number(slider().value)).toBeCloseTo(0.9, 1);
  expect(document.body.textContent).not.toContain("is applied when");
  end();
});

test("the slider of a joint without limits sets its velocity, and a button stops the joint", async () => {
  const { commandJoint, end } = await opened({ joints: [{ ...ELBOW, kind: "continuous", minimum: -Infinity, maximum: Infinity }] });
  [...document.querySelectorAll("button")].find(({ textContent }) => textContent === "Stop")!.click();
  await vi.advanceTimersByTimeAsync(1);
  expect(commandJoint).toHaveBeenCalledWith("house", "arm", "elbow", "velocity", 0);
  end();
});

test("the velocity of a joint can be set up to its limit", async () => {
  const { commandJoint, end } = await opened({
    joints: [{ ...ELBOW, kind: "continuous", minimum: -Infinity, maximum: Infinity, maxVelocity: 10 }],
  });
  const field = document.querySelector<HTMLInputElement>('input[type="number"]')!;
  field.value = "5";
  field.dispatchEvent(new Event("change"));
  await vi.advanceTimersByTimeAsync(1);
  expect(commandJoint).toHaveBeenLastCalledWith("house", "arm", "elbow", "velocity", 5);
  end();
});

test("the reason of a refused command stays until a command is accepted", async () => {
  const { commandJoint, slider, end } = await opened({});
  const note = () => document.querySelector(".joints-note")!.textContent;
  const move = async (value: string) => {
    slider().value = value;
    slider().dispatchEvent(new Event("input"));
    await vi.advanceTimersByTimeAsync(1000);
  };
  commandJoint.mockRejectedValueOnce(new Error("this token may only watch"));
  await move("1.2");
  expect(note()).toBe("this token may only watch");
  await move("1.1");
  expect(note()).toBe("");
  end();
});

test("a body that is added while the panel is open is shown", async () => {
  const { joints, store, end } = await opened({});
  const bodies = store.get().scene!.bodies;
  store.set({ scene: scene({ bodies: [] }) });
  await vi.advanceTimersByTimeAsync(2000);
  const asked = joints.mock.calls.length;
  store.set({ scene: scene({ bodies }) });
  await vi.advanceTimersByTimeAsync(2000);
  expect(joints.mock.calls.length).toBeGreaterThan(asked);
  expect(document.querySelector(".joint-state")!.textContent).toBe("0.785 rad, 0.000 rad/s");
  end();
});

test("the panel shows why a body or a joint takes no commands, and disables the slider", async () => {
  const { slider, end, joints } = await opened({ refusal: "'arm' is controlled by its behaviour" });
  expect(document.querySelector(".joints-note")!.textContent).toBe("'arm' is controlled by its behaviour");
  expect(slider().disabled).toBe(true);
  end();
  const asked = joints.mock.calls.length;
  await vi.advanceTimersByTimeAsync(2000);
  expect(joints).toHaveBeenCalledTimes(asked); // a hidden panel sends no requests
});
