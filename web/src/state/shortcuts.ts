// Whether single keys (letters, digits, punctuation, Space) are commands. They can be turned off,
// because speech input or an accidental key press would trigger commands (WCAG 2.1.4).
const KEY = "gsv.single-keys";
const OFF = "off";

export function loadSingleKeys(storage: Pick<Storage, "getItem"> | null): boolean {
  return storage?.getItem(KEY) !== OFF;
}

export function keepSingleKeys(storage: Pick<Storage, "setItem"> | null, isOn: boolean): void {
  try {
    storage?.setItem(KEY, isOn ? "on" : OFF);
  } catch {
    // If the storage is full or not allowed, nothing is saved, as in a private window.
  }
}
