import { expect, test } from "vitest";
import type { RecordedEvent } from "../api/replay";
import { initialState } from "./State";
import { allMarks, markBeside, marksOf, shareOf, spanOf, withNewEvents } from "./timeline";

const REPLAY = { start: 10, end: 20, speed: 1, loop: false };

function event(time: number, event: string, more: Partial<RecordedEvent> = {}): RecordedEvent {
  return { time, event, robot: "", detail: "", ...more };
}

test("an instant outside the timeline's span is shown at its start or end", () => {
  expect(shareOf(12.5, REPLAY)).toBe(0.25);
  expect(shareOf(9, REPLAY)).toBe(0);
  expect(shareOf(21, REPLAY)).toBe(1);
  expect(shareOf(5, { ...REPLAY, start: 5, end: 5 })).toBe(0);
});

test("a mark shows the event, its time and its robot", () => {
  const marks = marksOf(
    [
      event(10, "started"),
      event(15, "agent_dead", { robot: "a", detail: "a (wander): killed" }),
      event(20, "robot_removed", { robot: "b" }),
    ],
    REPLAY,
  );
  expect(marks).toEqual([
    { time: 10, share: 0, isBad: false, kind: "event", text: "0:10.00 started" },
    { time: 15, share: 0.5, isBad: true, kind: "event", text: "0:15.00 agent dead · a (wander): killed" },
    { time: 20, share: 1, isBad: false, kind: "event", text: "0:20.00 robot removed · b" },
  ]);
});

test("events at about the same time share a readable mark", () => {
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

test("each instant has a next and a previous mark, or none", () => {
  const marks = marksOf([event(11, "started"), event(15, "paused")], REPLAY);
  expect(markBeside(marks, 11, 1)).toBe(15);
  expect(markBeside(marks, 15, -1)).toBe(11);
  expect(markBeside(marks, 12, -1)).toBe(11);
  expect(markBeside(marks, 15, 1)).toBeNull();
  expect(markBeside(marks, 11, -1)).toBeNull();
});

test("a run's timeline spans its kept history, up to the present", () => {
  expect(spanOf(REPLAY, null, 15)).toEqual({ start: 10, end: 20 });
  expect(spanOf(null, { start: 3, end: 9 }, 9.5)).toEqual({ start: 3, end: 9.5 });
  expect(spanOf(null, { start: 0, end: 0 }, 0)).toBeNull();
  expect(spanOf(null, null, 5)).toBeNull();
});

test("events of a run are added once, by time", () => {
  const known = [event(1, "started"), event(5, "paused")];
  expect(withNewEvents(known, [event(5, "paused")])).toBe(known);
  const more = withNewEvents(known, [event(5, "paused"), event(3, "note", { detail: "late" })]);
  expect(more.map(({ time }) => time)).toEqual([1, 3, 5]);
});

test("notes and the first difference are marks among the events; those before the kept history have no mark", () => {
  const state = {
    ...initialState,
    replay: REPLAY,
    events: [event(2, "started"), event(11, "collision", { robot: "a", detail: "a touches b" })],
    notes: [{ id: 1, time: 14, text: "turns late" }],
    comparison: {
      recording: "old.mcap",
      simulation: "x",
      scene: null,
      difference: { isEqual: false, time: 17, text: "a: 17 s /gsv/poses" },
      problem: "",
    },
  };
  expect(allMarks(state).map(({ time, kind, text }) => ({ time, kind, text }))).toEqual([
    { time: 11, kind: "event", text: "0:11.00 collision · a touches b" },
    { time: 14, kind: "note", text: "0:14.00 note · turns late" },
    { time: 17, kind: "difference", text: "0:17.00 first difference · a: 17 s /gsv/poses" },
  ]);
});
