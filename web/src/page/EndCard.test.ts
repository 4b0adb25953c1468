// @vitest-environment jsdom
import { expect, test } from "vitest";
import { healthOf } from "../state/health";
import { initialState } from "../state/State";
import { createEndCard } from "./EndCard";
import { robotStatus, simulationStatus, testApp } from "./testApp";

const ROBOTS = ["a", "b", "c"].map((name) => robotStatus(name, { collisions: name === "a" ? 1 : 0 }));
const STATUS = simulationStatus("finished", { robots: ROBOTS });
const RECORDING = { isOn: false, path: "/tmp/house.mcap", bytes: 1, droppedMessages: 0 };

const HEALTH = healthOf({
  stamp: { sec: 60, nsec: 0 },
  step: 6000n,
  stuck_after_s: 5,
  moving: 2,
  standing: 0,
  stuck: 1,
  contact: 0,
  dead: 0,
  late: 0,
  robots: [
    {
      robot: "b",
      state: "stuck",
      level: 1,
      since: { sec: 40, nsec: 0 },
      command_linear_m_s: 0.3,
      command_lateral_m_s: 0,
      command_angular_rad_s: 0,
      linear_m_s: 0,
      angular_rad_s: 0,
      limit_sensor: "",
      limit_value: 0,
      limit_unit: "",
      contact: "",
      summary: "is stuck",
      reason: "",
    },
  ],
});

test("the summary shows the simulated time, the stuck robots, and the expectations", () => {
  const { app } = testApp({ status: STATUS, time: 60, health: HEALTH });
  const card = createEndCard(app);
  expect(card.querySelector("h2")!.textContent).toBe("Finished");
  expect([...card.querySelectorAll(".ended-facts p")].map(({ textContent }) => textContent)).toEqual([
    "3 robots · 1:00.00 simulated · 1 collision",
    "1 robot stuck: b",
  ]);
});

test("a failure contains the reason", () => {
  const { app } = testApp({ status: { ...STATUS, phase: "failed", failure: "pebble died" } });
  const card = createEndCard(app);
  expect(card.querySelector("h2")!.textContent).toBe("Failed");
  expect(card.querySelector(".ended-facts p")!.textContent).toBe("pebble died");
});

test("the end card has a link to the replay while the server runs, and a command afterwards", () => {
  const abilities = { ...initialState.abilities, recordings: true };
  const { app, store } = testApp({ status: STATUS, recording: RECORDING, abilities });
  expect(createEndCard(app).querySelector("a")!.getAttribute("href")).toBe("./?recording=house.mcap");
  store.set({ connection: { phase: "waiting", attempt: 1, retryAtMs: 0 } });
  const card = createEndCard(app);
  expect(card.querySelector("a")).toBeNull();
  expect(card.querySelector("code")!.textContent).toBe("gsv replay /tmp/house.mcap");
});

test("the button of the end card shows the view", () => {
  const { app, store } = testApp({ status: STATUS });
  [...createEndCard(app).querySelectorAll("button")].find(({ textContent }) => textContent === "Show the view")!.click();
  expect(store.get().endSeen).toBe(true);
});
