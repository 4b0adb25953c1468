// @vitest-environment jsdom
import { expect, test } from "vitest";
import type { SimulationStatus } from "../../api/status";
import type { Health, RobotHealth } from "../../state/health";
import { body, scene } from "../../scene/testScene";
import { testPorts } from "../contract/testPorts";
import { createSceneTree } from "./SceneTree";

function robot(name: string, behaviour = "") {
  const agentPhase = behaviour ? "running" : "none";
  return { name, model: name, behaviour, agentPhase, detail: "", distance: 1.5, collisions: 0 };
}

test("a station is listed as such and counted separately from robots", () => {
  const robots = [robot("cart", "wander"), robot("post"), robot("tower", "watch")];
  const stations = ["post", "tower"].map((name) => body(name, { isRobot: false, isStation: true }));
  const { ports } = testPorts({
    scene: scene({ bodies: [body("cart"), ...stations] }),
    status: { robots } as unknown as SimulationStatus,
  });
  const tree = createSceneTree(ports, document.createElement("div"));
  expect(tree.querySelector("h2")!.textContent).toBe("1 robot, 2 sensor stations");
  const rows = [...tree.querySelectorAll(".robot")].map((row) => row.querySelector(".robot-behaviour")!.textContent);
  expect(rows).toEqual(["wander", "sensor station", "sensor station · watch"]);
});

function health(...robots: object[]): Health {
  const known = { level: 1, since: 3, command: { linear: 0.3, lateral: 0, angular: 0 }, actual: { linear: 0, angular: 0 } };
  const all = robots.map((each) => ({ ...known, limit: null, contact: "", summary: "is stuck", reason: "", ...each }) as RobotHealth);
  return { time: 10, stuckAfter: 5, robots: new Map(all.map((each) => [each.robot, each])) };
}

function crowd(count: number) {
  const robots = Array.from({ length: count }, (_, i) => robot(`r${i}`, "wander"));
  return { status: { robots } as unknown as SimulationStatus, time: 10 };
}

const names = (tree: HTMLElement) => [...tree.querySelectorAll<HTMLElement>("[data-robot]")].map(({ dataset }) => dataset.robot);

test("robots in trouble come first with the reason", () => {
  const { ports } = testPorts({ ...crowd(8), health: health({ robot: "r5", state: "stuck", reason: "sonar reads 0.2 m" }) });
  const tree = createSceneTree(ports, document.createElement("div"));
  expect(names(tree).slice(0, 3)).toEqual(["r5", "r0", "r1"]);
  const first = tree.querySelector(".robot")!;
  expect(first.querySelector(".robot-behaviour")!.textContent).toBe("is stuck for 7 s: sonar reads 0.2 m");
  expect(first.querySelector(".dot")!.getAttribute("data-state")).toBe("stuck");
});

test("the row of a robot in trouble has lines for its whole reason", () => {
  const reason = "commanded 0.4 m/s, touches kiosk_counter, sonar_01 reads 0.04 m";
  const { ports, store } = testPorts({ ...crowd(3), health: health({ robot: "r2", state: "stuck", reason }) });
  const tree = createSceneTree(ports, document.createElement("div"));
  const rows = () => [...tree.querySelectorAll<HTMLElement>(".robots > li")];
  const text = tree.querySelector<HTMLElement>('[data-robot="r2"] .robot-behaviour')!;
  expect(text.textContent).toBe(`is stuck for 7 s: ${reason}`);
  expect(text.style.getPropertyValue("--lines")).toBe("3");
  expect(text.closest("button")!.title).toBe(text.textContent);
  expect(rows().map(({ style }) => [style.transform, style.height])).toEqual([
    ["translateY(0px)", "84px"],
    ["translateY(84px)", "50px"],
    ["translateY(134px)", "50px"],
  ]);
  store.set({ health: health({ robot: "r2", state: "moving", level: 0 }) });
  expect(rows().map(({ style }) => style.height)).toEqual(["50px", "50px", "50px"]);
});

test("rows of a large crowd have one height, and heights do not change under the pointer", () => {
  const stuck = health({ robot: "r2", state: "stuck", reason: "a reason that is longer than one line of the list" });
  const large = testPorts({ ...crowd(101), health: stuck }).ports;
  const tree = createSceneTree(large, document.createElement("div"));
  expect(tree.querySelector<HTMLElement>(".robots > li")!.style.height).toBe("50px");
  const { ports, store } = testPorts(crowd(8));
  const small = createSceneTree(ports, document.createElement("div"));
  small.querySelector(".robot-scroll")!.dispatchEvent(new Event("pointerenter"));
  store.set({ health: stuck });
  expect([...small.querySelectorAll<HTMLElement>(".robots > li")].every(({ style }) => style.height === "50px")).toBe(true);
  small.querySelector(".robot-scroll")!.dispatchEvent(new Event("pointerleave"));
  expect(small.querySelector<HTMLElement>(".robots > li")!.style.height).not.toBe("50px");
});

test("a search shows the matching robots, and says if there are none", () => {
  const { ports } = testPorts(crowd(30));
  const tree = createSceneTree(ports, document.createElement("div"));
  const field = tree.querySelector<HTMLInputElement>("input[type=search]")!;
  const search = (text: string) => {
    field.value = text;
    field.dispatchEvent(new Event("input"));
  };
  search("/^r2\\d$/");
  expect(names(tree)).toHaveLength(10);
  search("nobody");
  expect(names(tree)).toHaveLength(0);
  expect(tree.querySelector<HTMLElement>(".robot-nothing")!.hidden).toBe(false);
  search("/[/");
  expect(tree.querySelector(".robot-problem")!.textContent).toContain("not a regular expression");
});

test("only the rows in sight exist, and a click on one selects its robot", () => {
  const { ports, store } = testPorts(crowd(5000));
  const tree = createSceneTree(ports, document.createElement("div"));
  expect(names(tree).length).toBeLessThan(40);
  tree.querySelector<HTMLElement>('[data-robot="r3"]')!.click();
  expect(ports.robots.select).toHaveBeenCalledWith("r3");
  store.set({ selection: "r4000" });
  expect(tree.querySelector('[data-robot="r4000"]')!.getAttribute("aria-pressed")).toBe("true");
});

test("the up and down keys move between robots", () => {
  const { ports } = testPorts(crowd(30));
  const tree = createSceneTree(ports, document.createElement("div"));
  const press = (robot: string, key: string) =>
    tree.querySelector(`[data-robot="${robot}"]`)!.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  press("r3", "ArrowDown");
  expect(ports.robots.select).toHaveBeenLastCalledWith("r4");
  press("r3", "ArrowUp");
  expect(ports.robots.select).toHaveBeenLastCalledWith("r2");
});

test("without stations, only robots are counted", () => {
  const { ports } = testPorts({
    scene: scene({ bodies: [body("cart")] }),
    status: { robots: [robot("cart", "wander")] } as unknown as SimulationStatus,
  });
  expect(createSceneTree(ports, document.createElement("div")).querySelector("h2")!.textContent).toBe("1 robot");
});

test("rows do not move while the pointer or the keyboard focus is in the list", () => {
  const { ports, store } = testPorts({ ...crowd(8), health: health({ robot: "r5", state: "stuck" }) });
  const tree = createSceneTree(ports, document.createElement("div"));
  const list = tree.querySelector(".robot-scroll")!;
  list.dispatchEvent(new Event("pointerenter"));
  store.set({ health: health({ robot: "r7", state: "stuck" }) });
  expect(names(tree).slice(0, 2)).toEqual(["r5", "r0"]);
  list.dispatchEvent(new Event("pointerleave"));
  expect(names(tree).slice(0, 2)).toEqual(["r7", "r0"]);
  document.body.append(tree);
  tree.querySelector<HTMLElement>("[data-robot]")!.focus();
  store.set({ health: health({ robot: "r3", state: "dead" }) });
  expect(names(tree)[0]).toBe("r7");
  store.set(({ robotFilter }) => ({ robotFilter: { ...robotFilter, sorting: "name" } })); // a change by the user applies at once
  expect(names(tree)[0]).toBe("r0");
  store.set(({ robotFilter }) => ({ robotFilter: { ...robotFilter, sorting: "worst" } }));
  (document.activeElement as HTMLElement).blur();
  expect(names(tree)[0]).toBe("r3");
  tree.remove();
});

test("rows do not move while this page drives a robot, whose row says so", () => {
  const { ports, store } = testPorts({ ...crowd(8), health: health({ robot: "r5", state: "stuck" }) });
  const tree = createSceneTree(ports, document.createElement("div"));
  const text = (name: string) => tree.querySelector(`[data-robot="${name}"] .robot-behaviour`)!.textContent;
  store.set({ driven: "r2" });
  expect(text("r2")).toBe("driven from this page");
  store.set({ health: health({ robot: "r7", state: "stuck" }) });
  expect(names(tree).slice(0, 2)).toEqual(["r5", "r0"]);
  store.set({ driven: null });
  expect(names(tree).slice(0, 2)).toEqual(["r7", "r0"]);
  expect(text("r2")).not.toContain("driven");
});
