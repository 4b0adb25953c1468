import { expect, test, vi } from "vitest";
import type { SceneSensor } from "../api/scene";
import { body, scene } from "../scene/testScene";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { OverlayFeed, topicsToDraw } from "./OverlayFeed";
import type { Session } from "./Session";

function sensor(robot: string, name: string, type: string, overlay: SceneSensor["overlay"]): SceneSensor {
  return { name, type, overlay, link: "base", topic: `/${robot}/${name}`, view: null };
}

function robot(name: string) {
  return body(name, {
    sensors: [
      sensor(name, "scan", "lidar", "points"),
      sensor(name, "bumper", "contact", "lines"),
      sensor(name, "sonar", "sonar", "lines"),
    ],
  });
}

const SCENE = scene({ bodies: [robot("a"), robot("b")] });

function showing(names: (keyof State["shown"])[], more: Partial<State> = {}): State {
  const shown = { ...initialState.shown };
  for (const name of Object.keys(shown) as (keyof State["shown"])[]) shown[name] = names.includes(name);
  return { ...initialState, simulation: "house", scene: SCENE, shown, ...more };
}

function fakeView() {
  return {
    setSensorFrames: vi.fn(),
    setBeams: vi.fn(),
    forgetBeams: vi.fn(),
    setPoints: vi.fn(),
    setReading: vi.fn(),
    keepReadings: vi.fn(),
  };
}

test("only visible overlays are subscribed", () => {
  expect(topicsToDraw(showing(["labels", "states"]))).toEqual([]);
  expect(topicsToDraw(showing(["beams", "labels"]))).toEqual(["/gsv/beams"]);
  expect(topicsToDraw(showing(["points"]))).toEqual(["/tf_static", "/a/scan", "/b/scan"]);
  expect(topicsToDraw(showing(["contacts"]))).toEqual(["/gsv/current_contacts"]);
  const replay = { start: 0, end: 1, speed: 1, loop: false };
  expect(topicsToDraw(showing(["contacts"], { replay }))).toEqual(["/tf_static", "/a/bumper", "/b/bumper"]);
  expect(topicsToDraw(showing(["frames"]))).toEqual(["/tf_static"]);
  expect(topicsToDraw(showing([], { viewMode: "eye" }))).toEqual(["/tf_static"]);
  expect(topicsToDraw({ ...showing(["points", "frames"]), scene: null })).toEqual([]);
});

test("radio is subscribed whatever the scene contains, because behaviours may mount radios", () => {
  expect(topicsToDraw(showing(["actuators"]))).toEqual(["/gsv/radio"]);
  expect(topicsToDraw(showing(["actuators"], { scene: scene({ bodies: [] }) }))).toEqual([]);
});

test("a limited number of sensors is subscribed, those of the selected robot first", () => {
  const crowd = scene({ bodies: Array.from({ length: 100 }, (_, i) => robot(`r${i}`)) });
  const topics = topicsToDraw(showing(["points"], { scene: crowd, selection: "r70" }));
  expect(topics).toHaveLength(17);
  expect(topics[1]).toBe("/r70/scan");
});

const crowdOf = (robots: number) => scene({ bodies: Array.from({ length: robots }, (_, i) => robot(`r${i}`)) });
const REPLAY = { start: 0, end: 9, speed: 1, loop: false };

test("with more than twenty robots, only the selected robot's beams are subscribed", () => {
  expect(topicsToDraw(showing(["beams"], { scene: crowdOf(20) }))).toEqual(["/gsv/beams"]);
  expect(topicsToDraw(showing(["beams"], { scene: crowdOf(21) }))).toEqual([]);
  expect(topicsToDraw(showing(["beams"], { scene: crowdOf(21), selection: "r7" }))).toEqual(["/gsv/beams/r7"]);
  expect(topicsToDraw(showing(["beams"], { scene: crowdOf(21), selection: "gone" }))).toEqual([]);
  const recorded = { scene: crowdOf(21), selection: "r7", replay: REPLAY };
  expect(topicsToDraw(showing(["beams"], recorded))).toEqual(["/gsv/beams"]);
});

test("in a recording, only the beams of the selected robot are drawn", () => {
  const store = new Store<State>(showing(["beams"], { scene: crowdOf(21), selection: "r7", replay: REPLAY }));
  let send = (_message: unknown) => {};
  const end = vi.fn();
  const session = {
    subscribe: (_topic: string, handler: (message: unknown) => void) => {
      send = handler;
      return end;
    },
  };
  const view = fakeView();
  new OverlayFeed(store, session as unknown as Session, view).start();
  send([{ robot: "r6" }, { robot: "r7" }]);
  expect(view.setBeams).toHaveBeenCalledWith([{ robot: "r7" }]);
  store.set({ selection: null });
  expect(end).toHaveBeenCalled();
  expect(view.forgetBeams).toHaveBeenCalled();
});

test("hidden overlays are unsubscribed and cleared", () => {
  const store = new Store<State>(showing([]));
  const heard = new Map<string, (message: unknown) => void>();
  const session = {
    subscribe: (topic: string, handler: (message: unknown) => void) => {
      heard.set(topic, handler);
      return () => heard.delete(topic);
    },
  };
  const view = fakeView();
  new OverlayFeed(store, session as unknown as Session, view).start();
  expect(heard.size).toBe(0);
  store.set(showing(["points", "contacts"]));
  expect([...heard.keys()].sort()).toEqual(["/a/scan", "/b/scan", "/gsv/current_contacts", "/tf_static"]);
  heard.get("/a/scan")!("points");
  expect(view.setPoints).toHaveBeenCalledWith("/a/scan", "points");
  heard.get("/gsv/current_contacts")!({ contacts: [] });
  expect(view.setReading).toHaveBeenCalledWith("/gsv/current_contacts", { contacts: [] });
  store.set(showing(["contacts"]));
  expect([...heard.keys()]).toEqual(["/gsv/current_contacts"]);
  expect(view.keepReadings).toHaveBeenLastCalledWith(new Set(["/gsv/current_contacts"]));
});

test("topics are subscribed again for another simulation, even if their names are equal", () => {
  const store = new Store<State>(showing(["points"]));
  const subscribe = vi.fn((_topic: string, _handler: unknown) => () => {});
  const view = fakeView();
  new OverlayFeed(store, { subscribe } as unknown as Session, view).start();
  subscribe.mockClear();
  store.set({ simulation: "yard" });
  expect(subscribe.mock.calls.map(([topic]) => topic)).toEqual(["/tf_static", "/a/scan", "/b/scan"]);
});
