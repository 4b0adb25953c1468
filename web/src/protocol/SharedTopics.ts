// The topics that the page reads. However many read one, it is subscribed once, so that the server sends
// and the page decodes each message once: a server refuses a second subscription of a channel. It ends
// with its last reader, and outlives the source: whoever reads goes on reading from the next one.

type Handler = (message: unknown) => void;

export interface TopicOptions {
  // Of messages that arrive faster than the page can take them only the newest is decoded. A topic is read
  // so only while all its readers ask for it.
  newestOnly?: boolean;
  // The topic that is read where the server does not offer the first one.
  orElse?: string;
}

export interface TopicSource {
  // Calls the handler with each message of the topic from now on, and at once with the newest one where
  // others read it already. Gives the function that ends it. A topic that nobody offers has no messages.
  subscribe<Message>(topic: string, handler: (message: Message) => void, options?: TopicOptions): () => void;
}

interface SharedTopic {
  handlers: Map<Handler, { newestOnly: boolean }>;
  orElse: string | undefined; // as its first reader asks for it
  newest: { message: unknown } | null;
  newestOnly: boolean; // how it is subscribed
  end(): void;
}

export class SharedTopics implements TopicSource {
  private source: TopicSource | null = null;
  private readonly topics = new Map<string, SharedTopic>();

  // Reads from this source from now on; null: from none. What the one before sent is forgotten.
  attach(source: TopicSource | null): void {
    for (const shared of this.topics.values()) shared.end();
    this.source = source;
    for (const [topic, shared] of this.topics) {
      shared.newest = null;
      this.open(topic, shared);
    }
  }

  // Those that somebody reads.
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
    // Of its own, as one function may listen twice.
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

  // Subscribes it in the other way where its readers now ask for that.
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
