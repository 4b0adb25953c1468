// @vitest-environment jsdom
import { beforeEach, expect, test, vi } from "vitest";
import { robotStatus, simulationStatus, testApp } from "../page/testApp";
import { body, scene } from "../scene/testScene";
import type { Viewpoint } from "../state/link";
import type { State } from "../state/State";
import type { LinkedPage } from "./LinkControl";
import { LinkControl } from "./LinkControl";

const REPLAY = { start: 0, end: 20, speed: 1, loop: false };
const SCENE = scene({ bodies: [body("a"), body("b")] });
const THERE: Viewpoint = [1, 2, 3, 0, 0, 0];

beforeEach(() => void (location.hash = ""));

function page(state: Partial<State> = {}) {
  const { app, store } = testApp({
    scene: SCENE,
    status: simulationStatus("paused", { robots: [robotStatus("a")] }),
    ...state,
  });
  const place = { viewpoint: [9, 9, 9, 0, 0, 0] as Viewpoint };
  const seek = vi.spyOn(app.replay, "seek").mockResolvedValue();
  const act = vi.spyOn(app, "act").mockResolvedValue();
  const page: LinkedPage = {
    select: (robot) => app.select(robot),
    pause: () => app.act("pause"),
    seek: (time) => app.replay.seek(time),
  };
  return { app, store, place, seek, act, control: new LinkControl(store, page, () => place) };
}

test("a link shows the same instant from the same place with the same robot", async () => {
  const from = page({ replay: REPLAY, time: 12.5, selection: "b", viewMode: "chase" });
  from.place.viewpoint = THERE;
  const link = from.control.linkTo("http://127.0.0.1:8080/");
  expect(link).toBe(
    "http://127.0.0.1:8080/#t=12.5&view=1,2,3,0,0,0&select=b&mode=chase&show=beams,labels,states,grid,actuators",
  );
  location.hash = new URL(link).hash;
  const to = page({ replay: REPLAY });
  to.control.start(window);
  expect(to.store.get()).toMatchObject({ selection: "b", viewMode: "chase" });
  expect(to.place.viewpoint).toEqual(THERE);
  await vi.waitFor(() => expect(to.seek).toHaveBeenCalledWith(12.5));
  expect(to.act).not.toHaveBeenCalled();
});

test("playback stops at the requested instant", async () => {
  location.hash = "#t=3";
  const { control, act, seek } = page({ replay: REPLAY, status: simulationStatus("running") });
  control.start(window);
  await vi.waitFor(() => expect(seek).toHaveBeenCalledWith(3));
  expect(act).toHaveBeenCalledWith("pause");
});

test("a link waits for the scene and is applied once", async () => {
  location.hash = "#view=1,2,3,0,0,0&select=a";
  const { control, store, place } = page({ scene: null, status: null });
  control.start(window);
  expect(store.get().selection).toBeNull();
  store.set({ scene: SCENE, status: simulationStatus("running") });
  await vi.waitFor(() => expect(store.get().selection).toBe("a"));
  expect(place.viewpoint).toEqual(THERE);
  place.viewpoint = [5, 5, 5, 0, 0, 0];
  store.set({ scene: null });
  store.set({ scene: SCENE });
  expect(place.viewpoint).toEqual([5, 5, 5, 0, 0, 0]);
});

test("the camera of a link counts, even if the view frames the world after the link is known", async () => {
  history.replaceState(null, "", "#view=1,2,3,0,0,0"); // without an event, as when the page is opened
  const { control, store, place } = page({ scene: null });
  control.start(window);
  store.watch(
    ({ scene }) => scene,
    () => (place.viewpoint = [7, 7, 7, 0, 0, 0]),
  );
  store.set({ scene: SCENE });
  await Promise.resolve();
  expect(place.viewpoint).toEqual(THERE);
});

test("a seek waits until the page knows that it is a recording", async () => {
  location.hash = "#t=3";
  const { control, seek, store } = page();
  control.start(window);
  expect(seek).not.toHaveBeenCalled();
  store.set({ replay: REPLAY });
  await vi.waitFor(() => expect(seek).toHaveBeenCalledWith(3));
});

test("a link to a removed robot, or to an instant of a live simulation, shows the present state", () => {
  location.hash = "#t=3&select=ghost&mode=eye";
  const { control, store, seek } = page();
  control.start(window);
  expect(store.get()).toMatchObject({ selection: null, viewMode: "orbit" });
  expect(seek).not.toHaveBeenCalled();
});

test("with several simulations, the link contains the simulation's name", () => {
  const simulations = ["house", "yard"].map((name) => ({ name, phase: "running", robots: 0 }) as const);
  const { control } = page({ simulations, simulation: "house" });
  expect(new URL(control.linkTo("http://127.0.0.1:8080/?quality=high#old")).search).toBe(
    "?quality=high&simulation=house",
  );
});

test("a link to the past of a run goes there if it is still kept", () => {
  location.hash = "#t=12.5";
  const { store } = page({ time: 30 });
  const sought = vi.fn(async () => {});
  const linked = new LinkControl(store, { select: () => {}, pause: async () => {}, seek: sought }, () => null);
  linked.start(window);
  expect(sought).not.toHaveBeenCalled();
  store.set({ kept: { start: 4, end: 29 } });
  expect(sought).toHaveBeenCalledWith(12.5);
  location.hash = "#t=2";
  const later = vi.fn(async () => {});
  new LinkControl(store, { select: () => {}, pause: async () => {}, seek: later }, () => null).start(window);
  expect(later).not.toHaveBeenCalled(); // the link to the earlier time is no longer used
});
