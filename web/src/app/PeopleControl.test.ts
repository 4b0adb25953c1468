import { expect, test, vi } from "vitest";
import { ApiError } from "../api/JsonServer";
import type { People, Person, ViewersApi } from "../api/ViewersApi";
import { NO_PEOPLE } from "../state/people";
import { initialState } from "../state/State";
import type { State } from "../state/State";
import { Store } from "../state/Store";
import { PeopleControl } from "./PeopleControl";

const ADA: Person = { number: 3, name: "Ada", simulation: "house", holds: false, asks: 0, passesIn: 0 };
const BOB: Person = { ...ADA, number: 4, name: "Bob" };
const ALONE: People = { viewers: [ADA], you: 3 };

function control(people: () => Promise<People>) {
  const store = new Store<State>({ ...initialState, simulation: "house" });
  const enter = vi.fn(async () => {});
  const turn = vi.fn(async (_simulation: string) => ALONE);
  const storage = new Map([["gsv-name", "Ada"]]);
  const kept = { getItem: (key: string) => storage.get(key) ?? null, setItem: () => {} };
  const topics = new Map<string, (message: { data: string }) => void>();
  const session = {
    subscribe: <Message>(topic: string, handler: (message: Message) => void) => {
      topics.set(topic, handler as never);
      return () => topics.delete(topic);
    },
  };
  const api = { enter, people, turn } as unknown as ViewersApi;
  const sentences = () => store.get().notices.map(({ sentence }) => sentence);
  return { store, enter, turn, topics, sentences, control: new PeopleControl(store, session, api, kept) };
}

test("the name is sent once, and again if the server has lost it", async () => {
  const people = vi.fn(async () => ALONE);
  const { store, enter, control: it } = control(people);
  await it.load();
  await it.load();
  expect(enter.mock.calls).toEqual([["Ada", "house"]]);
  expect(store.get().people).toEqual(ALONE);
  people.mockResolvedValueOnce(NO_PEOPLE);
  await it.load();
  await it.load();
  expect(enter).toHaveBeenCalledTimes(2);
});

test("a change to another simulation is reported once", async () => {
  const { store, turn, control: it } = control(async () => ALONE);
  await it.load();
  store.set({ simulation: "cafe" });
  await it.load();
  await it.load();
  store.set({ simulation: null });
  await it.load();
  expect(turn.mock.calls).toEqual([["cafe"], [""]]);
});

test("gaining or losing control of the shown simulation is reported", async () => {
  const people = vi.fn(async () => ALONE);
  const { sentences, control: it } = control(people);
  await it.load();
  const holding = { ...ADA, holds: true };
  people.mockResolvedValueOnce({ viewers: [holding, { ...BOB, simulation: "cafe", holds: true }], you: 3 });
  await it.load();
  people.mockResolvedValueOnce({ viewers: [ADA, { ...BOB, holds: true }], you: 3 });
  await it.load();
  expect(sentences()).toEqual(["You have control.", "Bob has control now."]);
});

test("a change of control is reported by the stream at once", async () => {
  const { store, topics, sentences, control: it } = control(async () => ALONE);
  vi.useFakeTimers();
  it.start(new EventTarget() as Window);
  await vi.advanceTimersByTimeAsync(0);
  expect(topics.size).toBe(0);
  store.set({ scene: { name: "house", layoutVersion: 1 } as State["scene"] });
  const viewers = [{ number: 3, name: "Ada", simulation: "house", holds_control: true }];
  topics.get("/gsv/viewers")!({ data: JSON.stringify({ viewers, you: 0 }) });
  expect(store.get().people).toEqual({ viewers: [{ ...ADA, holds: true }], you: 3 });
  expect(sentences()).toEqual(["You have control."]);
  vi.useRealTimers();
});

test("if the server has no list of viewers, all viewers have control", async () => {
  const { store, control: it } = control(async () => Promise.reject(new ApiError(404, "nothing here")));
  await it.load();
  expect(store.get().people).toEqual(NO_PEOPLE);
});
