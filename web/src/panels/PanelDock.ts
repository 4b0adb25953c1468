// The place below the view where panels stand, each in a frame with its title, its tools and a button that
// closes it. It fetches a panel when it is opened for the first time, and keeps it from then on.
import type { State } from "../state/State";
import type { StateReader } from "../state/Store";
import { element } from "../ui/element";
import { icon } from "../ui/icons";
import type { MountedPanel, Panel } from "./contract/Panel";
import { isOpen } from "./contract/Panel";
import type { PanelPorts } from "./contract/ports";

export function createPanelDock(
  panels: readonly Panel[],
  ports: PanelPorts,
  close: (id: string) => void,
): HTMLElement {
  const dock = element("div", { class: "dock" });
  for (const panel of panels) dock.append(new Frame(panel, ports, close).element);
  return dock;
}

class Frame {
  readonly element: HTMLElement;
  private mounted: MountedPanel | null = null;
  private isLoading = false;
  private end: (() => void) | null = null; // null: it is closed
  private readonly state: StateReader<State>;

  constructor(
    private readonly panel: Panel,
    private readonly ports: PanelPorts,
    private readonly close: (id: string) => void,
  ) {
    this.state = ports.state;
    this.element = element("section", { class: `panel ${panel.id}`, "aria-label": panel.title, hidden: true });
    this.state.watch(
      (state) => isOpen(panel, state),
      () => void this.follow(),
    );
  }

  // Shows it or hides it, as the store says; what is not there yet is fetched first.
  private async follow(): Promise<void> {
    if (isOpen(this.panel, this.state.get()) && !this.mounted && !(await this.load())) return;
    const wanted = isOpen(this.panel, this.state.get());
    if (!this.mounted || wanted === (this.end !== null)) return;
    this.element.hidden = !wanted;
    if (wanted) {
      this.end = this.mounted.whileOpen?.() ?? (() => {});
      this.element.scrollIntoView?.({ block: "nearest" }); // others may fill the dock
    } else {
      this.end?.();
      this.end = null;
    }
  }

  // Whether this call has brought the panel.
  private async load(): Promise<boolean> {
    if (this.isLoading) return false; // who asked first shows it
    this.isLoading = true;
    const { id, title, load } = this.panel;
    try {
      const { mount } = await load();
      const mounted = mount(this.ports);
      this.element.append(this.head(mounted.tools ?? []), mounted.body);
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

  private head(tools: HTMLElement[]): HTMLElement {
    const { id, title, key } = this.panel;
    const label = `Close ${title.toLowerCase()}`;
    const close = element(
      "button",
      {
        class: "button plain small",
        type: "button",
        "aria-label": label,
        title: key ? `${label} (${key})` : label,
        onclick: () => this.close(id),
      },
      icon("close"),
    );
    return element(
      "div",
      { class: "panel-head" },
      element("h2", {}, title),
      element("div", { class: "panel-tools" }, ...tools),
      close,
    );
  }
}
