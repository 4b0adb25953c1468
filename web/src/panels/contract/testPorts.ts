// Fake ports (the interface through which a panel reaches the page) for tests of panels. The test
// sets the state in their store, and sends the messages that the panel receives.
import { vi } from "vitest";
import type { TopicSource } from "../../protocol/SharedTopics";
import type { VisualFacts } from "../../api/visuals";
import type { WorldPart } from "../../state/worldPart";
import type { State } from "../../state/State";
import { initialState } from "../../state/State";
import { Store } from "../../state/Store";
import type { PanelPorts } from "./ports";

export class TestTopics implements TopicSource {
  private readonly handlers = new Map<string, Set<(message: never) => void>>();

  // The topics that are being read.
  get read(): string[] {
    return [...this.handlers.keys()];
  }

  subscribe<Message>(topic: string, handler: (message: Message) => void): () => void {
    const handlers = this.handlers.get(topic) ?? new Set();
    const own = (message: Message) => handler(message);
    this.handlers.set(topic, handlers.add(own));
    return () => {
      handlers.delete(own);
      if (handlers.size === 0) this.handlers.delete(topic);
    };
  }

  send(topic: string, message: unknown): void {
    for (const handler of this.handlers.get(topic) ?? []) handler(message as never);
  }
}

export function testPorts(state: Partial<State> = {}, server: Partial<PanelPorts["server"]> = {}, control: Partial<PanelPorts["control"]> = {}) {
  const store = new Store<State>({
    ...initialState,
    connection: { phase: "open" },
    view: "open",
    simulation: "house",
    ...state,
  });
  const topics = new TestTopics();
  const ports = {
    state: store,
    topics,
    traffic: { counts: vi.fn(() => new Map()), choose: vi.fn((topic: string | null) => store.set({ topic })), open: vi.fn() },
    server: {
      figures: vi.fn(async () => new Map()),
      parameter: vi.fn(async () => null),
      log: vi.fn(async () => []),
      output: vi.fn(async () => []),
      curve: vi.fn(async () => Promise.reject(new Error("no curve"))),
      pastCurve: vi.fn(async () => Promise.reject(new Error("no past"))),
      comparedCurve: vi.fn(async () => null),
      ...server,
    },
    commands: { list: vi.fn(async () => []), run: vi.fn(async () => {}) },
    control: {
      take: vi.fn(async () => {}),
      resume: vi.fn(),
      setDriven: vi.fn((driven: string | null) => store.set({ driven })),
      drive: vi.fn(async () => {}),
      joints: vi.fn(async () => ({ time: 0, joints: [], refusal: "" })),
      showJoints: vi.fn(),
      commandJoint: vi.fn(async () => {}),
      ...control,
    },
    shapes: { visuals: vi.fn(async (): Promise<VisualFacts[]> => []) },
    replay: { seek: vi.fn(async () => {}) },
    robots: {
      select: vi.fn(),
      inspect: vi.fn((part: WorldPart) => store.set({ part })),
      pick: vi.fn(),
      filter: vi.fn((change: object) => store.set(({ robotFilter }) => ({ robotFilter: { ...robotFilter, ...change } }))),
      follow: vi.fn(),
    },
    edits: { pose: vi.fn(async () => true) },
    cameras: { show: vi.fn(), showAll: vi.fn() },
    plots: {
      add: vi.fn(),
      remove: vi.fn(),
      setSpan: vi.fn((span: number | null) => store.set(({ plots }) => ({ plots: { ...plots, span } }))),
      setAgainst: vi.fn((against: string | null) => store.set(({ plots }) => ({ plots: { ...plots, against } }))),
      showEvents: vi.fn((events: boolean) => store.set(({ plots }) => ({ plots: { ...plots, events } }))),
    },
    notices: { notify: vi.fn(), copy: vi.fn(async () => {}) },
  } satisfies PanelPorts;
  return { store, topics, ports };
}
