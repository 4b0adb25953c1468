// Shows, saves and shares layouts of the workspace. If a layout cannot be shown, an error is shown
// together with the standard layout.
import type { SavedLayout } from "../state/layouts";
import { MAX_NAME, MAX_SAVED, fileOf, fromFile, keepCurrent, keepLayouts, loadCurrent, loadLayouts } from "../state/layouts";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { download } from "../ui/files";
import type { Split } from "../state/layout";
import { readLayout, textOf } from "../state/layout";
import type { Preset, Space } from "../workspace/presets";
import { PRESETS, STANDARD } from "../workspace/presets";
import { notify } from "./notices";

const MAX_FILE_BYTES = 64_000;

// The workspace in which layouts are shown.
export interface LayoutHost {
  readonly layout: string;
  readonly space: Space;
  show(layout: Split): void;
}

export class LayoutControl {
  private host: LayoutHost | null = null;

  constructor(
    private readonly store: Store<State>,
    private readonly storage: Storage | null,
    private readonly known: ReadonlySet<string>, // ids of the existing panels
  ) {
    store.set({ layouts: loadLayouts(storage) });
  }

  // `linked` is the layout in the page's address; null if there is none.
  start(host: LayoutHost, linked: string | null): void {
    this.host = host;
    const kept = loadCurrent(this.storage);
    if (linked !== null) this.showText(linked, "The layout in the page's address");
    else if (kept !== null) this.showText(kept, "The last layout of this browser");
    else this.showPreset(STANDARD);
  }

  changed(text: string): void {
    keepCurrent(this.storage, text);
  }

  showPreset(preset: Preset): void {
    const { host } = this;
    host?.show(preset.layout(host.space));
  }

  showSaved({ name, text }: SavedLayout): void {
    this.showText(text, `The layout ${name}`);
  }

  // Shows a preset by its name, or a layout by its text. `what` is the layout's name in error
  // messages. Returns whether the layout could be shown.
  showText(text: string, what: string): boolean {
    const preset = PRESETS.find(({ name }) => name === text);
    if (preset) {
      this.showPreset(preset);
      return true;
    }
    const read = readLayout(text, this.known);
    if ("problem" in read) {
      notify(this.store, "error", `${what} cannot be shown: ${read.problem}. The page shows the standard layout.`);
      this.showPreset(STANDARD);
      return false;
    }
    if (read.unknown.length > 0) {
      notify(this.store, "note", `${what} is from another version of GSV. It has panels that this page does not know and leaves out: ${read.unknown.slice(0, 5).join(", ")}.`);
    }
    this.host?.show(read.layout);
    return true;
  }

  // The present layout for a link: the name of a preset, or the text of another layout. Null for
  // the standard layout, and if there is no host.
  get linkText(): string | null {
    const { host } = this;
    if (!host) return null;
    const text = host.layout;
    const preset = PRESETS.find(({ layout }) => textOf(layout(host.space)) === text);
    return preset ? (preset === STANDARD ? null : preset.name) : text;
  }

  // Saves the layout. Replaces a layout with the same name.
  save(name: string): void {
    const { host } = this;
    const trimmed = name.trim().slice(0, MAX_NAME);
    if (!host || trimmed === "") return notify(this.store, "error", "Type a name for the layout first.");
    if (!this.add({ name: trimmed, text: host.layout })) return;
    notify(this.store, "note", `Layout ${trimmed} saved in this browser.`);
  }

  remove(name: string): void {
    this.keep(this.store.get().layouts.filter((each) => each.name !== name));
  }

  exportFile(): void {
    if (!this.host) return;
    const saved = { name: "Layout", text: this.host.layout };
    download("gsv-layout.json", new Blob([fileOf(saved)], { type: "application/json" }));
  }

  async importFile(file: File): Promise<void> {
    const refuse = (problem: string) => notify(this.store, "error", `${file.name} is no layout: ${problem}.`);
    if (file.size > MAX_FILE_BYTES) return refuse(`it has ${file.size} bytes; the limit is ${MAX_FILE_BYTES}`);
    const read = fromFile(await file.text());
    if ("problem" in read) return refuse(read.problem);
    if (!this.showText(read.text, `The layout in ${file.name}`)) return;
    this.add(read);
  }

  // Adds a layout to the saved ones. Replaces a layout with the same name. If there are too many
  // layouts, reports an error and returns false.
  private add(layout: SavedLayout): boolean {
    const others = this.store.get().layouts.filter(({ name }) => name !== layout.name);
    if (others.length >= MAX_SAVED) {
      notify(this.store, "error", `${MAX_SAVED} layouts are saved already. Delete one first.`);
      return false;
    }
    this.keep([...others, layout]);
    return true;
  }

  private keep(layouts: SavedLayout[]): void {
    this.store.set({ layouts });
    if (!keepLayouts(this.storage, layouts)) {
      notify(this.store, "error", "This browser cannot store the layouts. Export the layout to a file instead.");
    }
  }
}
