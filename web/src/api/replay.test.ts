import { expect, test } from "vitest";
import { parseEvents, parseReplay } from "./replay";

test("a replay is read with its time span, its speed and whether it loops", () => {
  expect(parseReplay({ start_s: 1, end_s: 9.5, time_s: 2, speed: 0.5, loop: true })).toEqual({
    start: 1,
    end: 9.5,
    speed: 0.5,
    loop: true,
  });
  expect(() => parseReplay({ start_s: 1, end_s: "9", speed: 1 })).toThrow(
    "replay.end_s: expected a number, found a string",
  );
});

test("events are read, and an invalid event is an error with its place", () => {
  expect(parseEvents([{ time_s: 3, event: "agent_dead", robot: "a", detail: "a: killed" }])).toEqual([
    { time: 3, event: "agent_dead", robot: "a", detail: "a: killed" },
  ]);
  expect(() => parseEvents([{ time_s: 3, event: "started" }, {}])).toThrow("events[1].time_s");
});
