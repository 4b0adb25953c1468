import { expect, test, vi } from "vitest";
import { SharedTopics } from "./SharedTopics";

function source() {
  const sent: ((message: unknown) => void)[] = [];
  const ended = vi.fn();
  const subscribe = vi.fn((_topic: string, handler: (message: never) => void) => {
    sent.push(handler as (message: unknown) => void);
    return ended;
  });
  return { topics: new SharedTopics({ subscribe }), subscribe, ended, send: (m: unknown) => sent.at(-1)!(m) };
}

test("listeners of a topic share one subscription, which ends with the last of them", () => {
  const { topics, subscribe, ended, send } = source();
  const first = vi.fn();
  const second = vi.fn();
  const leaveFirst = topics.subscribe("/a", first);
  const leaveSecond = topics.subscribe("/a", second);
  expect(subscribe).toHaveBeenCalledOnce();
  send(1);
  leaveFirst();
  send(2);
  expect(first.mock.calls).toEqual([[1]]);
  expect(second.mock.calls).toEqual([[1], [2]]);
  expect(ended).not.toHaveBeenCalled();
  leaveSecond();
  leaveSecond();
  expect(ended).toHaveBeenCalledOnce();
});

test("who comes later has the newest message at once, as while it is paused no other comes", () => {
  const { topics, send } = source();
  topics.subscribe("/a", () => {});
  send(1);
  send(2);
  const late = vi.fn();
  topics.subscribe("/a", late);
  expect(late.mock.calls).toEqual([[2]]);
});

test("a topic that is asked for again is subscribed anew", () => {
  const { topics, subscribe, send } = source();
  topics.subscribe("/a", () => {})();
  const again = vi.fn();
  topics.subscribe("/a", again);
  expect(subscribe).toHaveBeenCalledTimes(2);
  expect(again).not.toHaveBeenCalled();
  send(3);
  expect(again).toHaveBeenCalledWith(3);
});

test("a listener that leaves while a message is handed round hears no more of it", () => {
  const { topics, send } = source();
  const second = vi.fn();
  let leaveSecond = () => {};
  topics.subscribe("/a", () => leaveSecond());
  leaveSecond = topics.subscribe("/a", second);
  send(1);
  expect(second).not.toHaveBeenCalled();
});
