// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { createRecordButton } from "../page/RecordButton";
import { testApp } from "../page/testApp";
import { initialState } from "../state/State";

const OFF = { isOn: false, path: "", bytes: 0, droppedMessages: 0 };
const ON = { isOn: true, path: "/tmp/a run.mcap", bytes: 2_400_000, droppedMessages: 0 };

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

async function recording(first = OFF) {
  const api = { recording: vi.fn(async () => first), record: vi.fn(async () => ON) };
  const { app, store } = testApp({ abilities: { ...initialState.abilities, records: true } }, api);
  const place = createRecordButton(app);
  const button = place.querySelector("button")!;
  app.records.start();
  await vi.advanceTimersByTimeAsync(0);
  return { api, app, store, place, button };
}

test("the button shows a recording of another viewer and its size", async () => {
  const { api, button } = await recording();
  expect(button.hidden).toBe(false);
  expect(button.getAttribute("aria-pressed")).toBe("false");
  api.recording.mockResolvedValue(ON);
  await vi.advanceTimersByTimeAsync(2000);
  expect(button.getAttribute("aria-pressed")).toBe("true");
  expect(button.querySelector(".number")!.textContent).toBe("2.4 MB");
});

test("one click starts recording, and another one ends it and explains the replay", async () => {
  const { api, app, store } = await recording();
  app.records.press();
  await vi.advanceTimersByTimeAsync(0);
  expect(api.record).toHaveBeenLastCalledWith("house", true);
  expect(store.get().recording).toEqual(ON);
  api.record.mockResolvedValue({ ...ON, isOn: false });
  app.records.press();
  await vi.advanceTimersByTimeAsync(0);
  expect(api.record).toHaveBeenLastCalledWith("house", false);
  expect(store.get().notices.at(-1)!.sentence).toBe("Recording saved. Replay it on the page Recordings, or with: gsv replay '/tmp/a run.mcap'");
});

test("there is no record button in a replay, or if the server does not support recording", async () => {
  const { store, button } = await recording();
  store.set({ replay: { start: 0, end: 1, speed: 1, loop: false } });
  expect(button.hidden).toBe(true);
  store.set({ replay: null, abilities: initialState.abilities });
  await vi.advanceTimersByTimeAsync(2000);
  expect(button.hidden).toBe(true);
});

test("a refusal of the server is shown", async () => {
  const { api, app, store } = await recording();
  api.record.mockRejectedValueOnce(new Error("the disk is full"));
  app.records.press();
  await vi.advanceTimersByTimeAsync(0);
  expect(store.get().notices.at(-1)!.sentence).toBe("the disk is full");
  expect(store.get().recording).toEqual(OFF);
});

test("a recording that this page did not start ends only after confirmation", async () => {
  const { api, app, store, place } = await recording(ON);
  const card = place.querySelector<HTMLElement>(".record-question")!;
  expect(card.hidden).toBe(true);
  app.records.press();
  expect(api.record).not.toHaveBeenCalled();
  expect(card.hidden).toBe(false);
  expect(card.textContent).toContain("/tmp/a run.mcap");
  const answer = (label: string) => [...card.querySelectorAll("button")].find((each) => each.textContent === label)!.click();
  answer("Continue recording");
  expect(card.hidden).toBe(true);
  expect(api.record).not.toHaveBeenCalled();
  app.records.press();
  answer("End recording");
  await vi.advanceTimersByTimeAsync(0);
  expect(api.record).toHaveBeenCalledWith("house", false);
  expect(store.get().stopRecordingAsked).toBe(false);
});

test("the past of a run is not asked for its recording", async () => {
  const { api, store } = await recording();
  await vi.advanceTimersByTimeAsync(1500);
  let respond = (_: typeof OFF) => {};
  api.recording.mockReturnValueOnce(new Promise((resolve) => (respond = resolve)));
  await vi.advanceTimersByTimeAsync(1500); // a request is under way when the replay begins
  store.set({ replay: { start: 0, end: 1, speed: 1, loop: false } });
  api.recording.mockClear();
  respond(OFF);
  await vi.advanceTimersByTimeAsync(10_000);
  expect(api.recording).not.toHaveBeenCalled();
});
