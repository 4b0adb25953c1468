// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { SceneSensor } from "../../api/scene";
import { body, scene } from "../../scene/testScene";
import { createSensorList, labelOf } from "./SensorList";
import { testPorts } from "../contract/testPorts";

function sensor(name: string, more: Partial<SceneSensor> = {}): SceneSensor {
  return { name, type: "sonar", overlay: "lines", link: "base", topic: `/a/${name}`, view: null, ...more };
}

const SCENE = scene({
  bodies: [
    body("a", {
      sensors: [
        sensor("sonar", { units: { range: "m" } }),
        sensor("eye", { type: "camera", overlay: "picture" }),
        sensor("depth", { type: "depth_camera", overlay: "points" }),
      ],
    }),
    body("b", { sensors: [sensor("sonar", { topic: "/b/sonar" })] }),
  ],
});

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function toggle(list: HTMLElement, open: boolean): void {
  (list as HTMLDetailsElement).open = open;
  list.dispatchEvent(new Event("toggle"));
}

test("the readings of the selected robot's sensors are shown at a readable rate", () => {
  const { ports, topics } = testPorts({ scene: SCENE, selection: "a" });
  const list = createSensorList(ports);
  expect(topics.read).toEqual(["/a/sonar"]);
  topics.send("/a/sonar", { range: 1.5 });
  topics.send("/a/sonar", { range: 1.25 });
  expect(list.querySelector("dd")).toBeNull();
  vi.advanceTimersByTime(200);
  const values = list.querySelector('[data-sensor="sonar"] .values')!;
  expect(values.textContent).toBe("range1.250 m");
});

test("sensors are subscribed only while the list is open, and only those of one robot", () => {
  const { ports, store, topics } = testPorts({ scene: SCENE, selection: "a" });
  const list = createSensorList(ports);
  store.set({ selection: "b" });
  expect(topics.read).toEqual(["/b/sonar"]);
  toggle(list, false);
  expect(topics.read).toEqual([]);
  toggle(list, true);
  expect(topics.read).toEqual(["/b/sonar"]);
  store.set({ selection: null });
  expect(topics.read).toEqual([]);
  expect(list.hidden).toBe(true);
});

test("a click on a camera's row shows its image", () => {
  const { ports } = testPorts({ scene: SCENE, selection: "a" });
  createSensorList(ports).querySelector<HTMLButtonElement>('[data-sensor="eye"] button')!.click();
  expect(ports.cameras.show).toHaveBeenCalledWith({ robot: "a", sensor: "eye", topic: "/a/eye" });
});

test("a value is named by the end of its path", () => {
  expect(labelOf("pose.pose.position.x")).toBe("position x");
  expect(labelOf("vertical_position")).toBe("vertical position");
  expect(labelOf("position[arm.left]")).toBe("position[arm.left]");
});
