// @vitest-environment jsdom
import { expect, test } from "vitest";
import type { State } from "../../state/State";
import { Store } from "../../state/Store";
import { testPorts } from "../contract/testPorts";
import type { Diagnosis, Diagnostics } from "./diagnostics";
import { NO_DIAGNOSTICS } from "./diagnostics";
import { mount, panelOf } from "./DiagnosticsPanel";

const WELL: Diagnosis = { name: "a", health: "ok", message: "running", values: [] };

function open(diagnostics: Partial<Diagnostics>, state: Partial<State> = {}) {
  const store = new Store<Diagnostics>({ ...NO_DIAGNOSTICS, ...diagnostics });
  const { body: panel, whileOpen } = panelOf(store, testPorts(state).ports.state, () => () => {});
  whileOpen!();
  const texts = (title: string) => {
    const part = [...panel.querySelectorAll(".facts")].find((each) => each.querySelector("h2")!.textContent === title)!;
    return [...part.querySelectorAll("dt")].map((dt) => [dt.textContent, dt.nextElementSibling!.textContent]);
  };
  return { store, panel, texts };
}

test("the behaviour that delays the simulation is shown with late steps and factor", () => {
  const simulation: Diagnosis = {
    name: "simulation",
    health: "warning",
    message: "running, waits for <b>x</b>",
    values: [["late steps", "7"]],
  };
  const { panel, texts } = open({ simulation });
  expect(texts("Simulation")).toEqual([
    ["state", "running, waits for <b>x</b>"],
    ["late steps", "7"],
  ]);
  expect(panel.querySelector("dt.warning")).not.toBeNull();
  expect(panel.querySelector("b")).toBeNull();
});

test("robots with problems are listed, worst first, and the others are counted", () => {
  const { store, texts } = open({
    robots: [
      WELL,
      { ...WELL, name: "slow", health: "warning", message: "unresponsive" },
      { ...WELL, name: "gone", health: "error", message: "dead: killed" },
    ],
  });
  expect(texts("Robots")).toEqual([
    ["gone", "dead: killed"],
    ["slow", "unresponsive"],
    ["", "The other robot is OK."],
  ]);
  store.set({ robots: [WELL, WELL] });
  expect(texts("Robots")).toEqual([["", "2 robots OK."]]);
});

test("reported metrics of the server and of this page are shown, and missing ones omitted", () => {
  const serverWarnings = ["camera: there is nothing to draw with"];
  const diagnostics = {
    dropped: 12,
    server: new Map([
      ["gsv_viewers", 3],
      ["gsv_uptime_seconds", 100],
      ["process_cpu_seconds_total", 50],
      ["process_open_fds", 20],
      ["process_max_fds", 1024],
    ]),
  };
  const { texts } = open(diagnostics, { serverWarnings });
  expect(texts("Warnings of the server")).toEqual([["", "camera: there is nothing to draw with"]]);
  expect(texts("This page")).toContainEqual(["updates dropped for this page", "12"]);
  expect(texts("Server")).toEqual([
    ["viewers", "3"],
    ["processor", "50 % of a core, on average"],
    ["open files", "20 of 1024"],
    ["running for", "100 s"],
  ]);
});

test("the data of one simulation is not shown for another", () => {
  const { ports, store, topics } = testPorts();
  const { body, whileOpen } = mount(ports);
  whileOpen!();
  topics.send("/diagnostics", { status: [{ level: 0, name: "simulation", message: "running", values: [] }] });
  expect(body.textContent).toContain("running");
  store.set({ simulation: "yard" });
  expect(body.textContent).not.toContain("running");
});
