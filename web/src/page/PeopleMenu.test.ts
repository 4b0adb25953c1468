// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { Person } from "../api/ViewersApi";
import { simulationStatus, testApp } from "./testApp";
import { createControlQuestion, createPeopleMenu } from "./PeopleMenu";
import { createToolbar } from "./Toolbar";

const ADA: Person = { number: 1, name: "Ada", simulation: "house", holds: false, asks: 0, passesIn: 0 };
const BOB: Person = { ...ADA, number: 2, name: "<b>Bob</b>" };

// The test's page is the viewer Ada.
const people = (ada: Partial<Person> = {}, bob: Partial<Person> = {}) => ({
  people: { viewers: [{ ...ADA, ...ada }, { ...BOB, ...bob }], you: 1 },
});

function page(ada: Partial<Person> = {}, bob: Partial<Person> = {}) {
  const { app, store } = testApp({ ...people(ada, bob), status: simulationStatus("running") });
  const menu = createPeopleMenu(app);
  const lines = () => [...menu.querySelectorAll("li")].map((line) => line.textContent);
  const button = () => [...menu.querySelectorAll("button")].at(-1)!;
  return { app, store, menu, lines, button };
}

test("all viewers are listed by name, with any characters", () => {
  const { lines, menu } = page({}, { holds: true });
  expect(lines()).toEqual(["Ada · you", "<b>Bob</b> · has control"]);
  expect(menu.querySelector("b")).toBeNull();
  expect(menu.querySelector("button")!.title).toBe("Viewers (<b>Bob</b> has control)");
});

test("control is taken, requested and released", () => {
  const { app, store, button } = page();
  const want = vi.spyOn(app.people, "want").mockResolvedValue();
  const steps: [Partial<Person>, Partial<Person>, string, boolean][] = [
    [{}, {}, "Take control", true],
    [{ holds: true }, {}, "Release control", false],
    [{}, { holds: true }, "Ask for control", true],
    [{ asks: 1 }, { holds: true }, "Cancel request", false],
    [{}, { holds: true, simulation: "cafe" }, "Take control", true],
  ];
  for (const [ada, bob, label, wants] of steps) {
    store.set(people(ada, bob));
    expect(button().textContent).toBe(label);
    button().click();
    expect(want).toHaveBeenLastCalledWith(wants);
  }
});

test("viewers of other simulations come last, and a viewer of none cannot take control", () => {
  const { store, lines, button } = page({}, { simulation: "cafe", holds: true });
  expect(lines()).toEqual(["Ada · you", "<b>Bob</b> · at cafe · has control"]);
  store.set(people({ simulation: "" }));
  expect(button().hidden).toBe(true);
});

test("the holder sees who requests control, and answers", () => {
  const { app, store } = page({ holds: true });
  const answer = vi.spyOn(app.people, "answer").mockResolvedValue();
  const card = createControlQuestion(app);
  expect(card.hidden).toBe(true);
  store.set(people({ holds: true }, { asks: 1, passesIn: 19.2 }));
  expect(card.textContent).toContain("<b>Bob</b> asks for control, and gets it in 20 s if you do not answer.");
  const [give, keep] = card.querySelectorAll("button");
  give!.click();
  expect(answer).toHaveBeenLastCalledWith(true);
  keep!.click();
  expect(answer).toHaveBeenLastCalledWith(false);
  store.set(people({ asks: 1 }, { holds: true }));
  expect(card.hidden).toBe(true);
});

test("the buttons are disabled while another viewer has control", () => {
  const { app, store } = testApp({ status: simulationStatus("running"), ...people() });
  const bar = createToolbar(app, () => {});
  const pause = bar.querySelector<HTMLButtonElement>(".main-action")!;
  expect(pause.disabled).toBe(false);
  store.set(people({}, { holds: true }));
  expect(pause.disabled).toBe(true);
});
