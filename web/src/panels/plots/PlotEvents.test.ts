import { expect, test } from "vitest";
import { testPorts } from "../contract/testPorts";
import { PlotEvents } from "./PlotEvents";

function listening() {
  const { ports, store, topics } = testPorts();
  const events = new PlotEvents(ports);
  const end = events.open(() => {});
  const send = (sec: number, event: string, robot = "", detail = "") =>
    topics.send("/gsv/events", { stamp: { sec, nsec: 0 }, step: 0n, event, robot, detail });
  return { store, topics, events, end, send };
}

test("events are marked with what happened, once each", () => {
  const { events, send, topics, end } = listening();
  send(1, "started");
  send(4, "agent_dead", "a", "exit code 1");
  send(1, "started"); // a new subscription repeats this event
  expect(events.marks()).toEqual([
    { time: 1, label: "started", isBad: false },
    { time: 4, label: "agent dead a exit code 1", isBad: true },
  ]);
  end();
  expect(topics.read).toEqual([]);
});

test("a reset removes all marks, and a recording has all of its marks at once", () => {
  const { events, send, store } = listening();
  send(9, "paused");
  send(0, "reset");
  expect(events.marks().map(({ label }) => label)).toEqual(["reset"]);
  store.set({ replay: { start: 0, end: 9, speed: 1, loop: false }, events: [{ time: 3, event: "failed", robot: "", detail: "" }] });
  expect(events.marks()).toEqual([{ time: 3, label: "failed", isBad: true }]);
});
