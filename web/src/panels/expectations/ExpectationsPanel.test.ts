// @vitest-environment jsdom
import { expect, test } from "vitest";
import { body, scene } from "../../scene/testScene";
import type { Expectation } from "../../state/expectations";
import { expectationOf } from "../../state/expectations";
import { testPorts } from "../contract/testPorts";
import { mount } from "./ExpectationsPanel";

const VIOLATED = expectationOf({
  name: "keeps clear",
  yaml: "distance: {of: [a, wall], above: 0.3}",
  where: "door.yaml:12:5",
  state: "violated",
  has_margin: true,
  margin: -0.04,
  unit: "m",
  margin_at_s: 3.21,
  time_s: 3.2,
  step: 320n,
  detail: "violated at 3.2 s (step 320): 0.26 m",
  bodies: ["a", "wall"],
  places: [1, 2, 0.5],
  boxes: [0, 1, 2, 3, 4, 5, 6, 7],
});

function panel(expectations: Expectation[], more: object = {}) {
  const bodies = [body("a"), body("wall", { isRobot: false, isStatic: true })];
  const { ports, store } = testPorts({ expectations, scene: scene({ bodies }), ...more });
  const { body: list, whileOpen } = mount(ports);
  whileOpen!();
  return { ports, store, list };
}

test("the places and boxes of a message are decoded", () => {
  expect(VIOLATED.places).toEqual([[1, 2, 0.5]]);
  expect(VIOLATED.boxes).toEqual([[0, 1, 2, 3], [4, 5, 6, 7]]);
});

test("each expectation is shown with verdict, time, margin and reason", () => {
  const { list } = panel([VIOLATED]);
  const row = list.querySelector<HTMLElement>(".expectation")!;
  expect(row.dataset.verdict).toBe("violated");
  expect(row.textContent).toContain("keeps clear");
  expect(row.textContent).toContain("margin -0.040 m at 0:03.21");
  expect(row.querySelector(".expectation-state")!.textContent).toBe("violated at 0:03.20");
  expect(row.textContent).toContain("violated at 3.2 s (step 320): 0.26 m");
});

test("the robot of an event can be selected, but not a wall", () => {
  const { ports, list } = panel([VIOLATED]);
  const buttons = [...list.querySelectorAll("button")];
  expect(buttons.map(({ textContent }) => textContent)).toEqual(["a"]);
  buttons[0]!.click();
  expect(ports.robots.select).toHaveBeenCalledWith("a");
});

test("in a recording, a click goes to the time of the verdict", () => {
  const { ports, list } = panel([VIOLATED], { replay: { start: 0, end: 9, speed: 1, loop: false } });
  list.querySelector<HTMLElement>(".expectation-state button")!.click();
  expect(ports.replay.seek).toHaveBeenCalledWith(3.2);
});

test("a pending expectation shows no time", () => {
  const { store, list } = panel([{ ...VIOLATED, verdict: "pending", time: 0, detail: "" }]);
  expect(list.querySelector(".expectation-state")!.textContent).toBe("pending");
  store.set({ expectations: [] });
  expect(list.textContent).toContain("no expectations");
});
