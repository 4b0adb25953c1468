// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { CommandDescription } from "../../api/commands";
import type { State } from "../../state/State";
import { testPorts } from "../contract/testPorts";
import { mount } from "./CommandsPanel";

const Z = { name: "z", type: "number", unit: "m/s²", summary: "acceleration", isRequired: false } as const;
const COMMANDS: CommandDescription[] = [
  { name: "pause", summary: "Pause a simulation", parameters: [] },
  {
    name: "set_gravity",
    summary: "Set gravity",
    parameters: [{ ...Z, minimum: -100, maximum: 100, otherwise: "the world's" }],
  },
];

async function opened(state: Partial<State> = {}, list = vi.fn(async () => COMMANDS)) {
  const { ports, store } = testPorts(state);
  const run = vi.fn(async () => {});
  const { body, whileOpen } = mount({ ...ports, commands: { list, run } });
  document.body.replaceChildren(body);
  const close = whileOpen!();
  await vi.waitFor(() => expect(list).toHaveBeenCalled());
  await Promise.resolve();
  const form = (title: string) =>
    [...body.querySelectorAll("form")].find((each) => each.querySelector("button")!.textContent === title)!;
  return { body, close, form, list, run, store };
}

test("each command is a form with its parameters' units and ranges", async () => {
  const { body, form, list } = await opened();
  expect(list).toHaveBeenCalledWith("house");
  expect([...body.querySelectorAll("button")].map(({ textContent }) => textContent)).toEqual(["Pause", "Set gravity"]);
  const label = form("Set gravity").querySelector("label")!;
  expect(label.textContent).toBe("z (m/s²) ");
  const { type, min, max, placeholder, required, title } = label.querySelector("input")!;
  expect({ type, min, max, placeholder, required, title }).toEqual({
    type: "number",
    min: "-100",
    max: "100",
    placeholder: "the world's",
    required: false,
    title: "acceleration, from -100 to 100",
  });
});

test("a command is sent with the typed values, and its answer is shown beside it", async () => {
  const { form, run } = await opened();
  const gravity = form("Set gravity");
  gravity.requestSubmit();
  await vi.waitFor(() => expect(gravity.querySelector("output")!.textContent).toBe("Done."));
  expect(run).toHaveBeenLastCalledWith("house", "set_gravity", {});
  gravity.querySelector("input")!.value = "-1.62";
  run.mockRejectedValueOnce(new Error("to edit its world it must be paused"));
  gravity.requestSubmit();
  await vi.waitFor(() => expect(gravity.querySelector("output")!.textContent).toMatch("must be paused"));
  expect(run).toHaveBeenLastCalledWith("house", "set_gravity", { z: -1.62 });
});

test("buttons work only while the viewer may act", async () => {
  const { form, store } = await opened();
  expect(form("Pause").querySelector("button")!.disabled).toBe(false);
  store.set({ connection: { phase: "waiting", attempt: 1, retryAtMs: 0 } });
  expect(form("Pause").querySelector("button")!.disabled).toBe(true);
});

test("another simulation's commands replace these, and a refusal is shown", async () => {
  const { body, list, store, close } = await opened();
  list.mockRejectedValueOnce(new Error("there is no simulation 'yard'"));
  store.set({ simulation: "yard" });
  await vi.waitFor(() => expect(body.textContent).toBe("there is no simulation 'yard'"));
  expect(list).toHaveBeenLastCalledWith("yard");
  close();
  store.set({ simulation: "house" });
  expect(list).toHaveBeenCalledTimes(2);
});
