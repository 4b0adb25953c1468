// A client of the Foxglove WebSocket protocol. It subscribes by topic and decodes messages. If the
// connection is lost, it reconnects with increasing waiting times. A subscription survives a
// reconnection: it is made again when the server advertises its topic.
import { backoffMs } from "./Backoff";
import type { LiveView, LiveViewSource, ViewReader } from "./LiveViews";
import { ConnectedViews } from "./LiveViews";
import type { Channel } from "./MessageDecoder";
import type { Form } from "./forms";
import { MessageDecoders } from "./MessageDecoder";
import type { TopicOptions, TopicSource } from "./SharedTopics";
import { WorkerDecoder, WorkerLost } from "./WorkerDecoder";

export const SUBPROTOCOLS = ["foxglove.sdk.v1", "foxglove.websocket.v1"];

const OPENING_TIMEOUT_MS = 5000;
const REST_SHARE = 4; // pause after a decoded message, as a multiple of the page's time that it took
const LONGEST_REST_MS = 250;
const MESSAGE_DATA = 1;
const MESSAGE_DATA_HEADER_BYTES = 13;

export type ConnectionState =
  | { phase: "connecting"; attempt: number }
  | { phase: "open" }
  | { phase: "waiting"; attempt: number; retryAtMs: number };

export interface ClientEvents {
  onConnection(state: ConnectionState): void;
  // Called if a message of the server could not be decoded, or if the server reports a problem.
  onProblem(sentence: string): void;
  // Called with the problems that last until the server withdraws them, such as a slow connection.
  onLasting?(sentences: string[]): void;
  // Called when the server's topics have changed.
  onTopics?(topics: TopicInfo[]): void;
}

export interface TopicInfo {
  name: string;
  type: string; // "sensor_msgs/msg/LaserScan"
}

// The counts of a topic since the page was loaded.
export interface TopicCount {
  messages: number;
  bytes: number;
}

type Handler = (message: unknown) => void;

export type ParameterValue = string | number | boolean;

interface Subscription {
  topic: string;
  orElse: string | undefined;
  handler: Handler;
  newestOnly: boolean;
  form: Form;
  waiting: { channel: Channel; payload: DataView } | null; // the newest message, if it is not decoded yet
  isBusy: boolean; // whether a message waits for its turn or is being decoded
  restsUntilMs: number;
  id: number | null; // null: not subscribed at the server
  ended: boolean; // whether the server has offered the topic on this connection, and withdrawn it
}

// A server refuses a second subscription of a channel, so all subscriptions of a channel share one.
interface SubscribedChannel {
  channel: Channel;
  subscriptions: Set<Subscription>;
}

export class FoxgloveClient implements TopicSource, LiveViewSource {
  received = 0; // bytes of all binary messages so far
  private socket: WebSocket | null = null;
  private attempt = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private closed = false;
  private nextSubscription = 1;
  private readonly channels = new Map<number, Channel>();
  private readonly subscriptions = new Set<Subscription>();
  // by the ID that this client has given to the subscription
  private readonly subscribed = new Map<number, SubscribedChannel>();
  private readonly decoders = new MessageDecoders(); // for readers of all messages
  private readonly reported = new Set<string>();
  private readonly counted = new Map<string, TopicCount>(); // by topic
  private readonly questions = new Map<string, (value: ParameterValue | null) => void>(); // by parameter
  private readonly lasting = new Map<string, string>(); // problems by the ID of their status message
  private hasParameters = false;
  private readonly views = new ConnectedViews((message) => this.send(message), () => this.nextSubscription++);

  constructor(
    private readonly url: string,
    private readonly events: ClientEvents,
    private readonly SocketClass: typeof WebSocket = WebSocket,
    private readonly newestDecoder = new WorkerDecoder(),
  ) {}

  connect(): void {
    this.closed = false;
    this.attempt = 0;
    this.open();
  }

  // Connects at once instead of after the current waiting time.
  retryNow(): void {
    if (this.socket || this.closed) return;
    clearTimeout(this.timer);
    this.open();
  }

  close(): void {
    this.closed = true;
    clearTimeout(this.timer);
    this.abandon();
    this.newestDecoder.close();
  }

  get topics(): string[] {
    return [...this.channels.values()].map((channel) => channel.topic);
  }

  // The counts of the topics that are or were subscribed.
  get counts(): ReadonlyMap<string, TopicCount> {
    return this.counted;
  }

  // The subscribed topics that the server has not offered since the connection opened. Topics that
  // the server has withdrawn are left out, because their robots were removed.
  get missingTopics(): string[] {
    return [...this.subscriptions].filter(({ id, ended }) => id === null && !ended).map(({ topic }) => topic);
  }

  // Subscribes to a topic. Returns the function that ends the subscription. With `newestOnly` or a
  // form, this client skips messages, so that decoding takes at most a fifth of the page's time (more
  // if a single message takes longer than LONGEST_REST_MS / REST_SHARE).
  subscribe<Message>(
    topic: string,
    handler: (message: Message) => void,
    { newestOnly = false, form = "message", orElse }: TopicOptions = {},
  ): () => void {
    const subscription: Subscription = {
      topic,
      orElse,
      handler: handler as Handler,
      newestOnly: newestOnly || form !== "message",
      form,
      waiting: null,
      isBusy: false,
      restsUntilMs: -Infinity,
      id: null,
      ended: false,
    };
    this.subscriptions.add(subscription);
    this.request([subscription]);
    return () => this.unsubscribe(subscription);
  }

  // Requests the value of a parameter from the server. Resolves to null if the server offers no
  // parameters, if the connection is lost, or if the same parameter is requested again before the
  // answer.
  parameter(name: string): Promise<ParameterValue | null> {
    this.questions.get(name)?.(null); // ends an older request that is still pending
    if (!this.hasParameters) return Promise.resolve(null);
    return new Promise((resolve) => {
      this.questions.set(name, resolve);
      this.send({ op: "getParameters", parameterNames: [name], id: name });
    });
  }

  // A view whose images the server draws. Call show() of the result when the reader's callback
  // reports that the stream is open.
  openView(reader: ViewReader): LiveView {
    return this.views.openView(reader);
  }

  private unsubscribe(subscription: Subscription): void {
    this.subscriptions.delete(subscription);
    const { id } = subscription;
    if (id === null) return;
    subscription.id = null;
    const shared = this.subscribed.get(id);
    shared?.subscriptions.delete(subscription);
    if (!shared || shared.subscriptions.size > 0) return;
    this.subscribed.delete(id);
    this.send({ op: "unsubscribe", subscriptionIds: [id] });
  }

  private open(): void {
    this.attempt += 1;
    this.events.onConnection({ phase: "connecting", attempt: this.attempt });
    const socket = new this.SocketClass(this.url, SUBPROTOCOLS);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    this.timer = setTimeout(() => this.lost(socket), OPENING_TIMEOUT_MS);
    socket.onopen = () => {
      clearTimeout(this.timer);
      this.attempt = 0;
      this.events.onConnection({ phase: "open" });
    };
    socket.onmessage = (event: MessageEvent) => this.receive(event.data);
    socket.onclose = () => this.lost(socket);
  }

  private lost(socket: WebSocket): void {
    if (socket !== this.socket) return;
    this.abandon();
    const wait = backoffMs(Math.max(1, this.attempt));
    this.events.onConnection({
      phase: "waiting",
      attempt: this.attempt,
      retryAtMs: Date.now() + wait,
    });
    this.timer = setTimeout(() => this.open(), wait);
  }

  private abandon(): void {
    const socket = this.socket;
    this.socket = null;
    clearTimeout(this.timer);
    this.channels.clear();
    this.subscribed.clear();
    this.hasParameters = false;
    this.views.lost();
    this.lasting.clear();
    this.tellLasting();
    for (const name of [...this.questions.keys()]) this.answer(name, null);
    for (const subscription of this.subscriptions) Object.assign(subscription, { id: null, ended: false });
    if (!socket) return;
    socket.onopen = socket.onmessage = socket.onclose = null;
    socket.close();
  }

  private receive(data: unknown): void {
    try {
      if (typeof data === "string") this.receiveText(data);
      else if (data instanceof ArrayBuffer) this.receiveBinary(new DataView(data));
    } catch (error) {
      this.problem(`Cannot read a message of the server: ${sentenceOf(error)}`);
    }
  }

  private receiveText(text: string): void {
    const message = JSON.parse(text) as Record<string, unknown>;
    switch (message.op) {
      case "serverInfo": {
        const capabilities = (message.capabilities ?? []) as unknown[];
        this.hasParameters = capabilities.includes("parameters");
        this.views.connected(capabilities.includes("gsvViews"));
        break;
      }
      case "gsvViewFailure":
        this.views.takeFailure(message);
        break;
      case "parameterValues":
        for (const { name, value } of (message.parameters ?? []) as { name: string; value: ParameterValue }[]) {
          this.answer(name, value);
        }
        break;
      case "advertise":
        this.advertise((message.channels ?? []) as Channel[]);
        break;
      case "unadvertise":
        this.unadvertise((message.channelIds ?? []) as number[]);
        break;
      case "status":
        if (message.id !== undefined && Number(message.level) >= 1) {
          this.lasting.set(String(message.id), String(message.message));
          this.tellLasting();
        } else if (Number(message.level) >= 1) this.problem(String(message.message));
        break;
      case "removeStatus":
        for (const id of (message.statusIds ?? []) as unknown[]) this.lasting.delete(String(id));
        this.tellLasting();
        break;
    }
  }

  private tellLasting(): void {
    this.events.onLasting?.([...this.lasting.values()]);
  }

  private answer(name: string, value: ParameterValue | null): void {
    this.questions.get(name)?.(value);
    this.questions.delete(name);
  }

  private advertise(channels: Channel[]): void {
    for (const channel of channels) this.channels.set(channel.id, channel);
    this.request([...this.subscriptions]);
    this.tellTopics();
  }

  private unadvertise(ids: number[]): void {
    for (const id of ids) this.channels.delete(id);
    for (const [id, { subscriptions, channel }] of [...this.subscribed]) {
      if (!ids.includes(channel.id)) continue;
      this.subscribed.delete(id);
      for (const subscription of subscriptions) Object.assign(subscription, { id: null, ended: true });
    }
    this.tellTopics();
  }

  private tellTopics(): void {
    const topics = [...this.channels.values()].map(({ topic, schemaName }) => ({ name: topic, type: schemaName }));
    topics.sort((a, b) => (a.name < b.name ? -1 : 1));
    this.events.onTopics?.(topics);
  }

  private request(subscriptions: Subscription[]): void {
    const byTopic = new Map([...this.channels.values()].map((channel) => [channel.topic, channel]));
    const idOfChannel = new Map([...this.subscribed].map(([id, { channel }]) => [channel.id, id]));
    const begun = new Map<number, SubscribedChannel>(); // by the ID of the subscription
    const ended: number[] = [];
    for (const subscription of subscriptions) {
      const { topic, orElse } = subscription;
      const channel = byTopic.get(topic) ?? (orElse === undefined ? undefined : byTopic.get(orElse));
      if (!channel || subscription.id !== null) continue;
      const known = idOfChannel.get(channel.id);
      if (known !== undefined && begun.has(known)) {
        begun.get(known)!.subscriptions.add(subscription);
        subscription.id = known;
        continue;
      }
      // A new subscription makes the server send the current message. So a channel with earlier
      // readers is subscribed again.
      const earlier = known === undefined ? undefined : this.subscribed.get(known);
      if (earlier) ended.push(known!);
      const id = this.nextSubscription++;
      const shared = { channel, subscriptions: new Set([...(earlier?.subscriptions ?? []), subscription]) };
      for (const each of shared.subscriptions) each.id = id;
      idOfChannel.set(channel.id, id);
      begun.set(id, shared);
    }
    for (const id of ended) this.subscribed.delete(id);
    for (const [id, shared] of begun) this.subscribed.set(id, shared);
    if (ended.length > 0) this.send({ op: "unsubscribe", subscriptionIds: ended });
    const wanted = [...begun].map(([id, { channel }]) => ({ id, channelId: channel.id }));
    if (wanted.length > 0) this.send({ op: "subscribe", subscriptions: wanted });
  }

  private receiveBinary(frame: DataView): void {
    this.received += frame.byteLength;
    if (frame.byteLength < MESSAGE_DATA_HEADER_BYTES || frame.getUint8(0) !== MESSAGE_DATA) return;
    const id = frame.getUint32(1, true);
    const payload = new DataView(frame.buffer, frame.byteOffset + MESSAGE_DATA_HEADER_BYTES);
    const entry = this.subscribed.get(id);
    // A message of an unknown subscription is an image of a view, or of a topic that was
    // unsubscribed while the message was under way.
    if (!entry) return void this.views.takeMessage(id, frame.getBigUint64(5, true), payload);
    const { subscriptions, channel } = entry;
    this.count(channel.topic, frame.byteLength);
    for (const subscription of [...subscriptions]) {
      if (subscription.newestOnly) this.handOverLater(subscription, channel, payload);
      else this.handOver(subscription, channel, payload);
    }
  }

  private count(topic: string, bytes: number): void {
    const known = this.counted.get(topic);
    if (!known) return void this.counted.set(topic, { messages: 1, bytes });
    known.messages += 1;
    known.bytes += bytes;
  }

  // Decodes the newest message of the subscription. Before this, it waits for all messages that
  // have already arrived, and for the pause after the previous decoded message. If a newer message
  // arrives during this time, or while the previous one is decoded, the older one is dropped.
  private handOverLater(subscription: Subscription, channel: Channel, payload: DataView): void {
    subscription.waiting = { channel, payload };
    if (!subscription.isBusy) this.schedule(subscription);
  }

  private schedule(subscription: Subscription): void {
    subscription.isBusy = true;
    const rest = Math.max(0, subscription.restsUntilMs - performance.now());
    setTimeout(() => void this.handOverNewest(subscription), rest);
  }

  private async handOverNewest(subscription: Subscription): Promise<void> {
    const { waiting: newest, id } = subscription;
    subscription.waiting = null;
    let spentMs = 0; // the page's time, without the time of the worker
    const timed = <Result>(work: () => Result): Result => {
      const began = performance.now();
      try {
        return work();
      } finally {
        spentMs += performance.now() - began;
      }
    };
    try {
      if (!newest || id === null) return;
      const { channel, payload } = newest;
      const isShared = (this.subscribed.get(id)?.subscriptions.size ?? 0) > 1;
      const decoding = timed(() => this.decodeNewest(channel, payload, subscription.form, isShared));
      const decoded = await decoding;
      if (subscription.id !== id) return;
      if (decoded === "lost") this.renew(subscription);
      else if (decoded) timed(() => subscription.handler(decoded.message));
    } finally {
      subscription.restsUntilMs = performance.now() + Math.min(LONGEST_REST_MS, REST_SHARE * spentMs);
      subscription.isBusy = false;
      if (subscription.waiting) this.schedule(subscription);
    }
  }

  // Resolves to null if the message cannot be decoded, and to "lost" if the worker has ended.
  private async decodeNewest(channel: Channel, payload: DataView, form: Form, isShared: boolean): Promise<{ message: unknown } | "lost" | null> {
    try {
      return { message: await this.newestDecoder.decode(channel, payload, form, isShared) };
    } catch (error) {
      if (error instanceof WorkerLost) return "lost";
      this.problem(`A message on ${channel.topic} cannot be read: ${sentenceOf(error)}`);
      return null;
    }
  }

  // Subscribes again, so that the server sends the current message again.
  private renew(subscription: Subscription): void {
    this.unsubscribe(subscription);
    this.subscriptions.add(subscription);
    this.request([subscription]);
  }

  private handOver(subscription: Subscription, channel: Channel, payload: DataView): void {
    let message: unknown;
    try {
      message = this.decoders.decoderOf(channel)(payload);
    } catch (error) {
      this.problem(`A message on ${channel.topic} cannot be read: ${sentenceOf(error)}`);
      return;
    }
    subscription.handler(message);
  }

  private send(message: object): void {
    if (this.socket?.readyState === this.SocketClass.OPEN) this.socket.send(JSON.stringify(message));
  }

  // Reports each sentence only once, because a stream may repeat its faults many times per second.
  private problem(sentence: string): void {
    if (this.reported.has(sentence) || this.reported.size > 100) return;
    this.reported.add(sentence);
    this.events.onProblem(sentence);
  }
}

function sentenceOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
