// @vitest-environment jsdom
import { beforeEach, expect, test, vi } from "vitest";
import type { SceneSensor } from "../../api/scene";
import { camerasOf } from "../../api/scene";
import type { State } from "../../state/State";
import { body, scene } from "../../scene/testScene";
import { mount } from "./CameraPane";
import { testPorts } from "../contract/testPorts";

const EYE: SceneSensor = { name: "eye", type: "camera", overlay: "picture", link: "base", topic: "/a/eye", view: null };
const SCENE = scene({ bodies: [body("a", { sensors: [EYE] })] });

// jsdom draws nothing.
beforeEach(() => void vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(null));

function opened(state: Partial<State>) {
  const { ports, store, topics } = testPorts({ scene: SCENE, camera: camerasOf(SCENE)[0]!, ...state });
  const { body, whileOpen } = mount(ports);
  whileOpen!();
  return { store, topics, waiting: () => body.querySelector(".picture-waiting")!.textContent };
}

test("a camera is listened to once there is a view, and its picture waited for", () => {
  const { store, topics, waiting } = opened({ view: "starting" });
  expect(waiting()).toBe("Waiting for an image…");
  expect(topics.read).toEqual([]);
  store.set({ view: "open" });
  expect(topics.read).toEqual(["/a/eye"]);
});

test("nothing is listened to while the panel is out of sight", () => {
  const { ports, topics } = testPorts({ scene: SCENE, camera: camerasOf(SCENE)[0]! });
  const { whileOpen } = mount(ports);
  expect(topics.read).toEqual([]);
  const end = whileOpen!();
  expect(topics.read).toEqual(["/a/eye"]);
  end();
  expect(topics.read).toEqual([]);
});

test("a recording that has no picture yet is not waited for", () => {
  const { store, waiting } = opened({});
  store.set({ replay: { start: 0, end: 10, speed: 1, loop: false } });
  expect(waiting()).toBe("The recording has no image of this camera up to this time.");
  store.set({ replay: null });
  expect(waiting()).toBe("Waiting for an image…");
});
