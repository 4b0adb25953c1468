// The place of one panel in the workspace: its tools and its body, or the reason why they are
// missing. The panel is fetched when it is first visible, and then kept.
import type { MountedPanel, Panel } from "../panels/contract/Panel";
import type { PanelPorts } from "../panels/contract/ports";
import { element, setText } from "../ui/element";

export class Frame {
  readonly element: HTMLElement;
  private readonly absence = element("p", { class: "panel-absent hint" });
  private readonly content = element("div", { class: "panel-content" });
  private mounted: MountedPanel | null = null;
  private isLoading = false;
  private isInSight = false;
  private window: Window | null = null; // the window of the panel, once it has moved
  private end: (() => void) | null = null; // null while the panel reads no data

  constructor(
    private readonly panel: Panel,
    private readonly ports: PanelPorts,
    private readonly close: (id: string) => void,
  ) {
    this.element = element("div", { class: `panel ${panel.id}` }, this.absence, this.content);
    this.absence.hidden = true;
    ports.state.watch(panel.isAvailable, () => void this.follow());
  }

  // Whether the panel is visible: its tab is in front.
  show(isInSight: boolean): void {
    this.isInSight = isInSight;
    void this.follow();
  }

  // Called when the panel may have moved to another window.
  followWindow(): void {
    const { defaultView } = this.element.ownerDocument;
    if (defaultView === (this.window ?? window)) return;
    this.window = defaultView;
    this.mounted?.afterMove?.();
  }

  private get isWanted(): boolean {
    return this.isInSight && this.panel.isAvailable(this.ports.state.get());
  }

  private async follow(): Promise<void> {
    const isAvailable = this.panel.isAvailable(this.ports.state.get());
    this.absence.hidden = isAvailable;
    this.content.hidden = !isAvailable;
    setText(this.absence, isAvailable ? "" : (this.panel.absence ?? "This panel has nothing to show here."));
    if (this.isWanted && !this.mounted && !(await this.load())) return;
    if (!this.mounted || this.isWanted === (this.end !== null)) return;
    if (this.isWanted) {
      this.end = this.mounted.whileOpen?.() ?? (() => {});
    } else {
      this.end?.();
      this.end = null;
    }
  }

  // Loads the panel. Returns whether this call has loaded it.
  private async load(): Promise<boolean> {
    if (this.isLoading) return false; // the first call shows the panel
    this.isLoading = true;
    const { id, title, load } = this.panel;
    try {
      const { mount } = await load();
      const mounted = mount(this.ports);
      if (mounted.tools?.length) this.content.append(element("div", { class: "panel-tools" }, ...mounted.tools));
      this.content.append(mounted.body);
      this.mounted = mounted;
      return true;
    } catch (error) {
      const reason = (error as Error).message;
      this.ports.notices.notify("error", `The panel ${title} cannot be opened: ${reason}. Reload the page and try again.`);
      this.close(id);
      return false;
    } finally {
      this.isLoading = false;
    }
  }
}
