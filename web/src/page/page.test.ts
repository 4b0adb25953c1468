// @vitest-environment jsdom
import { beforeAll, expect, test, vi } from "vitest";
import { body, scene } from "../scene/testScene";
import { createInspector, poseText, startText } from "../panels/inspector/Inspector";
import { createHelpSheet } from "./HelpSheet";
import { createNotices } from "./Notices";
import { createPanelBar } from "./PanelBar";
import { PANELS } from "../panels/registry";
import { createSceneTree } from "../panels/tree/SceneTree";
import { createStatusBar } from "./StatusBar";
import { robotStatus, simulationStatus, testApp } from "./testApp";
import { createToolbar } from "./Toolbar";

beforeAll(() => {
  Element.prototype.scrollIntoView = () => {}; // jsdom has no layout
});

const POSE = {
  x: 1.234,
  y: -0.001,
  z: 0,
  roll: 0.1,
  pitch: -0.2,
  yaw: Math.PI / 2,
  speed: 0.3,
  turnRate: -Math.PI / 6,
};

function enabledButtons(toolbar: HTMLElement): string[] {
  const buttons = toolbar.querySelectorAll<HTMLButtonElement>(".toolbar-transport > button:not(:disabled)");
  return [...buttons].map((button) => button.getAttribute("aria-label") ?? button.textContent ?? "");
}

test.each([
  ["created", ["Start", "Step", "Stop", "Reset"]],
  ["running", ["Pause", "Stop", "Reset"]],
  ["paused", ["Resume", "Step", "Stop", "Reset"]],
  ["stopped", ["Reset"]],
  ["finished", ["Reset"]],
  ["failed", ["Reset"]],
] as const)("while it is %s these buttons can be pressed: %s", (phase, names) => {
  const { app } = testApp({ status: simulationStatus(phase) });
  expect(enabledButtons(createToolbar(app, () => {}))).toEqual(names);
});

test("buttons follow the clicks of another viewer", () => {
  const { app, store } = testApp({ status: simulationStatus("running") });
  const toolbar = createToolbar(app, () => {});
  store.set({ status: simulationStatus("paused") });
  expect(toolbar.querySelector(".main-action")?.textContent).toBe("Resume");
});

test("all buttons are disabled while the connection is lost or an answer is pending", () => {
  const { app, store } = testApp({ status: simulationStatus("running"), pending: "pause" });
  const toolbar = createToolbar(app, () => {});
  expect(enabledButtons(toolbar)).toEqual([]);
  store.set({ pending: null, connection: { phase: "waiting", attempt: 1, retryAtMs: 0 } });
  expect(enabledButtons(toolbar)).toEqual([]);
});

test("the real-time factor and the number of steps can be set", () => {
  const act = vi.fn(async () => simulationStatus("paused"));
  const setFactor = vi.fn(async () => simulationStatus("paused"));
  const { app, store } = testApp({ status: simulationStatus("paused", { targetFactor: 2 }) }, { act, setFactor });
  const menu = createToolbar(app, () => {}).querySelector<HTMLElement>(".toolbar-transport .menu-sheet")!;
  const button = (text: string) => [...menu.querySelectorAll("button")].find((each) => each.textContent === text)!;
  expect(button("2×").getAttribute("aria-pressed")).toBe("true");
  expect(button("1×").getAttribute("aria-pressed")).toBe("false");
  button("5×").click();
  expect(setFactor).toHaveBeenCalledWith("house", 5);
  // Another viewer has pressed the button.
  store.set({ pending: null, status: simulationStatus("paused", { targetFactor: 0.25 }) });
  const [typed, steps] = menu.querySelectorAll("input");
  expect(typed!.value).toBe("0.25");

  steps!.value = "250";
  steps!.dispatchEvent(new Event("change"));
  button("Take steps").click();
  expect(act).toHaveBeenCalledWith("house", "step", 250);
  store.set({ pending: null, status: simulationStatus("running") });
  expect(button("Take steps").disabled).toBe(true);
});

test("a simulation in lockstep says that its speed cannot be set", () => {
  const { app } = testApp({ status: simulationStatus("running", { mode: "lockstep" }) });
  const menu = createToolbar(app, () => {}).querySelector(".toolbar-transport .menu-sheet")!;
  expect(menu.querySelector<HTMLElement>(".pace-choices")!.hidden).toBe(true);
  expect(menu.querySelector<HTMLElement>(".hint")!.hidden).toBe(false);
});

test("one of several simulations can be chosen", () => {
  const simulations = ["house", "yard"].map((name) => ({ name, phase: "running", robots: 0 }) as const);
  const { app } = testApp({ simulations });
  const join = vi.spyOn(app.session, "join").mockImplementation(() => {});
  const choice = createToolbar(app, () => {}).querySelector("select")!;
  expect(choice.value).toBe("house");
  choice.value = "yard";
  choice.dispatchEvent(new Event("change"));
  expect(join).toHaveBeenCalledWith("yard");
});

test("each robot has a row with its behaviour, distance and collisions", () => {
  const robots = [robotStatus("a", { distance: 1.5, collisions: 2 }), robotStatus("b", { behaviour: "" })];
  const { ports, store } = testApp({ status: simulationStatus("running", { robots }) });
  const tree = createSceneTree(ports, document.createElement("div"));
  const rows = () => [...tree.querySelectorAll(".robot")].map((row) => row.textContent);
  expect(rows()).toEqual(["a1.50 mwander2 collisions", "b0.00 mno behaviour"]);
  store.set({ status: simulationStatus("running", { robots: [robotStatus("b")] }) });
  expect(rows()).toEqual(["b0.00 mwander"]);
});

test("an avatar's row explains how to drive it", () => {
  const { ports, store } = testApp({ status: simulationStatus("running", { robots: [robotStatus("me")] }) });
  const tree = createSceneTree(ports, document.createElement("div"));
  store.set({ scene: scene({ bodies: [body("me", { isAvatar: true })] }) });
  expect(tree.querySelector(".robot-behaviour")?.textContent).toBe("avatar · W A S D");
});

test("a list without robots explains how to add some", () => {
  const { ports } = testApp({ status: simulationStatus("running") });
  const hint = createSceneTree(ports, document.createElement("div")).querySelector<HTMLElement>(".hint")!;
  expect(hint.hidden).toBe(false);
  expect(hint.textContent).toContain("gsv run");
});

test("names with markup are shown literally", () => {
  const name = "<img src=x onerror=alert(1)>";
  const robots = [robotStatus(name, { detail: "<b>bold</b>" })];
  const { ports } = testApp({ status: simulationStatus("running", { robots }), selection: name });
  const tree = createSceneTree(ports, document.createElement("div"));
  const inspector = createInspector(ports);
  expect(tree.querySelector("img")).toBeNull();
  expect(inspector.querySelector("img, b")).toBeNull();
  expect(inspector.querySelector("h2")?.textContent).toBe(name);
});

test("a click on a row selects its robot, and the inspector shows its pose", () => {
  const { ports, store } = testApp({ status: simulationStatus("running", { robots: [robotStatus("a")] }) });
  const tree = createSceneTree(ports, document.createElement("div"));
  const inspector = createInspector(ports);
  expect(inspector.hidden).toBe(true);
  tree.querySelector<HTMLButtonElement>(".robot")!.click();
  expect(tree.querySelector(".robot")?.getAttribute("aria-pressed")).toBe("true");
  store.set({ selectedPose: POSE });
  expect(inspector.hidden).toBe(false);
  const values = [...inspector.querySelectorAll(".inspector-rows dd")].slice(0, 4).map((value) => value.textContent);
  expect(values).toEqual(["1.23, 0.00, 0.00 m", "90.0°", "0.30 m/s", "-30.0°/s"]);
});

test("a pose is copied in the formats of files and of the command line", () => {
  expect(poseText(POSE)).toBe("1.2340 -0.0010 0.0000 0.1000 -0.2000 1.5708");
  expect(startText(POSE)).toBe("1.2340,-0.0010,1.5708");
});

test("the status bar shows phase, time, factor, late steps and the behaviour that delays the run", () => {
  const status = simulationStatus("running", {
    realTimeFactor: 0.5,
    lateSteps: 3,
    waitingFor: "robot_3 (wander) since 2.1 s",
  });
  const { app } = testApp({ status, time: 75.25 });
  const bar = createStatusBar(app);
  const text = (part: string) => bar.querySelector(`[data-testid="${part}"]`)?.textContent;
  expect(text("phase")).toBe("Running");
  expect(text("time")).toBe("1:15.25");
  expect(text("factor")).toBe("0.50× / 1.00×");
  expect(text("late")).toBe("3 late steps");
  expect(text("waiting")).toBe("waiting for robot_3 (wander) since 2.1 s");
  expect(text("connection")).toBe("Live");
});

test("a simulation that is too slow is shown as lagging", () => {
  const { app, store } = testApp({ status: simulationStatus("running", { realTimeFactor: 0.955 }) });
  const factor = createStatusBar(app).querySelector<HTMLElement>('[data-testid="factor"]')!;
  expect(factor.classList.contains("lagging")).toBe(false);
  store.set({ status: simulationStatus("running", { targetFactor: 2, realTimeFactor: 1.1 }) });
  expect(factor.classList.contains("lagging")).toBe(true);
  expect(factor.title).toBe("Running at 55 % of the target speed");
  store.set({ status: simulationStatus("paused", { targetFactor: 2, realTimeFactor: 0 }) });
  expect(factor.classList.contains("lagging")).toBe(false);
});

test("in lockstep there is no target factor", () => {
  const { app } = testApp({
    status: simulationStatus("running", { mode: "lockstep", realTimeFactor: 12.3 }),
  });
  const factor = createStatusBar(app).querySelector('[data-testid="factor"]');
  expect(factor?.textContent).toBe("12.3× · lockstep");
});

test("a notice can be dismissed", () => {
  const { app, store } = testApp({ notices: [{ id: 1, kind: "error", sentence: "No." }] });
  const notices = createNotices(app);
  expect(notices.querySelector("p")?.textContent).toBe("No.");
  notices.querySelector("button")!.click();
  expect(store.get().notices).toEqual([]);
  expect(notices.children).toHaveLength(0);
});

test("panels are opened and closed by their buttons, however they were opened", () => {
  const { app, store } = testApp();
  const button = createPanelBar(app, PANELS).querySelector('[aria-label="Status"]')!;
  expect(button.getAttribute("aria-pressed")).toBe("false");
  (button as HTMLButtonElement).click();
  expect(store.get().openPanels).toEqual(["status"]);
  app.panels.close("status");
  expect(button.getAttribute("aria-pressed")).toBe("false");
});

test("the help sheet opens the documentation beside the viewer", () => {
  const { app } = testApp();
  const link = createHelpSheet(app).querySelector<HTMLAnchorElement>("a[href='docs/']")!;
  expect(link.textContent).toBe("Open documentation");
  expect(link.target).toBe("_blank");
});

test("single keys are turned off in the help sheet", () => {
  const { app, store } = testApp();
  document.body.replaceChildren(createHelpSheet(app));
  const setting = document.querySelector<HTMLInputElement>('input[type="checkbox"]')!;
  expect(setting.checked).toBe(true);
  setting.click();
  expect(store.get().singleKeys).toBe(false);
  app.useSingleKeys(true);
  expect(setting.checked).toBe(true);
  document.body.replaceChildren();
});
