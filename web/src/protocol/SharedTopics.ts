// The topics that the page reads. A topic that several readers read in one form is subscribed once,
// so that each message is decoded once. The subscription ends with its last reader. If the source
// changes, each topic is subscribed again at the new source.

import type { Form } from "./forms";

type Handler = (message: unknown) => void;

export interface TopicOptions {
  // If messages arrive faster than the page can decode them, only the newest message is decoded.
  // This option has an effect on a topic only while all its readers set it.
  newestOnly?: boolean;
  // The form in which the reader gets the messages (default: the message itself). In other forms,
  // older messages are skipped as with `newestOnly`, because a worker decodes large messages.
  form?: Form;
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
  topic: string;
  form: Form;
  handlers: Map<Handler, { newestOnly: boolean }>;
  // The topic to read if the server does not offer this topic. The first reader determines it.
  orElse: string | undefined;
  newest: { message: unknown } | null;
  newestOnly: boolean; // the mode of the subscription at the server
  end(): void;
}

export class SharedTopics implements TopicSource {
  private source: TopicSource | null = null;
  private readonly topics = new Map<string, SharedTopic>(); // by form and topic

  // Sets the source of all topics; null for none. Messages of the previous source are dropped.
  attach(source: TopicSource | null): void {
    for (const shared of this.topics.values()) shared.end();
    this.source = source;
    for (const shared of this.topics.values()) {
      shared.newest = null;
      this.open(shared);
    }
  }

  // The topics with readers.
  get read(): string[] {
    return [...new Set([...this.topics.values()].map(({ topic }) => topic))];
  }

  subscribe<Message>(
    topic: string,
    handler: (message: Message) => void,
    { newestOnly = false, form = "message", orElse }: TopicOptions = {},
  ): () => void {
    const key = `${form} ${topic}`;
    const known = this.topics.get(key);
    const shared = known ?? { topic, form, handlers: new Map(), orElse, newest: null, newestOnly, end: () => {} };
    // Each reader is a separate object, because one function may be added twice.
    const own: Handler = (message) => handler(message as Message);
    shared.handlers.set(own, { newestOnly });
    if (!known) {
      this.topics.set(key, shared);
      this.open(shared);
    } else {
      this.adapt(shared);
      if (shared.newest) own(shared.newest.message);
    }
    return () => {
      if (!shared.handlers.delete(own)) return;
      if (shared.handlers.size > 0) return this.adapt(shared);
      this.topics.delete(key);
      shared.end();
    };
  }

  // Subscribes again in the other mode if the readers now require it.
  private adapt(shared: SharedTopic): void {
    if (shared.newestOnly === asksForNewestOnly(shared)) return;
    shared.end();
    this.open(shared);
  }

  private open(shared: SharedTopic): void {
    shared.newestOnly = asksForNewestOnly(shared);
    const take = (message: unknown) => {
      shared.newest = { message };
      for (const handler of [...shared.handlers.keys()]) if (shared.handlers.has(handler)) handler(message);
    };
    const { topic, form, newestOnly, orElse } = shared;
    const options = { newestOnly, ...(form !== "message" && { form }), ...(orElse !== undefined && { orElse }) };
    shared.end = this.source?.subscribe<unknown>(topic, take, options) ?? (() => {});
  }
}

function asksForNewestOnly({ handlers }: SharedTopic): boolean {
  return [...handlers.values()].every(({ newestOnly }) => newestOnly);
}
