// Screens on which the page shows one thing at a time, such as phones.

export const NARROW = "(max-width: 760px)"; // as in the style sheets

export function isNarrow(): boolean {
  return typeof matchMedia === "function" && matchMedia(NARROW).matches;
}
