import { expect, test, vi } from "vitest";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { NotesControl, canNote } from "./NotesControl";

const REPLAY = { start: 0, end: 40, speed: 1, loop: false };
const ABILITIES = { creates: false, records: false, recordings: true, recording: "run.mcap" };
const ADA = { number: 1, name: "Ada", simulation: "house", holds: true, asks: 0 };

function notes(state: Partial<State>) {
  const store = new Store<State>({ ...initialState, simulation: "house", time: 12.5, ...state });
  const api = {
    notesOf: vi.fn(async () => [{ id: 1, time: 2, text: "here" }]),
    addNoteTo: vi.fn(async () => {}),
    removeNote: vi.fn(async () => {}),
    addNote: vi.fn(async () => {}),
  };
  const control = new NotesControl(store, api);
  control.start();
  return { store, api, control };
}

test("the notes of a recording are read with it, and saved beside it", async () => {
  const { store, api, control } = notes({ replay: REPLAY, abilities: ABILITIES });
  await vi.waitFor(() => expect(store.get().notes).toEqual([{ id: 1, time: 2, text: "here" }]));
  expect(await control.add("slow")).toBe(true);
  expect(api.addNoteTo).toHaveBeenCalledWith("run.mcap", 12.5, "slow", "");
  expect(await control.remove(1)).toBe(true);
  expect(api.removeNote).toHaveBeenCalledWith("run.mcap", 1);
  expect(api.notesOf).toHaveBeenCalledTimes(3);
});

test("a note on a run belongs to the simulation and has the viewer's name, also in the past", async () => {
  const people = { viewers: [ADA], you: 1 } as unknown as State["people"];
  const { store, api, control } = notes({ people, replay: REPLAY, inPast: true, abilities: ABILITIES });
  expect(await control.add("slow")).toBe(true);
  expect(api.addNote).toHaveBeenCalledWith("house", 12.5, "slow", "Ada");
  expect(store.get().events).toEqual([{ time: 12.5, event: "note", robot: "", detail: "Ada: slow" }]);
});

test("a refusal is shown, and the text is not lost", async () => {
  const { store, api, control } = notes({ replay: REPLAY, abilities: ABILITIES });
  api.addNoteTo.mockRejectedValueOnce(new Error("Ada has control"));
  expect(await control.add("slow")).toBe(false);
  expect(store.get().notices.at(-1)!.sentence).toBe("Ada has control");
});

test("a recording without a name here cannot have notes", () => {
  const state = { ...initialState, simulation: "house", replay: REPLAY };
  expect(canNote(state)).toBe(false);
  expect(canNote({ ...state, abilities: ABILITIES })).toBe(true);
  expect(canNote({ ...state, replay: null })).toBe(true);
});
