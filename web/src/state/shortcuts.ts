// Whether single keys (letters, digits, punctuation, Space) are commands. The user can turn them
// off. Otherwise, speech input or an accidental key press would trigger commands (WCAG 2.1.4).
const KEY = "gsv.single-keys";
const OFF = "off";

export function loadSingleKeys(storage: Pick<Storage, "getItem"> | null): boolean {
  return storage?.getItem(KEY) !== OFF;
}

export function keepSingleKeys(storage: Pick<Storage, "setItem"> | null, isOn: boolean): void {
  try {
    storage?.setItem(KEY, isOn ? "on" : OFF);
  } catch {
    // Nothing is saved if the storage is full, or if the browser does not allow storage, as in a
    // private window.
  }
}

// The keys that the user has changed, by the command's default key (lower case).
export type ChangedKeys = Readonly<Record<string, string>>;

const CHANGED = "gsv.keys";
const MAX_CHANGED = 100;

export function loadChangedKeys(storage: Pick<Storage, "getItem"> | null): ChangedKeys {
  let kept: unknown = null;
  try {
    kept = JSON.parse(storage?.getItem(CHANGED) ?? "null");
  } catch {
    // Ignored: the stored text was written by another program.
  }
  if (typeof kept !== "object" || kept === null) return {};
  const isKey = (key: unknown): key is string => typeof key === "string" && [...key].length === 1;
  return Object.fromEntries(Object.entries(kept).filter((entry): entry is [string, string] => isKey(entry[0]) && isKey(entry[1])).slice(0, MAX_CHANGED));
}

export function keepChangedKeys(storage: Pick<Storage, "setItem"> | null, changed: ChangedKeys): void {
  try {
    storage?.setItem(CHANGED, JSON.stringify(changed));
  } catch {
    // Nothing is saved if the storage is full, or if the browser does not allow storage, as in a
    // private window.
  }
}

// Returns the present key of the command with this default key.
export function keyOf(original: string, changed: ChangedKeys): string {
  const key = original.toLowerCase();
  return Object.hasOwn(changed, key) ? changed[key]! : key;
}

// Returns the default key of the command to which the pressed key is assigned; empty if there is
// none.
export function originalKey(pressed: string, changed: ChangedKeys): string {
  const key = pressed.toLowerCase();
  const found = Object.keys(changed).find((original) => changed[original] === key);
  if (found !== undefined) return found;
  return Object.hasOwn(changed, key) ? "" : key;
}

// Assigns another key to the command with this default key. If another command has that key, the
// two commands exchange their keys.
export function withChangedKey(changed: ChangedKeys, original: string, pressed: string): ChangedKeys {
  const [own, key] = [original.toLowerCase(), pressed.toLowerCase()];
  const former = keyOf(own, changed);
  const other = originalKey(key, changed);
  const all = { ...changed, [own]: key, ...(other !== "" && other !== own && { [other]: former }) };
  return Object.fromEntries(Object.entries(all).filter(([from, to]) => from !== to));
}
