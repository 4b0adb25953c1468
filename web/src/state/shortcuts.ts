// Whether single keys (letters, digits, punctuation, Space) are commands. They can be turned off, as who
// talks to the computer, or strikes a key by accident, sets off commands with them (WCAG 2.1.4).
const KEY = "gsv.single-keys";
const OFF = "off";

export function loadSingleKeys(storage: Pick<Storage, "getItem"> | null): boolean {
  return storage?.getItem(KEY) !== OFF;
}

export function keepSingleKeys(storage: Pick<Storage, "setItem"> | null, isOn: boolean): void {
  try {
    storage?.setItem(KEY, isOn ? "on" : OFF);
  } catch {
    // A full or forbidden storage: it is forgotten, as in a private window.
  }
}
