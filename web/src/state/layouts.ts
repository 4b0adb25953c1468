// The saved layouts by name, and the present layout.
import { MAX_LAYOUT_CHARACTERS } from "./layout";

export interface SavedLayout {
  name: string;
  text: string; // in the format of state/layout.ts
}

export const MAX_SAVED = 40;
export const MAX_NAME = 60;
const SAVED_KEY = "gsv.layouts";
const CURRENT_KEY = "gsv.layout";
const FILE_VERSION = 1;

type Reading = Pick<Storage, "getItem"> | null;
type Writing = Pick<Storage, "setItem"> | null;

export function loadLayouts(storage: Reading): SavedLayout[] {
  try {
    const kept: unknown = JSON.parse(storage?.getItem(SAVED_KEY) ?? "[]");
    return Array.isArray(kept) ? kept.filter(isSaved).slice(0, MAX_SAVED) : [];
  } catch {
    return []; // the stored text was written by another program
  }
}

// Stores the layouts. Returns whether the browser has stored them.
export function keepLayouts(storage: Writing, saved: readonly SavedLayout[]): boolean {
  try {
    storage?.setItem(SAVED_KEY, JSON.stringify(saved));
    return storage !== null;
  } catch {
    return false;
  }
}

export function loadCurrent(storage: Reading): string | null {
  return storage?.getItem(CURRENT_KEY) ?? null;
}

export function keepCurrent(storage: Writing, text: string): void {
  try {
    storage?.setItem(CURRENT_KEY, text);
  } catch {
    // Nothing is saved if the storage is full, or if the browser does not allow storage, as in a
    // private window.
  }
}

export function fileOf({ name, text }: SavedLayout): string {
  return `${JSON.stringify({ gsv_layout: FILE_VERSION, name, layout: text }, null, 2)}\n`;
}

// Reads the layout in a file, or returns the reason why the file contains no layout.
export function fromFile(content: string): SavedLayout | { problem: string } {
  let told: unknown;
  try {
    told = JSON.parse(content);
  } catch {
    return { problem: "it is not JSON" };
  }
  const { gsv_layout: version, name, layout } = (told ?? {}) as Record<string, unknown>;
  if (version === undefined) return { problem: 'it has no "gsv_layout"' };
  if (version !== FILE_VERSION) return { problem: `it has version ${String(version).slice(0, 20)}; this page reads version ${FILE_VERSION}` };
  if (typeof layout !== "string") return { problem: 'it has no text "layout"' };
  return { name: typeof name === "string" && name.trim() !== "" ? name.trim().slice(0, MAX_NAME) : "Imported", text: layout };
}

function isSaved(value: unknown): value is SavedLayout {
  const { name, text } = (value ?? {}) as Record<string, unknown>;
  const isNamed = typeof name === "string" && name !== "" && name.length <= MAX_NAME;
  return isNamed && typeof text === "string" && text.length <= MAX_LAYOUT_CHARACTERS;
}
