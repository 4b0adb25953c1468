// @vitest-environment jsdom
import { beforeAll, expect, test, vi } from "vitest";
import { body, scene } from "../scene/testScene";
import { createPalette } from "./Palette";
import { commandsOf, findCommands } from "./commandList";
import { robotStatus, simulationStatus, testApp } from "./testApp";

beforeAll(() => {
  // jsdom opens no dialogs.
  HTMLDialogElement.prototype.showModal = function () {
    this.open = true;
  };
  HTMLDialogElement.prototype.close = function () {
    this.open = false;
    this.dispatchEvent(new Event("close"));
  };
});

const RUNNING = simulationStatus("running", { robots: [robotStatus("pebble"), robotStatus("rover")] });

function opened() {
  const fixture = testApp({ status: RUNNING, topics: [{ name: "/pebble/sonar", type: "sensor_msgs/msg/Range" }] });
  const palette = createPalette(fixture.app);
  document.body.replaceChildren(palette);
  fixture.app.openPalette(true);
  const input = palette.querySelector("input")!;
  const type = (text: string) => {
    input.value = text;
    input.dispatchEvent(new Event("input"));
  };
  const press = (key: string) => input.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const lines = () => [...palette.querySelectorAll(".palette-item")].map((each) => each.textContent);
  return { ...fixture, palette, type, press, lines };
}

test("commands, robots, topics, panels and layouts are found by words", () => {
  const { type, lines } = opened();
  type("pebble");
  expect(lines()).toEqual(["Robotpebble", "Topic/pebble/sonar"]);
  type("panel log");
  expect(lines()).toEqual(["PanelLogG"]);
  type("layout crowd");
  expect(lines()).toEqual(["LayoutWatch a crowd"]);
  type("pause");
  expect(lines()[0]).toBe("RunPauseSpace");
  type("no such thing");
  expect(lines()).toEqual([]);
});

test("Enter runs the selected command and closes the palette", () => {
  const { type, press, palette, store } = opened();
  type("robot");
  press("ArrowDown");
  press("Enter");
  expect(store.get().selection).not.toBeNull();
  expect(palette.open).toBe(false);
  expect(store.get().paletteOpen).toBe(false);
});

test("a topic opens in the panel Topics", () => {
  const { type, press, store } = opened();
  type("/pebble/sonar");
  press("Enter");
  expect(store.get().topic).toBe("/pebble/sonar");
  expect(store.get().openPanels).toContain("topics");
});

test("an object of the world is shown in the inspector", () => {
  const { app, store } = testApp({ scene: scene({ bodies: [body("crate", { isRobot: false })] }) });
  const found = findCommands(commandsOf(app), "object crate");
  expect(found.map(({ label }) => label)).toEqual(["crate"]);
  found[0]!.run();
  expect(store.get().part).toEqual({ body: "crate", kind: "body", name: "crate" });
  expect(store.get().openPanels).toContain("inspector");
  app.select(null);
  expect(store.get().part).toBeNull();
});

test("commands that are not possible now are not offered", () => {
  const { app, store } = testApp({ status: RUNNING });
  const labels = () => commandsOf(app).map(({ label }) => label);
  expect(labels()).toContain("Pause");
  expect(labels()).not.toContain("Take one step");
  store.set({ connection: { phase: "waiting", attempt: 1, retryAtMs: 0 } });
  expect(labels()).not.toContain("Pause");
});

test("entries that begin with the text come first, and there are at most fifty", () => {
  const commands = Array.from({ length: 80 }, (_, i) => ({ group: "Robot", label: i === 79 ? "x" : `a x${i}`, run: vi.fn() }));
  const found = findCommands(commands, "x");
  expect(found).toHaveLength(50);
  expect(found[0]!.label).toBe("x");
});
