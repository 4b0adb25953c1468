// @vitest-environment jsdom
import { expect, test } from "vitest";
import type { State } from "../../state/State";
import { testPorts } from "../contract/testPorts";
import { mount } from "./StatusPanel";

function robot(name: string, more: object = {}) {
  return { name, model: "b21r", behaviour: "wander", agent_state: "waiting", detail: "", distance_m: 1.5, collisions: 2n, ...more };
}

function message(more: object = {}) {
  return {
    stamp: { sec: 6, nsec: 0 },
    step: 600n,
    state: "running",
    mode: "real_time",
    real_time_factor: 0.5,
    target_factor: 2,
    late_steps: 0n,
    waiting_for: "",
    robots: [robot("a")],
    ...more,
  };
}

function opened(state: Partial<State> = {}) {
  const { ports, store, topics } = testPorts(state);
  const { body, whileOpen } = mount(ports);
  const close = whileOpen!();
  const facts = (title: string) => {
    const part = [...body.querySelectorAll(".facts")].find((each) => each.querySelector("h2")!.textContent === title)!;
    return Object.fromEntries(
      [...part.querySelectorAll("dt")].map((dt) => [dt.textContent, dt.nextElementSibling!.textContent]),
    );
  };
  const rows = () =>
    [...body.querySelectorAll("tbody tr")].map((row) => [...row.children].map(({ textContent }) => textContent));
  return { body, close, facts, rows, ports, store, topics };
}

test("the state of the simulation is shown", () => {
  const { facts, topics, body } = opened();
  expect(body.textContent).toContain("Waiting for /gsv/status.");
  topics.send("/gsv/status", message({ late_steps: 3n, waiting_for: "a (wander)" }));
  expect(facts("Simulation")).toEqual({
    state: "Running",
    mode: "real time",
    "simulated time": "0:06.00",
    step: "600",
    "actual real-time factor": "0.50×",
    "target real-time factor": "2.00×",
    "late steps": "3",
    "waiting for": "a (wander)",
  });
  topics.send("/gsv/status", message({ state: "paused", mode: "lockstep" }));
  expect(facts("Simulation")).toMatchObject({ state: "Paused", mode: "lockstep", "waiting for": "nobody" });
});

test("each robot has a row, markup in it is text, and a click on its name selects it", () => {
  const { body, rows, topics, ports } = opened();
  const detail = "<b>killed</b>";
  topics.send("/gsv/status", message({ robots: [robot("a", { behaviour: "" }), robot("b", { agent_state: "dead", detail })] }));
  expect(rows()).toEqual([
    ["a", "b21r", "none", "waiting", "1.50 m", "2", ""],
    ["b", "b21r", "wander", "dead", "1.50 m", "2", detail],
  ]);
  expect(body.querySelector("b")).toBeNull();
  body.querySelectorAll<HTMLButtonElement>("tbody button")[1]!.click();
  expect(ports.robots.select).toHaveBeenCalledWith("b");
  topics.send("/gsv/status", message({ robots: [robot("b")] }));
  expect(rows().map(([name]) => name)).toEqual(["b"]);
});

test("of very many robots, the first are shown with the number of the others", () => {
  const { body, rows, topics } = opened();
  topics.send("/gsv/status", message({ robots: Array.from({ length: 500 }, (_, i) => robot(`r${i}`)) }));
  expect(rows()).toHaveLength(200);
  expect(body.textContent).toContain("300 more robots.");
});

test("the page's data about the server is shown too", () => {
  const simulations = ["house", "yard"].map((name) => ({ name, phase: "running", robots: 0 }) as const);
  const { facts, store, body } = opened({ simulations });
  expect(facts("Server")).toMatchObject({ simulations: "house, yard", viewers: "0", "in control": "nobody" });
  store.set({ connection: { phase: "waiting", attempt: 1, retryAtMs: 0 } });
  expect(body.textContent).toContain("Not connected. The page reconnects automatically.");
});

test("it subscribes only while it is open, and is cleared for another simulation", () => {
  const { close, topics, store, rows } = opened();
  topics.send("/gsv/status", message());
  expect(rows()).toHaveLength(1);
  store.set({ simulation: "yard" });
  expect(rows()).toEqual([]);
  expect(topics.read).toEqual(["/gsv/status"]);
  close();
  expect(topics.read).toEqual([]);
});
