// @vitest-environment jsdom
import { expect, test } from "vitest";
import { scene } from "../scene/testScene";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { createOverlay, situationOf } from "./Overlay";
import { simulationStatus, testApp } from "./testApp";

const open: State = { ...initialState, view: "open", connection: { phase: "open" } };
const waiting: State = { ...open, connection: { phase: "waiting", attempt: 1, retryAtMs: 0 } };
const summary = { name: "house", phase: "running", robots: 1 } as const;

test("the page shows what it waits for, from the connection to the scene", () => {
  expect(situationOf(initialState)).toBe("connecting");
  expect(situationOf({ ...open, simulations: [] })).toBe("no-simulation");
  expect(situationOf({ ...open, simulations: [summary], simulation: "house" })).toBe("loading");
  expect(situationOf({ ...open, view: "starting", simulation: "house", scene: scene() })).toBe("loading");
  expect(situationOf({ ...open, simulation: "house", scene: scene() })).toBe("none");
});

test("a server that never answered differs from one that was lost", () => {
  expect(situationOf(waiting)).toBe("unreachable");
  expect(situationOf({ ...waiting, simulation: "house", scene: scene() })).toBe("lost");
});

test("an ended run shows its summary, not a lost connection, until the summary is closed", () => {
  const shown = { ...open, simulation: "house", scene: scene(), status: simulationStatus("finished") };
  expect(situationOf(shown)).toBe("ended");
  expect(situationOf({ ...shown, connection: waiting.connection })).toBe("ended");
  expect(situationOf({ ...shown, status: simulationStatus("failed") })).toBe("ended");
  expect(situationOf({ ...shown, status: simulationStatus("stopped") })).toBe("none");
  expect(situationOf({ ...shown, endSeen: true })).toBe("none");
  expect(situationOf({ ...shown, replay: { start: 0, end: 1, speed: 1, loop: false } })).toBe("none");
});

test("the notice of a lost connection stays during the next attempt", () => {
  expect(situationOf({ ...initialState, simulation: "house", scene: scene() })).toBe("lost");
});

test("missing WebGL is reported when there is a simulation", () => {
  expect(situationOf({ ...open, simulation: "house", view: "none", scene: scene() })).toBe("no-webgl");
});

test("if the server refuses to draw and there is no WebGL, the reason is shown", () => {
  const refused = { ...open, simulation: "house", view: "none" as const, scene: scene(), whyNoView: "too many views" };
  expect(situationOf(refused)).toBe("not-drawn");
  expect(situationOf({ ...refused, view: "starting", whyNoView: "" })).toBe("loading");
});

test("a lost WebGL context is reported until it is restored", () => {
  const shown = { ...open, simulation: "house", scene: scene() };
  expect(situationOf({ ...shown, view: "interrupted" })).toBe("webgl-lost");
  expect(situationOf({ ...shown, view: "open" })).toBe("none");
});

test("without a simulation, the page offers the recordings of the server, if it has any", () => {
  const { app, store } = testApp({ simulation: null, simulations: [] });
  const overlay = createOverlay(app);
  document.body.append(overlay);
  const link = overlay.querySelector<HTMLElement>('a[href="recordings.html"]')!;
  expect(link.textContent).toBe("Open a recording");
  expect(link.hidden).toBe(true);
  store.set(({ abilities }) => ({ abilities: { ...abilities, recordings: true } }));
  expect(link.hidden).toBe(false);
  overlay.remove();
});
