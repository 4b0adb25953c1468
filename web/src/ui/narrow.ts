// Determines whether the screen is so narrow that the page shows one thing at a time, for example
// on a phone.

export const NARROW = "(max-width: 760px)"; // as in the style sheets

export function isNarrow(): boolean {
  return typeof matchMedia === "function" && matchMedia(NARROW).matches;
}
