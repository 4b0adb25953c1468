// Makes short messages at the edge of the page: refusals of the server and news of robots.
import type { NoticeAction, State } from "../state/State";
import type { Store } from "../state/Store";

const LONGEST_LIST = 4;
const NOTE_MS = 6000;
const ERROR_MS = 12_000;
// Additional time for each character, so that a slow reader can finish a long message.
const READING_MS = 60;

let nextId = 1;

export function notify(store: Store<State>, kind: "error" | "note", sentence: string): void {
  post(store, kind, sentence);
}

// Shows a note with a button. Returns a function that removes it.
export function offer(store: Store<State>, sentence: string, action: NoticeAction): () => void {
  const id = post(store, "note", sentence, action);
  return () => dismiss(store, id);
}

export function dismiss(store: Store<State>, id: number): void {
  store.set(({ notices }) => ({ notices: notices.filter((each) => each.id !== id) }));
}

// Returns the id of the message.
function post(store: Store<State>, kind: "error" | "note", sentence: string, action?: NoticeAction): number {
  const id = nextId++;
  store.set(({ notices }) => ({
    notices: [...notices.filter((each) => each.sentence !== sentence), { id, kind, sentence, ...(action && { action }) }].slice(
      -LONGEST_LIST,
    ),
  }));
  const least = kind === "error" || action ? ERROR_MS : NOTE_MS;
  setTimeout(() => dismiss(store, id), Math.max(least, READING_MS * sentence.length));
  return id;
}
