// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { body, scene } from "../../scene/testScene";
import { robotStatus, simulationStatus } from "../../page/testApp";
import { testPorts } from "../contract/testPorts";
import { Driver } from "./Driver";
import { wishOfGamepad, wishOfKeys, wishOfPoint } from "./driving";
import { GamepadReader } from "./GamepadReader";
import { mount } from "./TeleoperationPanel";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

test("keys command fractions of the maximum speeds, and opposite keys cancel each other", () => {
  expect(wishOfKeys(new Set(["w", "a"]))).toEqual({ ahead: 1, left: 0, turn: 1 });
  expect(wishOfKeys(new Set(["arrowdown", "e"]))).toEqual({ ahead: -1, left: -1, turn: 0 });
  expect(wishOfKeys(new Set(["w", "s"]))).toEqual({ ahead: 0, left: 0, turn: 0 });
});

test("the pad is a disc, and beyond its edge the speed is the maximum", () => {
  expect(wishOfPoint(0, -0.5)).toEqual({ ahead: 0.5, left: 0, turn: 0 });
  const { ahead, turn } = wishOfPoint(-3, -4);
  expect(ahead).toBeCloseTo(0.8);
  expect(turn).toBeCloseTo(0.6);
});

test("a gamepad stick at rest does not drive", () => {
  expect(wishOfGamepad({ axes: [0.1, -0.05, 0.02, 0] })).toEqual({ ahead: 0, left: 0, turn: 0 });
  expect(wishOfGamepad({ axes: [0, -1, 1] })).toEqual({ ahead: 1, left: -1, turn: 0 });
  expect(wishOfGamepad({ axes: [NaN] })).toEqual({ ahead: 0, left: 0, turn: 0 });
});

test("a command is repeated while a key is held, and ends with a stop; after a refusal it ends until all keys are released", async () => {
  const sent: number[] = [];
  let refuses = false;
  const problems: string[] = [];
  const driver = new Driver(
    async (_, { linear_m_s }) => {
      if (refuses) throw new Error("anna has control");
      sent.push(linear_m_s);
    },
    (sentence) => problems.push(sentence),
  );
  const [speeds, ahead, still] = [{ linear: 2, angular: 1 }, { ahead: 0.5, left: 0, turn: 0 }, { ahead: 0, left: 0, turn: 0 }];
  driver.setRobot("a");
  driver.move(ahead, speeds);
  await vi.advanceTimersByTimeAsync(320);
  driver.move(still, speeds);
  await vi.advanceTimersByTimeAsync(1000);
  expect(sent).toEqual([1, 1, 1, 0]);
  refuses = true;
  driver.move(ahead, speeds);
  await vi.advanceTimersByTimeAsync(500);
  driver.move(ahead, speeds);
  expect(problems).toEqual(["anna has control"]);
  refuses = false;
  driver.move(still, speeds);
  driver.move(ahead, speeds);
  await vi.advanceTimersByTimeAsync(10);
  expect(sent.at(-1)).toBe(1);
});

test("a disconnected gamepad sends no more commands", () => {
  let pads: (Gamepad | null)[] = [];
  const wishes: number[] = [];
  const notes: string[] = [];
  const reader = new GamepadReader(
    { onWish: ({ ahead }) => wishes.push(ahead), onConnected: (name) => notes.push(name), onPulledOut: () => notes.push("pulled out") },
    () => pads,
  );
  reader.read();
  pads = [{ index: 0, id: "stick", connected: true, axes: [0, -1] } as unknown as Gamepad];
  reader.read();
  pads = [null];
  reader.read();
  reader.read();
  expect(wishes).toEqual([1, 0]);
  expect(notes).toEqual(["stick", "pulled out"]);
});

function panel(people = { viewers: [], you: 0 }) {
  const robots = [robotStatus("a", { behaviour: "" }), robotStatus("b"), robotStatus("arm", { behaviour: "" })];
  const { ports, store } = testPorts({ people, scene: scene({ bodies: [body("a"), body("b"), body("arm", { hasDrive: false })] }), status: simulationStatus("running", { robots }) });
  const { body: element, tools, whileOpen } = mount(ports);
  document.body.replaceChildren(...tools!, element);
  const end = whileOpen!();
  const pad = document.querySelector<HTMLElement>(".pad")!;
  const key = (type: string, name: string) => pad.dispatchEvent(new KeyboardEvent(type, { key: name, bubbles: true, cancelable: true }));
  return { ports, store, end, key, pad };
}

test("keys on the pad drive a robot without a behaviour, do not reach the page, and the panel's end stops it", async () => {
  const { ports, store, key, end } = panel();
  const heard = vi.fn();
  window.addEventListener("keydown", heard);
  expect([...document.querySelectorAll("option")].map(({ value }) => value)).toEqual(["a"]);
  key("keydown", "w");
  await vi.advanceTimersByTimeAsync(1);
  expect(ports.control.drive).toHaveBeenLastCalledWith("house", "a", { linear_m_s: 0.5, lateral_m_s: 0, angular_rad_s: 0 });
  expect(heard).not.toHaveBeenCalled();
  expect(store.get().driven).toBe("a");
  end();
  expect(store.get().driven).toBeNull();
  await vi.advanceTimersByTimeAsync(1);
  expect(ports.control.drive).toHaveBeenLastCalledWith("house", "a", { linear_m_s: 0, lateral_m_s: 0, angular_rad_s: 0 });
  window.removeEventListener("keydown", heard);
});

test("without control nothing is driven, and the panel offers to take it", async () => {
  const person = (number: number) => ({ number, name: `viewer ${number}`, simulation: "house", holds: false, asks: 0, passesIn: 0 });
  const { ports, key, end } = panel({ viewers: [person(1), person(2)], you: 1 } as never);
  key("keydown", "w");
  await vi.advanceTimersByTimeAsync(200);
  expect(ports.control.drive).not.toHaveBeenCalled();
  expect(document.querySelector(".control-line")!.textContent).toBe("Others are watching this simulation. Take control first.Take control");
  document.querySelector<HTMLButtonElement>(".control-line button")!.click();
  expect(ports.control.take).toHaveBeenCalled();
  end();
});

test("while the simulation is paused, the panel offers to resume it", () => {
  const { ports, store, end } = panel();
  const line = [...document.querySelectorAll<HTMLElement>(".control-line")].at(-1)!;
  expect(line.hidden).toBe(true);
  store.set({ status: simulationStatus("paused") });
  expect(line.hidden).toBe(false);
  expect(line.textContent).toBe("The simulation is paused. Resume it to drive.Resume");
  line.querySelector("button")!.click();
  expect(ports.control.resume).toHaveBeenCalled();
  end();
});

test("the robot stops when the window loses the focus or is hidden, and a pushed stick must be released first", async () => {
  const pads: { index: number; id: string; connected: boolean; axes: number[] }[] = [];
  vi.stubGlobal("navigator", { getGamepads: () => pads });
  const { ports, key, end } = panel();
  const speed = async () => {
    await vi.advanceTimersByTimeAsync(400);
    return vi.mocked(ports.control.drive).mock.lastCall?.[2].linear_m_s;
  };
  const hide = () => {
    const visibility = vi.spyOn(document, "visibilityState", "get").mockReturnValue("hidden");
    document.dispatchEvent(new Event("visibilitychange"));
    visibility.mockRestore();
  };
  for (const leave of [() => window.dispatchEvent(new Event("blur")), () => window.dispatchEvent(new Event("pagehide")), hide]) {
    key("keydown", "w");
    expect(await speed()).toBe(0.5);
    leave();
    expect(await speed()).toBe(0);
    key("keyup", "w");
    pads[0] = { index: 0, id: "stick", connected: true, axes: [0, -1] };
    expect(await speed()).toBe(0.5);
    leave();
    expect(await speed()).toBe(0);
    pads[0].axes = [0, 0];
    expect(await speed()).toBe(0);
    pads[0].axes = [0, -1];
    expect(await speed()).toBe(0.5);
    pads[0].axes = [0, 0];
    expect(await speed()).toBe(0);
  }
  end();
  vi.unstubAllGlobals();
});
