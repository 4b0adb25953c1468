// The state of the page, in one place. Panels watch the parts of the state that they show. They
// share nothing else.

export type Listener<T> = (value: T, previous: T | undefined) => void;

export class Store<State extends object> {
  private state: State;
  private readonly watchers = new Set<() => void>();

  constructor(initial: State) {
    this.state = initial;
  }

  get(): State {
    return this.state;
  }

  set(change: Partial<State> | ((state: State) => Partial<State>)): void {
    const patch = typeof change === "function" ? change(this.state) : change;
    this.state = { ...this.state, ...patch };
    for (const notify of [...this.watchers]) notify();
  }

  // Calls `listener` now, and whenever the selected part of the state changes (according to
  // `equal`). Returns a function that ends these calls.
  watch<T>(
    select: (state: State) => T,
    listener: Listener<T>,
    equal: (a: T, b: T) => boolean = Object.is,
  ): () => void {
    let current = select(this.state);
    const notify = () => {
      if (!this.watchers.has(notify)) return;
      const next = select(this.state);
      if (equal(next, current)) return;
      const previous = current;
      current = next;
      listener(next, previous);
    };
    this.watchers.add(notify);
    listener(current, undefined);
    return () => this.watchers.delete(notify);
  }
}

// Read-only access to the state.
export type StateReader<State extends object> = Pick<Store<State>, "get" | "watch">;

// Compares the members of two values. It is for selectors that create an object or a list in each
// call.
export function shallowEqual(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null) return false;
  const keys = Object.keys(a);
  if (keys.length !== Object.keys(b).length) return false;
  return keys.every((key) =>
    Object.is((a as Record<string, unknown>)[key], (b as Record<string, unknown>)[key]),
  );
}
