// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { State } from "../state/State";
import { createStatusBar } from "./StatusBar";
import { simulationStatus, testApp } from "./testApp";
import { createTimeline } from "./Timeline";
import { createToolbar } from "./Toolbar";

const REPLAY = { start: 0, end: 80, speed: 1, loop: false };

function timeline(state: Partial<State> = {}) {
  const { app, store } = testApp({ replay: REPLAY, status: simulationStatus("paused"), ...state });
  const bar = createTimeline(app);
  const named = (name: string) => bar.querySelector<HTMLButtonElement>(`[aria-label="${name}"]`)!;
  return { app, store, bar, named, slider: bar.querySelector<HTMLInputElement>("input")! };
}

test("for a recording the timeline replaces the buttons", () => {
  const { app, store } = testApp({ status: simulationStatus("running") });
  const bar = createTimeline(app);
  const run = createToolbar(app, () => {}).querySelector<HTMLElement>(".toolbar-transport")!;
  expect([bar.hidden, run.hidden]).toEqual([true, false]);
  store.set({ replay: REPLAY });
  expect([bar.hidden, run.hidden]).toEqual([false, true]);
});

test("the slider spans the recording and describes its position in words", () => {
  const { slider, store, bar } = timeline({ time: 12.5 });
  expect([slider.min, slider.max, slider.value]).toEqual(["0", "80", "12.5"]);
  expect(slider.getAttribute("aria-valuetext")).toBe("0:12.50 of 1:20.00");
  store.set({ time: 40 });
  expect(slider.value).toBe("40");
  expect(bar.querySelector(".timeline-times")?.textContent).toBe("0:40.00 / 1:20.00");
});

test("a requested time is shown until the server has answered, and a held slider does not move", () => {
  const { slider, store, bar } = timeline({ time: 10 });
  store.set({ wishedTime: 60 });
  expect(slider.value).toBe("60");
  expect(bar.querySelector('[data-testid="replay-time"]')?.textContent).toBe("1:00.00");
  slider.dispatchEvent(new Event("pointerdown"));
  store.set({ wishedTime: null, time: 61 });
  expect(slider.value).toBe("60");
  slider.dispatchEvent(new Event("pointerup"));
  store.set({ time: 62 });
  expect(slider.value).toBe("62");
});

test("dragging the slider seeks", () => {
  const { app, slider } = timeline();
  const seek = vi.spyOn(app.replay, "seek").mockResolvedValue();
  slider.value = "33";
  slider.dispatchEvent(new Event("input"));
  expect(seek).toHaveBeenCalledWith(33);
});

test("the timeline's buttons send their requests", () => {
  const { app, named } = timeline();
  const step = vi.spyOn(app.replay, "step").mockImplementation(() => {});
  const toEnd = vi.spyOn(app.replay, "toEnd").mockImplementation(() => {});
  const play = vi.spyOn(app.replay, "playOrPause").mockResolvedValue();
  named("Previous recorded instant").click();
  named("Next recorded instant").click();
  expect(step.mock.calls).toEqual([[-1], [1]]);
  named("Go to the end").click();
  expect(toEnd).toHaveBeenCalledOnce();
  named("Play").click();
  expect(play).toHaveBeenCalledOnce();
});

test("the main button shows play or pause according to the phase", () => {
  const { named, store } = timeline();
  expect(named("Play").disabled).toBe(false);
  store.set({ status: simulationStatus("running") });
  expect(named("Pause")).not.toBeNull();
  store.set({ status: simulationStatus("finished") });
  expect(named("Play").disabled).toBe(false);
});

test("without a connection, the timeline's controls are disabled", () => {
  const { bar, store, slider } = timeline();
  store.set({ connection: { phase: "waiting", attempt: 1, retryAtMs: 0 } });
  expect(slider.disabled).toBe(true);
  expect(bar.querySelectorAll(".timeline-transport button:not(:disabled)")).toHaveLength(0);
});

test("a mark is at its time, shows the event literally, and goes to its time", () => {
  const events = [
    { time: 0, event: "started", robot: "", detail: "" },
    { time: 20, event: "agent_dead", robot: "a", detail: "<b>a</b>: killed" },
  ];
  const { app, bar } = timeline({ events });
  const seek = vi.spyOn(app.replay, "seek").mockResolvedValue();
  const [, death] = bar.querySelectorAll<HTMLElement>(".mark");
  expect(death?.style.getPropertyValue("--share")).toBe("0.25");
  expect(death?.classList.contains("bad")).toBe(true);
  expect(death?.textContent).toBe("0:20.00 agent dead · <b>a</b>: killed");
  death?.click();
  expect(seek).toHaveBeenCalledWith(20);
});

test("the speed is a listed one, or the initial one", () => {
  const { app, bar, store } = timeline();
  const choice = bar.querySelector("select")!;
  const setSpeed = vi.spyOn(app.replay, "setSpeed").mockResolvedValue();
  expect([...choice.options].map(({ text }) => text)).toEqual([
    "0.1×",
    "0.25×",
    "0.5×",
    "1×",
    "2×",
    "5×",
    "10×",
  ]);
  expect(choice.value).toBe("1");
  choice.value = "5";
  choice.dispatchEvent(new Event("change"));
  expect(setSpeed).toHaveBeenCalledWith(5);
  store.set({ replay: { ...REPLAY, speed: 3 } });
  expect(choice.value).toBe("3");
  expect(choice.options).toHaveLength(8);
});

test("the loop button shows its state", () => {
  const { named, store } = timeline();
  expect(named("Loop").getAttribute("aria-pressed")).toBe("false");
  store.set({ replay: { ...REPLAY, loop: true } });
  expect(named("Loop").getAttribute("aria-pressed")).toBe("true");
});

test("the status bar shows that it is a replay, and its speed", () => {
  const status = simulationStatus("paused", { mode: "lockstep", realTimeFactor: 0 });
  const bar = createStatusBar(timeline({ status, replay: { ...REPLAY, speed: 0.25 } }).app);
  expect(bar.querySelector('[data-testid="connection"]')?.textContent).toBe("Replay");
  expect(bar.querySelector('[data-testid="factor"]')?.textContent).toBe("0.25×");
});

test("Enter goes to a typed time, and an invalid time is marked", () => {
  const { app, bar } = timeline({ time: 10 });
  const seek = vi.spyOn(app.replay, "seek").mockResolvedValue();
  const field = bar.querySelector<HTMLInputElement>(".typed-time")!;
  const enter = (text: string) => {
    field.value = text;
    field.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter" }));
  };
  enter("soon");
  expect(field.getAttribute("aria-invalid")).toBe("true");
  expect(seek).not.toHaveBeenCalled();
  enter("1:05.5");
  expect(field.getAttribute("aria-invalid")).toBe("false");
  expect(seek).toHaveBeenCalledWith(65.5);
});

test('for a run the slider spans the kept history, shows "live", and goes to the time to which it is dragged', async () => {
  const { app, store } = testApp({ status: simulationStatus("running"), time: 42 });
  const bar = createTimeline(app);
  expect(bar.hidden).toBe(true);
  store.set({ kept: { start: 12, end: 41 } });
  expect(bar.hidden).toBe(false);
  const slider = bar.querySelector<HTMLInputElement>(".timeline-slider")!;
  expect([slider.min, slider.max, slider.value]).toEqual(["12", "42", "42"]);
  expect(slider.getAttribute("aria-label")).toBe("Time in the run");
  expect(bar.querySelector(".timeline-times")!.textContent).toBe("0:42.00 live");
  expect(bar.querySelector<HTMLElement>(".timeline-transport")!.hidden).toBe(true);
  expect(bar.querySelector<HTMLElement>(".live")!.hidden).toBe(true);
  const lookAt = vi.spyOn(app.past, "lookAt").mockResolvedValue();
  slider.value = "30";
  slider.dispatchEvent(new Event("input"));
  expect(lookAt).toHaveBeenCalledWith(30);
});

test("in the past of a run, a press on Live returns to the present", () => {
  const { app, bar } = timeline({ inPast: true, kept: { start: 0, end: 80 } });
  const goLive = vi.spyOn(app.past, "goLive").mockImplementation(() => {});
  const live = bar.querySelector<HTMLButtonElement>(".live")!;
  expect(live.hidden).toBe(false);
  live.click();
  expect(goLive).toHaveBeenCalledOnce();
  expect(bar.querySelector(".timeline-times")!.textContent).toContain("of the run");
});

test("notes are listed, visited and removed; a new note has the shown time", async () => {
  const note = { id: 7, time: 12, text: "<b>slow</b>" };
  const { app, bar } = timeline({
    notes: [note],
    time: 20,
    abilities: { creates: false, records: false, recordings: true, recording: "run.mcap" },
  });
  const list = bar.querySelector(".note-list")!;
  expect(list.textContent).toContain("0:12.00<b>slow</b>");
  const lookAt = vi.spyOn(app.past, "lookAt").mockResolvedValue();
  list.querySelector<HTMLButtonElement>('[title="Go to this time"]')!.click();
  expect(lookAt).toHaveBeenCalledWith(12);
  const remove = vi.spyOn(app.notes, "remove").mockResolvedValue(true);
  list.querySelector<HTMLButtonElement>('[aria-label="Remove the note at 0:12.00"]')!.click();
  expect(remove).toHaveBeenCalledWith(7);
  const add = vi.spyOn(app.notes, "add").mockResolvedValue(true);
  const form = bar.querySelector<HTMLFormElement>(".note-form")!;
  expect(form.querySelector("button")!.textContent).toBe("Add at 0:20.00");
  form.querySelector("input")!.value = "  look  ";
  form.dispatchEvent(new Event("submit", { cancelable: true }));
  expect(add).toHaveBeenCalledWith("look");
});

test("the menu shows where two recordings differ, and goes there", () => {
  const difference = { isEqual: false, time: 3.2, text: "pebble: at 3.2 s /gsv/poses differs\n" };
  const { app, bar } = timeline({
    abilities: { creates: false, records: false, recordings: true, recording: "run.mcap" },
    comparison: { recording: "old.mcap", simulation: "x", scene: null, difference, problem: "" },
  });
  expect(bar.querySelector(".compare-verdict")!.textContent).toBe(
    "First difference from old.mcap at 0:03.20:\npebble: at 3.2 s /gsv/poses differs",
  );
  const lookAt = vi.spyOn(app.past, "lookAt").mockResolvedValue();
  [...bar.querySelectorAll("button")].find(({ textContent }) => textContent === "Go to the first difference")!.click();
  expect(lookAt).toHaveBeenCalledWith(3.2);
});
