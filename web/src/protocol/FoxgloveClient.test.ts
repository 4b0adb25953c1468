import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import { parse } from "@foxglove/rosmsg";
import { afterEach, expect, test, vi } from "vitest";
import WebSocketClient, { WebSocketServer } from "ws";
import type { ConnectionState } from "./FoxgloveClient";
import { FoxgloveClient, SUBPROTOCOLS } from "./FoxgloveClient";
import { CLOUD_CHANNEL, cloudMessage } from "./testClouds";
import { TestWorker } from "./testWorker";
import { WorkerDecoder } from "./WorkerDecoder";

// The time limit suits a loaded machine.
const eventually = (check: () => void) => vi.waitFor(check, 20_000);

const SCHEMA = "uint32 number\nstring text";
const CHANNEL = {
  id: 7,
  topic: "/greeting",
  encoding: "cdr",
  schemaName: "test_msgs/msg/Greeting",
  schema: SCHEMA,
  schemaEncoding: "ros2msg",
};

interface Op {
  op: string;
  subscriptions?: { id: number; channelId: number }[];
  subscriptionIds?: number[];
}

// A server that advertises its channels to each client and stores what it receives.
class Server {
  readonly heard: Op[] = [];
  readonly protocols: string[] = [];
  private readonly server: WebSocketServer;

  constructor(
    private readonly channels: object[] = [CHANNEL],
    port = 0,
  ) {
    this.server = new WebSocketServer({
      host: "127.0.0.1",
      port,
      handleProtocols: (offered) => [...offered][0] ?? false,
    });
    this.server.on("connection", (socket) => {
      this.protocols.push(socket.protocol);
      socket.on("message", (data) => this.heard.push(JSON.parse(String(data))));
      socket.send(JSON.stringify({ op: "serverInfo", name: "test", capabilities: [] }));
      socket.send(JSON.stringify({ op: "advertise", channels: this.channels }));
    });
  }

  get port(): number {
    return (this.server.address() as { port: number }).port;
  }

  listening(): Promise<void> {
    return new Promise((resolve) => this.server.once("listening", () => resolve()));
  }

  send(data: string | Uint8Array): void {
    for (const socket of this.server.clients) socket.send(data);
  }

  close(): Promise<void> {
    for (const socket of this.server.clients) socket.terminate();
    return new Promise((resolve) => this.server.close(() => resolve()));
  }
}

function greeting(subscription: number, number: number, text: string): Uint8Array {
  return frameOf(subscription, new MessageWriter(parse(SCHEMA, { ros2: true })).writeMessage({ number, text }));
}

function frameOf(subscription: number, payload: Uint8Array): Uint8Array {
  const frame = new Uint8Array(13 + payload.length);
  const view = new DataView(frame.buffer);
  view.setUint8(0, 1);
  view.setUint32(1, subscription, true);
  view.setBigUint64(5, 123n, true);
  frame.set(payload, 13);
  return frame;
}

const opened: { close(): unknown }[] = [];
afterEach(async () => {
  for (const each of opened.splice(0)) await each.close();
});

async function serve(channels?: object[], port?: number): Promise<Server> {
  const server = new Server(channels, port);
  opened.push(server);
  await server.listening();
  return server;
}

function connectTo(server: Server, decoder = new WorkerDecoder(() => null)) {
  const states: ConnectionState[] = [];
  const problems: string[] = [];
  const lasting: { now: string[] } = { now: [] };
  const client = new FoxgloveClient(
    `ws://127.0.0.1:${server.port}/ws`,
    {
      onConnection: (state) => states.push(state),
      onProblem: (sentence) => problems.push(sentence),
      onLasting: (sentences) => (lasting.now = sentences),
    },
    WebSocketClient as unknown as typeof WebSocket,
    decoder,
  );
  opened.unshift(client);
  client.connect();
  return { client, states, problems, lasting };
}

test("it offers both sub-protocols and subscribes to what is advertised", async () => {
  const server = await serve();
  const { client } = connectTo(server);
  client.subscribe("/greeting", () => {});
  client.subscribe("/nowhere", () => {});
  await eventually(() => expect(server.heard).toHaveLength(1));
  expect(server.protocols).toEqual([SUBPROTOCOLS[0]]);
  expect(server.heard[0]).toEqual({ op: "subscribe", subscriptions: [{ id: 1, channelId: 7 }] });
  expect(client.missingTopics).toEqual(["/nowhere"]);
});

test("messages are decoded", async () => {
  const server = await serve();
  const { client } = connectTo(server);
  const handler = vi.fn();
  client.subscribe("/greeting", handler);
  await eventually(() => expect(server.heard).toHaveLength(1));
  server.send(greeting(1, 42, "hello"));
  await eventually(() => expect(handler).toHaveBeenCalledWith({ number: 42, text: "hello" }));
});

test("a reader of the newest messages skips older ones", async () => {
  const server = await serve();
  const { client } = connectTo(server);
  const newest = vi.fn();
  const all = vi.fn();
  client.subscribe("/greeting", newest, { newestOnly: true });
  client.subscribe("/greeting", all);
  await eventually(() => expect(server.heard).toHaveLength(1));
  // While this thread is busy, these messages wait at the socket.
  for (let i = 0; i < 50; i++) {
    server.send(greeting(1, i, ""));
  }
  await eventually(() => expect(all).toHaveBeenCalledTimes(50));
  await eventually(() => expect(newest).toHaveBeenLastCalledWith({ number: 49, text: "" }));
  expect(newest.mock.calls.length).toBeLessThan(50);
});

test("after a slow message there is a pause, and then the newest message", async () => {
  const server = await serve();
  const { client } = connectTo(server);
  let now = 0;
  const clock = vi.spyOn(performance, "now").mockImplementation(() => now);
  const timeout = vi.spyOn(globalThis, "setTimeout");
  const heard: number[] = [];
  client.subscribe<{ number: number }>(
    "/greeting",
    ({ number }) => {
      heard.push(number);
      now += 30;
    },
    { newestOnly: true },
  );
  await eventually(() => expect(server.heard).toHaveLength(1));
  server.send(greeting(1, 1, ""));
  await eventually(() => expect(heard).toEqual([1]));
  timeout.mockClear();
  server.send(greeting(1, 2, ""));
  await eventually(() => expect(timeout.mock.calls.map(([, wait]) => wait)).toContain(120));
  server.send(greeting(1, 3, ""));
  await eventually(() => expect(heard).toEqual([1, 3]));
  clock.mockRestore();
  timeout.mockRestore();
});

test("parameters are requested from servers that have them", async () => {
  const server = await serve();
  const { client } = connectTo(server);
  await eventually(() => expect(client.topics).toHaveLength(1));
  expect(await client.parameter("/gsv/x")).toBeNull();
  server.send(JSON.stringify({ op: "serverInfo", name: "test", capabilities: ["parameters"] }));
  server.send(JSON.stringify({ op: "advertise", channels: [{ ...CHANNEL, id: 8, topic: "/other" }] }));
  await eventually(() => expect(client.topics).toHaveLength(2));
  const value = client.parameter("/gsv/x");
  await eventually(() => expect(server.heard.at(-1)).toEqual({ op: "getParameters", parameterNames: ["/gsv/x"], id: "/gsv/x" }));
  server.send(JSON.stringify({ op: "parameterValues", id: "/gsv/x", parameters: [{ name: "/gsv/x", value: 3, type: "float64" }] }));
  expect(await value).toBe(3);
  const unanswered = client.parameter("/gsv/x");
  await server.close();
  expect(await unanswered).toBeNull();
});

test("readers of one channel share a subscription, which ends with the last of them", async () => {
  const server = await serve();
  const { client, problems } = connectTo(server);
  const handler = vi.fn();
  const other = vi.fn();
  const endFirst = client.subscribe("/greeting", handler);
  const endOther = client.subscribe("/nowhere", other, { orElse: "/greeting" });
  await eventually(() => expect(server.heard).toEqual([{ op: "subscribe", subscriptions: [{ id: 1, channelId: 7 }] }]));
  server.send(greeting(1, 1, "to both"));
  await eventually(() => expect(other).toHaveBeenCalledOnce());
  expect(handler).toHaveBeenCalledOnce();
  endFirst();
  server.send(greeting(1, 2, "to the other"));
  await eventually(() => expect(other).toHaveBeenCalledTimes(2));
  expect(handler).toHaveBeenCalledOnce();
  endOther();
  await eventually(() => expect(server.heard.at(-1)).toEqual({ op: "unsubscribe", subscriptionIds: [1] }));
  client.subscribe("/greeting", handler);
  server.send(greeting(1, 3, "late"));
  await eventually(() => expect(server.heard.at(-1)).toEqual({ op: "subscribe", subscriptions: [{ id: 2, channelId: 7 }] }));
  server.send(greeting(2, 4, "in time"));
  await eventually(() => expect(handler).toHaveBeenCalledTimes(2));
  expect(handler).toHaveBeenLastCalledWith({ number: 4, text: "in time" });
  expect(problems).toEqual([]);
});

test("a later reader of a channel subscribes it again, so that the server sends the current message", async () => {
  const server = await serve();
  const { client } = connectTo(server);
  const first = vi.fn();
  const later = vi.fn();
  client.subscribe("/greeting", first);
  await eventually(() => expect(server.heard).toHaveLength(1));
  const end = client.subscribe("/nowhere", later, { orElse: "/greeting" });
  await eventually(() => expect(server.heard).toHaveLength(3));
  expect(server.heard.slice(1)).toEqual([
    { op: "unsubscribe", subscriptionIds: [1] },
    { op: "subscribe", subscriptions: [{ id: 2, channelId: 7 }] },
  ]);
  server.send(greeting(2, 1, "to both"));
  await eventually(() => expect(later).toHaveBeenCalledOnce());
  expect(first).toHaveBeenCalledOnce();
  end();
  server.send(greeting(2, 2, "to the first"));
  await eventually(() => expect(first).toHaveBeenCalledTimes(2));
  expect(server.heard).toHaveLength(3);
});

// A client with a reader of a cloud's points, whose worker has started.
async function readingPoints() {
  const server = await serve([CLOUD_CHANNEL]);
  const worker = new TestWorker();
  const { client, problems } = connectTo(server, new WorkerDecoder(() => worker.asWorker));
  const points = vi.fn();
  client.subscribe("/a/depth", points, { form: "points" });
  await eventually(() => expect(server.heard).toHaveLength(1));
  server.send(frameOf(1, cloudMessage(64, 48)));
  await eventually(() => expect(points).toHaveBeenCalledOnce());
  worker.send({ isReady: true });
  return { server, worker, client, problems, points };
}

test("while a worker decodes a message, only the newest of the next ones waits", async () => {
  const { server, worker, client, points } = await readingPoints();
  const arrived = vi.fn();
  client.subscribe("/a/depth", arrived);
  await eventually(() => expect(server.heard).toHaveLength(3));
  server.send(frameOf(2, cloudMessage(64, 48)));
  await eventually(() => expect(worker.requests).toHaveLength(1));
  for (const width of [64, 65, 66]) server.send(frameOf(2, cloudMessage(width, 48)));
  await eventually(() => expect(arrived).toHaveBeenCalledTimes(4));
  expect(worker.requests).toHaveLength(1);
  worker.answer("first");
  await eventually(() => expect(worker.requests).toHaveLength(2));
  expect(worker.requests[1]!.payload.byteLength).toBe(cloudMessage(66, 48).byteLength);
  worker.answer("second");
  await eventually(() => expect(points.mock.calls.slice(1)).toEqual([["first"], ["second"]]));
});

test("a message that the worker cannot decode is reported, and the next one is shown", async () => {
  const { server, worker, problems, points } = await readingPoints();
  server.send(frameOf(1, cloudMessage(64, 48)));
  await eventually(() => expect(worker.requests).toHaveLength(1));
  worker.send({ number: worker.requests[0]!.number, problem: "it is cut off" });
  server.send(frameOf(1, cloudMessage(64, 48)));
  await eventually(() => expect(worker.requests).toHaveLength(2));
  worker.answer("next");
  await eventually(() => expect(points).toHaveBeenLastCalledWith("next"));
  expect(problems).toEqual(["A message on /a/depth cannot be read: it is cut off"]);
});

test("if the worker ends, the topic is subscribed again, and the page decodes its messages", async () => {
  const { server, worker, problems, points } = await readingPoints();
  server.send(frameOf(1, cloudMessage(64, 48)));
  await eventually(() => expect(worker.requests).toHaveLength(1));
  worker.onerror!();
  await eventually(() => expect(server.heard.at(-1)).toEqual({ op: "subscribe", subscriptions: [{ id: 2, channelId: 7 }] }));
  server.send(frameOf(2, cloudMessage(64, 48)));
  await eventually(() => expect(points).toHaveBeenCalledTimes(2));
  expect(worker.isTerminated).toBe(true);
  expect(problems).toEqual([]);
});

test("an answer of the worker after the end of the subscription is dropped", async () => {
  const { server, worker, client, points } = await readingPoints();
  server.send(frameOf(1, cloudMessage(64, 48)));
  await eventually(() => expect(worker.requests).toHaveLength(1));
  client.close();
  expect(worker.isTerminated).toBe(true);
  worker.answer("late");
  await Promise.resolve();
  expect(points).toHaveBeenCalledOnce();
});

test("after the server was away, it reconnects and subscribes again", async () => {
  const first = await serve();
  const { client, states } = connectTo(first);
  const handler = vi.fn();
  client.subscribe("/greeting", handler);
  await eventually(() => expect(first.heard).toHaveLength(1));
  const { port } = first;
  await first.close();
  await eventually(() => expect(states.at(-1)?.phase).toBe("waiting"));
  const second = await serve([{ ...CHANNEL, id: 9 }], port);
  client.retryNow();
  await eventually(() => expect(second.heard).toHaveLength(1));
  expect(second.heard[0]?.subscriptions?.[0]?.channelId).toBe(9);
  expect(states.map(({ phase }) => phase)).toEqual(["connecting", "open", "waiting", "connecting", "open"]);
  second.send(greeting(second.heard[0]!.subscriptions![0]!.id, 1, "back"));
  await eventually(() => expect(handler).toHaveBeenCalledWith({ number: 1, text: "back" }));
});

test("a channel that is advertised later is subscribed, and a removed one is forgotten", async () => {
  const server = await serve([]);
  const { client } = connectTo(server);
  const handler = vi.fn();
  client.subscribe("/greeting", handler);
  await eventually(() => expect(server.protocols).toHaveLength(1));
  server.send(JSON.stringify({ op: "advertise", channels: [CHANNEL] }));
  await eventually(() => expect(server.heard).toHaveLength(1));
  server.send(JSON.stringify({ op: "unadvertise", channelIds: [7] }));
  server.send(JSON.stringify({ op: "advertise", channels: [{ ...CHANNEL, id: 8 }] }));
  await eventually(() => expect(server.heard).toHaveLength(2));
  expect(server.heard[1]?.subscriptions?.[0]?.channelId).toBe(8);
});

test("a topic that the server withdrew is not missing", async () => {
  const server = await serve();
  const { client } = connectTo(server);
  client.subscribe("/greeting", () => {});
  await eventually(() => expect(server.heard).toHaveLength(1));
  server.send(JSON.stringify({ op: "unadvertise", channelIds: [7] }));
  await eventually(() => expect(client.topics).toEqual([]));
  expect(client.missingTopics).toEqual([]);
});

test("an unreadable message is reported once and has no other effect", async () => {
  const server = await serve();
  const { client, problems } = connectTo(server);
  const handler = vi.fn();
  client.subscribe("/greeting", handler);
  await eventually(() => expect(server.heard).toHaveLength(1));
  const cut = greeting(1, 1, "a text that is cut off").slice(0, 26);
  server.send(cut);
  server.send(cut);
  server.send("{ no json");
  server.send(new Uint8Array([1, 2]));
  server.send(greeting(1, 5, "fine"));
  await eventually(() => expect(handler).toHaveBeenCalledWith({ number: 5, text: "fine" }));
  expect(problems).toHaveLength(2);
  expect(problems[0]).toMatch(/^A message on \/greeting cannot be read: /);
  expect(problems[1]).toMatch(/^Cannot read a message of the server: /);
});

test("a channel with another encoding is rejected with a sentence", async () => {
  const server = await serve([{ ...CHANNEL, encoding: "json" }]);
  const { client, problems } = connectTo(server);
  client.subscribe("/greeting", () => {});
  await eventually(() => expect(server.heard).toHaveLength(1));
  server.send(greeting(1, 1, "x"));
  await eventually(() => expect(problems).toHaveLength(1));
  expect(problems[0]).toContain("expected messages in cdr, found json");
});

test("warnings of the server are passed on", async () => {
  const server = await serve();
  const { problems } = connectTo(server);
  await eventually(() => expect(server.protocols).toHaveLength(1));
  server.send(JSON.stringify({ op: "status", level: 0, message: "welcome" }));
  server.send(JSON.stringify({ op: "status", level: 2, message: "no such channel" }));
  await eventually(() => expect(problems).toEqual(["no such channel"]));
});

test("a warning with an ID lasts until the server takes it back", async () => {
  const server = await serve();
  const { problems, lasting } = connectTo(server);
  await eventually(() => expect(server.protocols).toHaveLength(1));
  server.send(JSON.stringify({ op: "status", level: 1, message: "The connection is slow.", id: "slow" }));
  await eventually(() => expect(lasting.now).toEqual(["The connection is slow."]));
  server.send(JSON.stringify({ op: "removeStatus", statusIds: ["other", "slow"] }));
  await eventually(() => expect(lasting.now).toEqual([]));
  expect(problems).toEqual([]);
});
