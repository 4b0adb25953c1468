// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { App } from "../app/App";
import type { SceneSensor } from "../api/scene";
import { body, scene } from "../scene/testScene";
import { createSensorList, labelOf } from "./SensorList";
import { testApp } from "./testApp";

function sensor(name: string, more: Partial<SceneSensor> = {}): SceneSensor {
  return { name, type: "sonar", overlay: "lines", link: "base", topic: `/a/${name}`, view: null, ...more };
}

const SCENE = scene({
  bodies: [
    body("a", {
      sensors: [
        sensor("sonar"),
        sensor("eye", { type: "camera", overlay: "picture" }),
        sensor("depth", { type: "depth_camera", overlay: "points" }),
      ],
    }),
    body("b", { sensors: [sensor("sonar", { topic: "/b/sonar" })] }),
  ],
});

// Which topics are heard now, and what is sent on them.
function listening(app: App) {
  const heard = new Map<string, (message: never) => void>();
  vi.spyOn(app.session, "subscribe").mockImplementation((topic, handler) => {
    heard.set(topic, handler as (message: never) => void);
    return () => void heard.delete(topic);
  });
  return heard;
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function toggle(list: HTMLElement, open: boolean): void {
  (list as HTMLDetailsElement).open = open;
  list.dispatchEvent(new Event("toggle"));
}

test("what the selected robot's sensors read is shown, at a pace that can be read", () => {
  const { app } = testApp({ scene: SCENE, selection: "a" });
  const heard = listening(app);
  const list = createSensorList(app);
  expect([...heard.keys()]).toEqual(["/a/sonar"]);
  heard.get("/a/sonar")!({ range: 1.5 } as never);
  heard.get("/a/sonar")!({ range: 1.25 } as never);
  expect(list.querySelector("dd")).toBeNull();
  vi.advanceTimersByTime(200);
  const values = list.querySelector('[data-sensor="sonar"] .values')!;
  expect(values.textContent).toBe("range1.250 m");
});

test("they are heard only while the list is open, and only those of one robot", () => {
  const { app, store } = testApp({ scene: SCENE, selection: "a" });
  const heard = listening(app);
  const list = createSensorList(app);
  store.set({ selection: "b" });
  expect([...heard.keys()]).toEqual(["/b/sonar"]);
  toggle(list, false);
  expect(heard.size).toBe(0);
  toggle(list, true);
  expect([...heard.keys()]).toEqual(["/b/sonar"]);
  store.set({ selection: null });
  expect(heard.size).toBe(0);
  expect(list.hidden).toBe(true);
});

test("a camera's row brings its picture", () => {
  const { app, store } = testApp({ scene: SCENE, selection: "a", cameraOpen: false });
  listening(app);
  createSensorList(app).querySelector<HTMLButtonElement>('[data-sensor="eye"] button')!.click();
  expect(store.get().camera).toEqual({ robot: "a", sensor: "eye", topic: "/a/eye" });
  expect(store.get().cameraOpen).toBe(true);
});

test("a value is called by the end of its path", () => {
  expect(labelOf("pose.pose.position.x")).toBe("position x");
  expect(labelOf("vertical_position")).toBe("vertical position");
  expect(labelOf("position[arm.left]")).toBe("position[arm.left]");
});
