import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { SlowPage } from "./SlowPage";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

// A page that is blocked for `blocked` ms after each tick, and then receives `bytes` at once.
function judged(blocked: number, bytes: number): boolean[] {
  const judgements: boolean[] = [];
  let [received, late] = [0, 0];
  const real = performance.now.bind(performance);
  vi.spyOn(performance, "now").mockImplementation(() => real() + late);
  const page = new SlowPage(() => {
    late += blocked;
    return (received += bytes);
  }, (isSlow) => judgements.push(isSlow));
  page.start();
  vi.advanceTimersByTime(5000);
  page.stop();
  vi.mocked(performance.now).mockRestore();
  return judgements;
}

test("a page that runs its timers late and receives much at once is slow", () => {
  expect(judged(400, 90_000).at(-1)).toBe(true);
});

test("a page that is busy with drawing, but receives little, is not slow", () => {
  expect(judged(400, 5_000).at(-1)).toBe(false);
});

test("a page that receives much in time is not slow", () => {
  expect(judged(0, 90_000).at(-1)).toBe(false);
});

test("there is no judgement in the first two seconds, and none after the end", () => {
  const judgements = vi.fn();
  const page = new SlowPage(() => 0, judgements);
  page.start();
  vi.advanceTimersByTime(1900);
  expect(judgements).not.toHaveBeenCalled();
  vi.advanceTimersByTime(200);
  expect(judgements).toHaveBeenCalled();
  page.stop();
  const calls = judgements.mock.calls.length;
  vi.advanceTimersByTime(1000);
  expect(judgements).toHaveBeenCalledTimes(calls);
});
