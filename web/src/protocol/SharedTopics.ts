// Lets several listeners share one subscription of a topic, so that the server sends and the page
// decodes each message once: a server refuses a second one of the same channel. The subscription
// lasts as long as somebody listens; who comes later is handed the newest message at once.

type Handler = (message: unknown) => void;

interface SharedTopic {
  handlers: Set<Handler>;
  newest: { message: unknown } | null;
  end(): void;
}

export interface TopicSource {
  subscribe<Message>(topic: string, handler: (message: Message) => void): () => void;
}

export class SharedTopics implements TopicSource {
  private readonly topics = new Map<string, SharedTopic>();

  constructor(private readonly source: TopicSource) {}

  subscribe<Message>(topic: string, handler: (message: Message) => void): () => void {
    const shared = this.topics.get(topic) ?? this.open(topic);
    // Of its own, as one function may listen twice.
    const own: Handler = (message) => handler(message as Message);
    shared.handlers.add(own);
    if (shared.newest) own(shared.newest.message);
    return () => {
      shared.handlers.delete(own);
      if (shared.handlers.size > 0 || this.topics.get(topic) !== shared) return;
      this.topics.delete(topic);
      shared.end();
    };
  }

  private open(topic: string): SharedTopic {
    const shared: SharedTopic = { handlers: new Set(), newest: null, end: () => {} };
    this.topics.set(topic, shared);
    shared.end = this.source.subscribe<unknown>(topic, (message) => {
      shared.newest = { message };
      for (const handler of [...shared.handlers]) if (shared.handlers.has(handler)) handler(message);
    });
    return shared;
  }
}
