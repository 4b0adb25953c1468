// Computes the waiting time before the next attempt. The time doubles with each attempt, up to a
// limit. It has a random part, so that not all viewers reconnect to a restarted server at once.
const FIRST_MS = 500;
const LONGEST_MS = 8000;
const SPREAD = 0.2;

export function backoffMs(attempt: number, random: () => number = Math.random): number {
  const middle = Math.min(LONGEST_MS, FIRST_MS * 2 ** Math.max(0, attempt - 1));
  return middle * (1 + SPREAD * (2 * random() - 1));
}
