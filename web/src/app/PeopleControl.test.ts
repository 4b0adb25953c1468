import { expect, test, vi } from "vitest";
import { ApiError } from "../api/JsonServer";
import type { People, ViewersApi } from "../api/ViewersApi";
import { NO_PEOPLE } from "../state/people";
import { initialState } from "../state/State";
import type { State } from "../state/State";
import { Store } from "../state/Store";
import { PeopleControl } from "./PeopleControl";

const ALONE: People = { ...NO_PEOPLE, viewers: [{ number: 3, name: "Ada" }], you: 3 };

function control(people: () => Promise<People>) {
  const store = new Store<State>(initialState);
  const enter = vi.fn(async () => {});
  const storage = new Map([["gsv-name", "Ada"]]);
  const kept = { getItem: (key: string) => storage.get(key) ?? null, setItem: () => {} };
  return { store, enter, control: new PeopleControl(store, { enter, people } as unknown as ViewersApi, kept) };
}

test("the name is said once, and again when the server knows it no more", async () => {
  const people = vi.fn(async () => ALONE);
  const { store, enter, control: it } = control(people);
  await it.load();
  await it.load();
  expect(enter.mock.calls).toEqual([["Ada"]]);
  expect(store.get().people).toEqual(ALONE);
  people.mockResolvedValueOnce(NO_PEOPLE);
  await it.load();
  await it.load();
  expect(enter).toHaveBeenCalledTimes(2);
});

test("who gets or loses control is told", async () => {
  const people = vi.fn(async () => ALONE);
  const { store, control: it } = control(people);
  await it.load();
  people.mockResolvedValueOnce({ ...ALONE, holder: 3 });
  await it.load();
  const bob = { number: 4, name: "Bob" };
  people.mockResolvedValueOnce({ ...ALONE, viewers: [...ALONE.viewers, bob], holder: 4 });
  await it.load();
  expect(store.get().notices.map(({ sentence }) => sentence)).toEqual([
    "You hold control.",
    "Bob holds control now.",
  ]);
});

test("a server that knows no viewers lets all act", async () => {
  const { store, control: it } = control(async () => Promise.reject(new ApiError(404, "nothing here")));
  await it.load();
  expect(store.get().people).toEqual(NO_PEOPLE);
});
