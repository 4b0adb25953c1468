import { afterEach, expect, test, vi } from "vitest";
import type { Points } from "../live/clouds";
import { buffersIn } from "./buffersIn";
import { CLOUD_CHANNEL, cloudMessage } from "./testClouds";
import { TestWorker } from "./testWorker";
import { WorkerDecoder, WorkerLost } from "./WorkerDecoder";

afterEach(() => void vi.useRealTimers());

const SMALL = () => payloadOf(cloudMessage(4, 2));
const LARGE = () => payloadOf(cloudMessage(64, 48));

function payloadOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.slice().buffer);
}

// A decoder whose worker has started.
function started() {
  const worker = new TestWorker();
  const start = vi.fn(() => worker.asWorker);
  const decoder = new WorkerDecoder(start);
  decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false);
  worker.send({ isReady: true });
  return { decoder, worker, start };
}

test("small messages and messages as they are need no worker", () => {
  const start = vi.fn();
  const decoder = new WorkerDecoder(start);
  expect((decoder.decode(CLOUD_CHANNEL, SMALL(), "points", false) as Points).points).toHaveLength(24);
  expect(decoder.decode(CLOUD_CHANNEL, LARGE(), "message", false)).toMatchObject({ width: 64 });
  expect(start).not.toHaveBeenCalled();
});

test("until the worker has started, the page decodes", () => {
  const { asWorker } = new TestWorker();
  const decoder = new WorkerDecoder(() => asWorker);
  for (let i = 0; i < 2; i++) {
    expect((decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false) as Points).points).toHaveLength(3 * 64 * 48);
  }
});

test("the worker gets large messages without a copy, and its answers are handed over", async () => {
  const { decoder, worker, start } = started();
  const payload = LARGE();
  const points = decoder.decode(CLOUD_CHANNEL, payload, "points", false);
  expect(worker.requests).toMatchObject([{ channel: CLOUD_CHANNEL, form: "points" }]);
  expect(worker.requests[0]!.payload).toBe(payload);
  expect(worker.transferred[0]![0]).toBe(payload.buffer);
  worker.answer("the points");
  expect(await points).toBe("the points");
  expect(start).toHaveBeenCalledOnce();
});

test("a payload with other readers is copied", () => {
  const { decoder, worker } = started();
  const payload = LARGE();
  void decoder.decode(CLOUD_CHANNEL, payload, "points", true);
  expect(worker.transferred[0]![0]).not.toBe(payload.buffer);
  expect(worker.requests[0]!.payload.byteLength).toBe(payload.byteLength);
});

test("a message that the worker cannot decode is rejected with its sentence", async () => {
  const { decoder, worker } = started();
  const points = decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false);
  worker.send({ number: worker.requests[0]!.number, problem: "it is cut off" });
  await expect(points).rejects.toThrow("it is cut off");
});

test.each([
  ["no worker can be started", () => null],
  ["starting one is an error", () => { throw new Error("forbidden"); }],
])("if %s, the page decodes", (_, start) => {
  const decoder = new WorkerDecoder(start);
  for (let i = 0; i < 2; i++) {
    expect((decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false) as Points).points).toHaveLength(3 * 64 * 48);
  }
});

test("if the worker ends, its message counts as lost, and the page decodes the next ones", async () => {
  const { decoder, worker, start } = started();
  const points = decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false);
  worker.onerror!();
  await expect(points).rejects.toBeInstanceOf(WorkerLost);
  expect(worker.isTerminated).toBe(true);
  expect((decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false) as Points).points).toHaveLength(3 * 64 * 48);
  expect(start).toHaveBeenCalledOnce();
});

test("a worker that does not answer counts as lost", async () => {
  vi.useFakeTimers();
  const { decoder, worker } = started();
  const points = decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false) as Promise<unknown>;
  const outcome = expect(points).rejects.toBeInstanceOf(WorkerLost);
  await vi.advanceTimersByTimeAsync(10_000);
  await outcome;
  expect(worker.isTerminated).toBe(true);
});

test("an answer counts that came while the page was busy for longer than it waits", async () => {
  vi.useFakeTimers();
  const { decoder, worker } = started();
  const points = decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false);
  vi.advanceTimersToNextTimer(); // a late timer runs before the answer is taken
  worker.answer({ count: 1 });
  expect(await points).toEqual({ count: 1 });
  await vi.runAllTimersAsync();
  expect(worker.isTerminated).toBe(false);
});

test("closing ends the worker, and a later message starts another one", () => {
  const { decoder, worker, start } = started();
  decoder.close();
  expect(worker.isTerminated).toBe(true);
  decoder.decode(CLOUD_CHANNEL, LARGE(), "points", false);
  expect(start).toHaveBeenCalledTimes(2);
});

test("the memory of all typed arrays is found, each once", () => {
  const numbers = new Float32Array(8);
  const bytes = new Uint8Array(3);
  const content = { points: numbers.subarray(0, 3), rest: numbers.subarray(3), none: null, list: [{ bytes }], text: "a" };
  expect(buffersIn(content)).toEqual([numbers.buffer, bytes.buffer]);
  expect(buffersIn(undefined)).toEqual([]);
});
