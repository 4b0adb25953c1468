// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { body, scene } from "../../scene/testScene";
import type { State } from "../../state/State";
import { withCurve, withoutCurve } from "../../state/plots";
import { element } from "../../ui/element";
import { simulationStatus } from "../../page/testApp";
import { testPorts } from "../contract/testPorts";
import { mount } from "./PlotPanel";

const SCENE = scene({ bodies: [body("a")], poses: [{ body: 0, link: null }] });

beforeEach(() => {
  vi.useFakeTimers();
  vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(null);
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

function panelIn(state: Partial<State> = {}) {
  const { store, topics, ports } = testPorts({ scene: SCENE, selection: "a", ...state });
  ports.plots.add.mockImplementation((source, key, unit = "m") =>
    store.set(({ plots }) => ({ plots: withCurve(plots, source, key, unit) })),
  );
  ports.plots.remove.mockImplementation((id) =>
    store.set(({ plots }) => ({ plots: withoutCurve(plots, id) })),
  );
  const { body, tools = [], whileOpen } = mount(ports);
  const panel = element("section", {}, ...tools, body);
  whileOpen!();
  const choose = (name: string, value: string) => {
    const choice = panel.querySelector<HTMLSelectElement>(`select[aria-label="${name}"]`)!;
    choice.value = value;
    choice.dispatchEvent(new Event("change"));
  };
  const names = () => [...panel.querySelectorAll(".plot-name")].map(({ textContent }) => textContent);
  return { store, topics, panel, choose, names };
}

test("a chosen value appears in the legend with its present value, and can be removed", () => {
  const { store, topics, panel, choose, names } = panelIn();
  expect(panel.querySelector<HTMLElement>(".plot-empty")!.hidden).toBe(false);
  choose("Add a curve", "robot x");
  choose("Add a curve", "simulation real_time_factor");
  expect(names()).toEqual(["a x", "real-time factor"]);
  expect(panel.querySelector<HTMLElement>(".plot-empty")!.hidden).toBe(true);
  topics.send("/gsv/poses", {
    stamp: { sec: 2, nsec: 0 },
    step: 0n,
    layout_version: 1,
    poses: new Float64Array([1.5, 0, 0, 0, 0, 0, 1]),
  });
  store.set({ status: simulationStatus("running", { time: 2, realTimeFactor: 0.5 }), time: 2 });
  vi.advanceTimersByTime(100);
  const values = [...panel.querySelectorAll(".plot-legend .number")].map(({ textContent }) => textContent);
  expect(values).toEqual(["at 0:02.00", "1.500 m", "0.500 m"]);
  panel.querySelector<HTMLButtonElement>('[aria-label="Remove a x"]')!.click();
  expect(names()).toEqual(["real-time factor"]);
});

test("without a selection, only the simulation's values are offered", () => {
  const { panel, store } = panelIn();
  const groups = () => [...panel.querySelectorAll("optgroup")].map(({ label }) => label);
  expect(groups()).toEqual(["a", "Simulation"]);
  store.set({ selection: null });
  expect(groups()).toEqual(["Simulation"]);
});

test("the list of time spans shows the selected span", () => {
  const { store, choose } = panelIn();
  choose("Time shown", "null");
  expect(store.get().plots.span).toBeNull();
  choose("Time shown", "120");
  expect(store.get().plots.span).toBe(120);
});

test("an expression is typed, refused with a sentence, and plotted", () => {
  const { panel, names, choose } = panelIn();
  choose("Add a curve", "robot x");
  const press = (text: string) => [...panel.querySelectorAll("button")].find((each) => each.textContent === text)!.click();
  const input = panel.querySelector<HTMLInputElement>('input[aria-label="Expression"]')!;
  const form = panel.querySelector<HTMLFormElement>(".plot-expression")!;
  expect(form.hidden).toBe(true);
  press("Expression…");
  expect(form.hidden).toBe(false);
  input.value = "2 * ";
  choose("Insert a field", "{a x}");
  expect(input.value).toBe("2 * {a x}");
  input.value += " +";
  form.requestSubmit();
  expect(form.querySelector('[role="alert"]')!.textContent).toBe("The expression is not complete.");
  input.value = "2 * {a x}";
  form.requestSubmit();
  expect(names()).toEqual(["a x", "2 * {a x}"]);
  input.value = "7";
  form.requestSubmit();
  expect(form.querySelector('[role="alert"]')!.textContent).toBe("The expression needs a field, for example {pebble speed}.");
});

test("a curve goes to the horizontal axis, and time returns when it is removed", () => {
  const { store, panel, choose } = panelIn();
  choose("Add a curve", "robot x");
  choose("Add a curve", "robot y");
  choose("Horizontal axis", "robot a x");
  expect(store.get().plots.against).toBe("robot a x");
  panel.querySelector<HTMLButtonElement>('[aria-label="Remove a x"]')!.click();
  expect(store.get().plots.against).toBeNull();
});

test("the plot's tooltip says how to go to a time, only in a replay plotted against time", () => {
  const { store, panel, choose } = panelIn();
  const tooltip = () => panel.querySelector<HTMLElement>(".plot-canvas")!.title;
  choose("Add a curve", "robot x");
  expect(tooltip()).toBe("");
  store.set({ replay: { start: 0, end: 10, speed: 1, loop: false } });
  expect(tooltip()).toBe("Click or drag to go to a time");
  choose("Horizontal axis", "robot a x");
  expect(tooltip()).toBe("");
  choose("Horizontal axis", "");
  expect(tooltip()).toBe("Click or drag to go to a time");
  store.set({ replay: null });
  expect(tooltip()).toBe("");
});
