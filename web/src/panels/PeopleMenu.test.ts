// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { People } from "../api/ViewersApi";
import { simulationStatus, testApp } from "./testApp";
import { createControlQuestion, createPeopleMenu } from "./PeopleMenu";
import { createToolbar } from "./Toolbar";

const BOTH: People = {
  viewers: [
    { number: 1, name: "Ada" },
    { number: 2, name: "<b>Bob</b>" },
  ],
  you: 1,
  holder: 0,
  asking: [],
  passesIn: 0,
};

function page(people: Partial<People> = {}) {
  const { app, store } = testApp({ people: { ...BOTH, ...people }, status: simulationStatus("running") });
  const menu = createPeopleMenu(app);
  const lines = () => [...menu.querySelectorAll("li")].map((line) => line.textContent);
  const button = () => [...menu.querySelectorAll("button")].at(-1)!;
  return { app, store, menu, lines, button };
}

test("all who watch are listed by name, whatever it looks like", () => {
  const { lines, menu } = page({ holder: 2 });
  expect(lines()).toEqual(["Ada · you", "<b>Bob</b> · holds control"]);
  expect(menu.querySelector("b")).toBeNull();
  expect(menu.querySelector("button")!.title).toBe("Viewers (<b>Bob</b> holds control)");
});

test("control is taken, asked for, and let go of", () => {
  const { app, store, button } = page();
  const want = vi.spyOn(app.people, "want").mockResolvedValue();
  const steps: [Partial<People>, string, boolean][] = [
    [{}, "Take control", true],
    [{ holder: 1 }, "Let go of control", false],
    [{ holder: 2 }, "Ask for control", true],
    [{ holder: 2, asking: [1] }, "Ask no more", false],
  ];
  for (const [people, label, wants] of steps) {
    store.set({ people: { ...BOTH, ...people } });
    expect(button().textContent).toBe(label);
    button().click();
    expect(want).toHaveBeenLastCalledWith(wants);
  }
});

test("the holder is told who asks, and answers", () => {
  const { app, store } = page({ holder: 1 });
  const answer = vi.spyOn(app.people, "answer").mockResolvedValue();
  const card = createControlQuestion(app);
  expect(card.hidden).toBe(true);
  store.set({ people: { ...BOTH, holder: 1, asking: [2], passesIn: 19.2 } });
  expect(card.textContent).toContain("<b>Bob</b> asks for control. It passes in 20 s.");
  const [give, keep] = card.querySelectorAll("button");
  give!.click();
  expect(answer).toHaveBeenLastCalledWith(true);
  keep!.click();
  expect(answer).toHaveBeenLastCalledWith(false);
  store.set({ people: { ...BOTH, holder: 2, asking: [1] } });
  expect(card.hidden).toBe(true);
});

test("while somebody else holds control the buttons rest", () => {
  const { app, store } = testApp({ status: simulationStatus("running"), people: BOTH });
  const bar = createToolbar(app, true, () => {});
  const pause = bar.querySelector<HTMLButtonElement>(".main-action")!;
  expect(pause.disabled).toBe(false);
  store.set({ people: { ...BOTH, holder: 2 } });
  expect(pause.disabled).toBe(true);
});
