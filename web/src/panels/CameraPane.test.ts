// @vitest-environment jsdom
import { beforeEach, expect, test, vi } from "vitest";
import type { SceneSensor } from "../api/scene";
import { camerasOf } from "../api/scene";
import type { State } from "../state/State";
import { body, scene } from "../scene/testScene";
import { createCameraPane } from "./CameraPane";
import { testApp } from "./testApp";

const EYE: SceneSensor = { name: "eye", type: "camera", overlay: "picture", link: "base", topic: "/a/eye", view: null };
const SCENE = scene({ bodies: [body("a", { sensors: [EYE] })] });

// jsdom draws nothing.
beforeEach(() => void vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(null));

function opened(state: Partial<State>) {
  const { app, store } = testApp({ scene: SCENE, camera: camerasOf(SCENE)[0]!, cameraOpen: true, ...state });
  const subscribe = vi.spyOn(app.session, "subscribe").mockReturnValue(() => {});
  const pane = createCameraPane(app);
  return { store, subscribe, waiting: () => pane.querySelector(".picture-waiting")!.textContent };
}

test("a camera is listened to once there is a view, and its picture waited for", () => {
  const { store, subscribe, waiting } = opened({ view: "starting" });
  expect(waiting()).toBe("Waiting for a picture…");
  expect(subscribe).not.toHaveBeenCalled();
  store.set({ view: "open" });
  expect(subscribe.mock.calls.map(([topic]) => topic)).toEqual(["/a/eye"]);
});

test("a recording that has no picture yet is not waited for", () => {
  const { store, waiting } = opened({});
  store.set({ replay: { start: 0, end: 10, speed: 1, loop: false } });
  expect(waiting()).toBe("No picture of it is recorded up to here.");
  store.set({ replay: null });
  expect(waiting()).toBe("Waiting for a picture…");
});
