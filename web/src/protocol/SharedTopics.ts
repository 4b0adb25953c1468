// The topics that the page reads. A topic with several readers is subscribed once, so that each
// message is sent and decoded once. A server would also refuse a second subscription of a channel.
// The subscription ends with its last reader. If the source changes, each topic is subscribed again
// at the new source.

type Handler = (message: unknown) => void;

export interface TopicOptions {
  // If messages arrive faster than the page can decode them, only the newest message is decoded.
  // This option has an effect on a topic only while all its readers set it.
  newestOnly?: boolean;
  // The topic to read if the server does not offer the topic itself.
  orElse?: string;
}

export interface TopicSource {
  // Calls the handler with each message of the topic. If other readers already read the topic, also
  // calls it at once with the newest message. Returns the function that ends the subscription. If
  // no server offers the topic, there are no messages.
  subscribe<Message>(topic: string, handler: (message: Message) => void, options?: TopicOptions): () => void;
}

interface SharedTopic {
  handlers: Map<Handler, { newestOnly: boolean }>;
  // The topic to read if the server does not offer this topic. The first reader determines it.
  orElse: string | undefined;
  newest: { message: unknown } | null;
  newestOnly: boolean; // the mode of the subscription at the server
  end(): void;
}

export class SharedTopics implements TopicSource {
  private source: TopicSource | null = null;
  private readonly topics = new Map<string, SharedTopic>();

  // Sets the source of all topics; null for none. Messages of the previous source are dropped.
  attach(source: TopicSource | null): void {
    for (const shared of this.topics.values()) shared.end();
    this.source = source;
    for (const [topic, shared] of this.topics) {
      shared.newest = null;
      this.open(topic, shared);
    }
  }

  // The topics with readers.
  get read(): string[] {
    return [...this.topics.keys()];
  }

  subscribe<Message>(
    topic: string,
    handler: (message: Message) => void,
    { newestOnly = false, orElse }: TopicOptions = {},
  ): () => void {
    const known = this.topics.get(topic);
    const shared = known ?? { handlers: new Map(), orElse, newest: null, newestOnly, end: () => {} };
    // Each reader is a separate object, because one function may be added twice.
    const own: Handler = (message) => handler(message as Message);
    shared.handlers.set(own, { newestOnly });
    if (!known) {
      this.topics.set(topic, shared);
      this.open(topic, shared);
    } else {
      this.adapt(topic, shared);
      if (shared.newest) own(shared.newest.message);
    }
    return () => {
      if (!shared.handlers.delete(own)) return;
      if (shared.handlers.size > 0) return this.adapt(topic, shared);
      this.topics.delete(topic);
      shared.end();
    };
  }

  // Subscribes again in the other mode if the readers now require it.
  private adapt(topic: string, shared: SharedTopic): void {
    if (shared.newestOnly === asksForNewestOnly(shared)) return;
    shared.end();
    this.open(topic, shared);
  }

  private open(topic: string, shared: SharedTopic): void {
    shared.newestOnly = asksForNewestOnly(shared);
    const take = (message: unknown) => {
      shared.newest = { message };
      for (const handler of [...shared.handlers.keys()]) if (shared.handlers.has(handler)) handler(message);
    };
    const options = { newestOnly: shared.newestOnly, ...(shared.orElse !== undefined && { orElse: shared.orElse }) };
    shared.end = this.source?.subscribe<unknown>(topic, take, options) ?? (() => {});
  }
}

function asksForNewestOnly({ handlers }: SharedTopic): boolean {
  return [...handlers.values()].every(({ newestOnly }) => newestOnly);
}
