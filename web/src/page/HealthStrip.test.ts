// @vitest-environment jsdom
import { expect, test } from "vitest";
import type { Expectation } from "../state/expectations";
import { healthOf } from "../state/health";
import { createHealthStrip } from "./HealthStrip";
import { robotStatus, simulationStatus, testApp } from "./testApp";

const STATUS = simulationStatus("running", { robots: ["a", "b", "c", "d"].map((name) => robotStatus(name)) });

function health(states: Record<string, string>, command = 0) {
  const robots = Object.entries(states).map(([robot, state]) => ({
    robot,
    state,
    level: 1,
    since: { sec: 0, nsec: 0 },
    command_linear_m_s: command,
    command_lateral_m_s: 0,
    command_angular_rad_s: 0,
    linear_m_s: 0,
    angular_rad_s: 0,
    limit_sensor: "",
    limit_value: 0,
    limit_unit: "",
    contact: "",
    summary: "",
    reason: "",
  }));
  const counts = { moving: 0, standing: 0, stuck: 0, contact: 0, dead: 0, late: 0 };
  return healthOf({ stamp: { sec: 1, nsec: 0 }, step: 1n, stuck_after_s: 5, ...counts, robots });
}

function strip(state: Parameters<typeof testApp>[0]) {
  const { app, store } = testApp({ status: STATUS, ...state });
  const made = createHealthStrip(app);
  const chips = () =>
    [...made.querySelectorAll<HTMLElement>("button[data-state]")].filter(({ hidden }) => !hidden).map(({ textContent }) => textContent);
  return { app, store, made, chips };
}

test("it counts the robots in each state, and omits empty states", () => {
  expect(strip({ health: health({ b: "stuck", c: "dead" }) }).chips()).toEqual(["2 moving", "1 dead", "1 stuck"]);
  expect(strip({ health: health({}) }).chips()).toEqual(["4 moving"]);
  const told = strip({ health: health({ a: "standing" }, 0.3) });
  expect(told.chips()).toEqual(["3 moving", "1 commanded to move, but standing"]);
});

test("a click on a state shows only its robots, and a second click shows all", () => {
  const { store, made } = strip({ health: health({ b: "stuck" }) });
  const chip = made.querySelector<HTMLElement>('[data-state="stuck"]')!;
  chip.click();
  expect(store.get().robotFilter.state).toBe("stuck");
  expect(chip.getAttribute("aria-pressed")).toBe("true");
  chip.click();
  expect(store.get().robotFilter.state).toBeNull();
});

test("expectations are summarised, and a click opens their panel", () => {
  const expectation = (verdict: string) => ({ verdict, name: "", bodies: [], places: [], boxes: [] }) as unknown as Expectation;
  const { store, made } = strip({ health: health({}), expectations: ["holds", "pending", "holds"].map(expectation) });
  const verdict = made.querySelector<HTMLElement>(".verdict")!;
  expect(verdict.textContent).toBe("Expectations: 2 of 3 held");
  store.set({ expectations: ["holds", "violated"].map(expectation) });
  expect(verdict.textContent).toBe("Expectations: 1 of 2 violated");
  verdict.click();
  expect(store.get().openPanels).toContain("expectations");
});

test("it is hidden if states are not reported", () => {
  expect(strip({ health: null }).made.hidden).toBe(true);
});
