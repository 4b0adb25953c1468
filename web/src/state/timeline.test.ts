import { expect, test } from "vitest";
import type { RecordedEvent } from "../api/replay";
import { markBeside, marksOf, shareOf } from "./timeline";

const REPLAY = { start: 10, end: 20, speed: 1, loop: false };

function event(time: number, event: string, more: Partial<RecordedEvent> = {}): RecordedEvent {
  return { time, event, robot: "", detail: "", ...more };
}

test("an instant has its place in the span, and none beyond it", () => {
  expect(shareOf(12.5, REPLAY)).toBe(0.25);
  expect(shareOf(9, REPLAY)).toBe(0);
  expect(shareOf(21, REPLAY)).toBe(1);
  expect(shareOf(5, { ...REPLAY, start: 5, end: 5 })).toBe(0);
});

test("a mark says what happened, when and to whom", () => {
  const marks = marksOf(
    [
      event(10, "started"),
      event(15, "agent_dead", { robot: "a", detail: "a (wander): killed" }),
      event(20, "robot_removed", { robot: "b" }),
    ],
    REPLAY,
  );
  expect(marks).toEqual([
    { time: 10, share: 0, isBad: false, text: "0:10.00 started" },
    { time: 15, share: 0.5, isBad: true, text: "0:15.00 agent dead · a (wander): killed" },
    { time: 20, share: 1, isBad: false, text: "0:20.00 robot removed · b" },
  ]);
});

test("events of about one instant share a mark, which stays readable", () => {
  const crowd = Array.from({ length: 9 }, (_, i) => event(12 + i / 1000, "robot_added", { robot: `r${i}` }));
  const marks = marksOf([...crowd, event(13, "failed")], REPLAY);
  expect(marks.map(({ time, isBad }) => ({ time, isBad }))).toEqual([
    { time: 12, isBad: false },
    { time: 13, isBad: true },
  ]);
  const lines = marks[0]!.text.split("\n");
  expect(lines).toHaveLength(7);
  expect(lines.at(-1)).toBe("and 3 more events");
});

test("from any instant there is a next and a last mark, or none", () => {
  const marks = marksOf([event(11, "started"), event(15, "paused")], REPLAY);
  expect(markBeside(marks, 11, 1)).toBe(15);
  expect(markBeside(marks, 15, -1)).toBe(11);
  expect(markBeside(marks, 12, -1)).toBe(11);
  expect(markBeside(marks, 15, 1)).toBeNull();
  expect(markBeside(marks, 11, -1)).toBeNull();
});
