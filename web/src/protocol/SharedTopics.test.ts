import { expect, test, vi } from "vitest";
import { SharedTopics } from "./SharedTopics";

function source() {
  const sent: ((message: unknown) => void)[] = [];
  const ended = vi.fn();
  const subscribe = vi.fn((_topic: string, handler: (message: never) => void) => {
    sent.push(handler as (message: unknown) => void);
    return ended;
  });
  const topics = new SharedTopics();
  topics.attach({ subscribe });
  return { topics, subscribe, ended, send: (m: unknown) => sent.at(-1)!(m) };
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

test("a later reader gets the newest message at once, because a paused simulation sends no others", () => {
  const { topics, send } = source();
  topics.subscribe("/a", () => {});
  send(1);
  send(2);
  const late = vi.fn();
  topics.subscribe("/a", late);
  expect(late.mock.calls).toEqual([[2]]);
});

test("a topic that is requested again is subscribed again", () => {
  const { topics, subscribe, send } = source();
  topics.subscribe("/a", () => {})();
  const again = vi.fn();
  topics.subscribe("/a", again);
  expect(subscribe).toHaveBeenCalledTimes(2);
  expect(again).not.toHaveBeenCalled();
  send(3);
  expect(again).toHaveBeenCalledWith(3);
});

test("a listener that is removed during a message does not receive it", () => {
  const { topics, send } = source();
  const second = vi.fn();
  let leaveSecond = () => {};
  topics.subscribe("/a", () => leaveSecond());
  leaveSecond = topics.subscribe("/a", second);
  send(1);
  expect(second).not.toHaveBeenCalled();
});

test("readers continue with a new source, and get nothing more from the old one", () => {
  const first = source();
  const { topics } = first;
  const reader = vi.fn();
  topics.subscribe("/a", reader);
  first.send(1);
  topics.attach(null);
  expect(first.ended).toHaveBeenCalledOnce();
  const later = vi.fn();
  topics.subscribe("/a", later);
  expect(later).not.toHaveBeenCalled(); // messages of the earlier source are dropped
  const second = source();
  topics.attach({ subscribe: second.subscribe });
  expect(second.subscribe).toHaveBeenCalledOnce();
  second.send(2);
  expect(reader.mock.calls).toEqual([[1], [2]]);
  expect(later.mock.calls).toEqual([[2]]);
});

test("topics read before there is a source are subscribed later", () => {
  const topics = new SharedTopics();
  const reader = vi.fn();
  const end = topics.subscribe("/a", reader);
  topics.subscribe("/b", () => {})();
  const { subscribe, send, ended } = source();
  topics.attach({ subscribe });
  expect(subscribe.mock.calls.map(([topic]) => topic)).toEqual(["/a"]);
  send(1);
  expect(reader).toHaveBeenCalledWith(1);
  end();
  expect(ended).toHaveBeenCalledOnce();
});

test("messages are skipped only while every reader requests only the newest one", () => {
  const { topics, subscribe, ended } = source();
  const asked = () => subscribe.mock.calls.map((call) => (call as unknown[])[2]);
  topics.subscribe("/a", () => {}, { newestOnly: true });
  topics.subscribe("/a", () => {}, { newestOnly: true });
  expect(asked()).toEqual([{ newestOnly: true }]);
  const end = topics.subscribe("/a", () => {});
  expect(asked()).toEqual([{ newestOnly: true }, { newestOnly: false }]);
  expect(ended).toHaveBeenCalledOnce();
  end();
  expect(asked().at(-1)).toEqual({ newestOnly: true });
});

test("readers of two forms of a topic have two subscriptions, and the topic is read once", () => {
  const { topics, subscribe } = source();
  topics.subscribe("/a", () => {});
  topics.subscribe("/a", () => {}, { form: "points" });
  topics.subscribe("/a", () => {}, { form: "points" });
  expect(subscribe.mock.calls.map((call) => (call as unknown[])[2])).toEqual([{ newestOnly: false }, { newestOnly: false, form: "points" }]);
  expect(topics.read).toEqual(["/a"]);
});
