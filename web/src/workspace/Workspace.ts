// The area beside the robot list: the view and the panels, docked by dockview. The store lists the
// open panels (openPanels). The user may move, resize, maximise and close panels, or open them in a
// separate window.
import type { DockviewApi, DockviewGroupPanel, IContentRenderer, IDockviewPanel, IHeaderActionsRenderer, ITabRenderer } from "dockview";
import { createDockview } from "dockview";
import type { Panel } from "../panels/contract/Panel";
import { EDIT_PANEL } from "../state/editing";
import type { PanelPorts } from "../panels/contract/ports";
import { element } from "../ui/element";
import { NARROW } from "../ui/narrow";
import { fromDockview, toDockview } from "./dockviewLayout";
import { Frame } from "./Frame";
import { createGroupHead } from "./GroupHead";
import type { Split } from "../state/layout";
import { VIEW, narrowLayout, panelsOf, textOf } from "../state/layout";
import type { Space } from "./presets";
import { SideRoom } from "./SideRoom";

const SIDE_PX = 300;
const BELOW_PX = 250;
const TOP_SIDE_SHARE = 0.62; // fraction of the height
const MIN_WIDTH_PX = 150;
const MIN_HEIGHT_PX = 120;
const SMALL_PX = 480; // width below which a part is too small for several images
const POPOUT_PAGE = "popout.html";

export interface WorkspacePanels {
  panels: readonly Panel[];
  ports: PanelPorts;
  setOpen(ids: string[]): void; // stores the ids of the open panels
}

export interface ViewParts {
  body: HTMLElement;
  tools: HTMLElement[]; // buttons in the header of the view
}

export class Workspace {
  readonly element = element("main", { class: "workspace" });
  // Called after the user or a program has changed the layout, but not on narrow screens.
  onChange: (layout: string) => void = () => {};
  private readonly api: DockviewApi;
  private readonly frames = new Map<string, Frame>();
  private readonly room: SideRoom;
  private readonly narrow: MediaQueryList | null;
  private wide: Split | null = null; // the layout of the wide screen, while the screen is narrow
  private isApplying = false;

  constructor(
    private readonly view: ViewParts,
    private readonly of: WorkspacePanels,
    private readonly standard: (space: Space) => Split,
  ) {
    for (const panel of of.panels) {
      this.frames.set(panel.id, new Frame(panel, of.ports, (id) => this.close(id)));
    }
    this.narrow = typeof matchMedia === "function" ? matchMedia(NARROW) : null;
    this.api = createDockview(this.element, {
      theme: { name: "gsv", className: "dockview-theme-gsv", gap: 0, dndPanelOverlay: "group" },
      createComponent: ({ id }) => this.contentOf(id),
      createTabComponent: () => new TabTitle(),
      defaultTabComponent: "tab",
      createRightHeaderActionComponent: (group) => this.headOf(group),
      disableFloatingGroups: true,
      popoutUrl: new URL(POPOUT_PAGE, document.baseURI).pathname,
      scrollbars: "native",
      disableDnd: this.isNarrow,
    });
    this.room = new SideRoom(this.api);
    this.api.onDidRemovePanel(({ id }) => this.follow(id));
    this.api.onDidLayoutChange(() => this.changed());
    this.api.onDidOpenPopoutWindowFail(() =>
      of.ports.notices.notify("error", "The browser did not open a window. Allow pop-up windows for this page and try again."),
    );
    this.narrow?.addEventListener("change", () => this.changeWidth());
    of.ports.state.watch(({ openPanels }) => openPanels, (ids) => this.showPanels(ids));
  }

  get isNarrow(): boolean {
    return this.narrow?.matches ?? false;
  }

  get space(): Space {
    const { clientWidth, clientHeight } = this.element;
    return { width: clientWidth || 1000, height: clientHeight || 700 };
  }

  // The present layout as text. On a narrow screen, this is the layout of the wide screen.
  get layout(): string {
    const layout = this.isNarrow ? this.wide : fromDockview(this.api.toJSON());
    return layout ? textOf(layout) : textOf(this.standard(this.space));
  }

  // Shows the panels of the layout at their places.
  show(layout: Split): void {
    this.wide = layout;
    const { editing } = this.of.ports.state.get();
    const open = panelsOf(layout).filter((id) => id !== VIEW && (id !== EDIT_PANEL || editing !== null));
    this.apply(this.isNarrow ? narrowLayout(open, null) : layout);
    this.of.setOpen(open); // this may close the panel for editing if nobody edits
  }

  isInSight(id: string): boolean {
    return this.api.getPanel(id)?.api.isVisible ?? false;
  }

  // If a panel is behind another tab, brings it to the front.
  reveal(id: string): void {
    this.api.getPanel(id)?.api.setActive();
  }

  enlarge(id: string): void {
    const group = this.api.getPanel(id)?.group;
    if (group?.api.location.type === "grid" && !this.isNarrow && group.width < SMALL_PX) group.api.maximize();
  }

  // Ends Maximise. Returns whether a part was maximised.
  restoreSize(): boolean {
    const isMaximised = this.api.hasMaximizedGroup();
    if (isMaximised) this.api.exitMaximizedGroup();
    return isMaximised;
  }

  private apply(layout: Split): void {
    this.isApplying = true;
    this.room.forget();
    try {
      const panels = panelsOf(layout).map((id) => ({ id, title: this.titleOf(id) }));
      // Sets the size of the dock first, because a dock without a size ignores the sizes of its
      // parts.
      this.api.layout(this.space.width, this.space.height, true);
      this.api.fromJSON(toDockview(layout, this.space, panels), { reuseExistingPanels: true });
      for (const panel of this.api.panels) this.constrain(panel);
    } finally {
      this.isApplying = false;
    }
    this.changed();
  }

  private showPanels(ids: readonly string[]): void {
    if (this.isApplying || !this.api.getPanel(VIEW)) return;
    for (const panel of this.api.panels) {
      if (panel.id !== VIEW && !ids.includes(panel.id)) this.api.removePanel(panel);
    }
    for (const id of ids) if (!this.api.getPanel(id)) this.add(id);
  }

  // Opens a panel beside panels of its kind. If there are none, opens it in a new part at the side
  // of the view or below the view.
  private add(id: string): void {
    const panel = this.of.panels.find((each) => each.id === id);
    if (!panel) return;
    const place = panel.place ?? "below";
    const kin = this.kinOf(id, this.isNarrow ? null : place);
    const first = !kin && this.api.getPanel(VIEW);
    const direction = this.isNarrow || place === "below" ? "below" : "right";
    const size = direction === "below" ? { initialHeight: Math.min(BELOW_PX, this.space.height / 2) } : { initialWidth: SIDE_PX };
    const side = place === "top-side" && !this.isNarrow ? this.kinOf(id, "side") : undefined;
    if (side) {
      this.room.make(this.sideColumn(), 1 - TOP_SIDE_SHARE);
      const top = this.sideColumn()[0]?.activePanel ?? side;
      const position = { referencePanel: top, direction: "above" as const };
      return this.constrain(this.api.addPanel({ id, component: id, tabComponent: "tab", title: panel.title, position, initialHeight: TOP_SIDE_SHARE * this.space.height }));
    }
    const position = kin
      ? { referencePanel: kin, direction: "within" as const }
      : { referencePanel: first || VIEW, direction: direction as "below" | "right" };
    this.constrain(this.api.addPanel({ id, component: id, tabComponent: "tab", title: panel.title, position, ...(kin ? {} : size) }));
  }

  // Returns an open panel whose part accepts this panel as a tab. If `place` is null, any part
  // except the view's part is accepted.
  private kinOf(id: string, place: Panel["place"] | null): IDockviewPanel | undefined {
    const viewGroup = this.api.getPanel(VIEW)?.group;
    const placeOf = (each: string) => this.of.panels.find((panel) => panel.id === each)?.place ?? "below";
    const kin = this.api.panels.filter(
      (each) =>
        each.id !== id &&
        each.group !== viewGroup &&
        each.api.location.type === "grid" &&
        (place === null || placeOf(each.id) === place),
    );
    return kin.find((each) => each.api.isActive) ?? kin[0];
  }

  // The parts beside the view, from the top.
  private sideColumn(): DockviewGroupPanel[] {
    const viewGroup = this.api.getPanel(VIEW)?.group;
    const top = (group: DockviewGroupPanel) => group.element.getBoundingClientRect().top;
    const isAtSide = (group: DockviewGroupPanel) =>
      group !== viewGroup &&
      group.api.location.type === "grid" &&
      group.panels.some(({ id }) => this.of.panels.find((panel) => panel.id === id)?.place === "side");
    return this.api.groups.filter(isAtSide).sort((a, b) => top(a) - top(b));
  }

  private constrain(panel: IDockviewPanel): void {
    panel.api.group.api.setConstraints({ minimumWidth: MIN_WIDTH_PX, minimumHeight: MIN_HEIGHT_PX });
  }

  private close(id: string): void {
    const panel = this.api.getPanel(id);
    if (panel) this.api.removePanel(panel);
    this.follow(id);
  }

  // Called when the user has closed a panel.
  private follow(id: string): void {
    if (this.isApplying) return;
    if (this.of.panels.find((panel) => panel.id === id)?.place === "top-side") this.room.restore();
    const { openPanels } = this.of.ports.state.get();
    if (openPanels.includes(id)) this.of.setOpen(openPanels.filter((each) => each !== id));
  }

  private changed(): void {
    if (this.isApplying || this.isNarrow || !this.api.getPanel(VIEW)) return;
    const layout = fromDockview(this.api.toJSON());
    if (!layout || !panelsOf(layout).includes(VIEW)) return;
    this.wide = layout;
    this.onChange(textOf(layout));
  }

  // Adapts the layout to a change between a narrow and a wide screen. No panel is closed.
  private changeWidth(): void {
    this.api.updateOptions({ disableDnd: this.isNarrow });
    const { openPanels } = this.of.ports.state.get();
    if (this.isNarrow) return this.apply(narrowLayout(openPanels, this.api.activePanel?.id ?? null));
    this.apply(this.wide ?? this.standard(this.space));
    this.showPanels(openPanels);
  }

  private titleOf(id: string): string {
    return id === VIEW ? "View" : (this.of.panels.find((panel) => panel.id === id)?.title ?? id);
  }

  private contentOf(id: string): IContentRenderer {
    if (id === VIEW) return { element: this.view.body, init: () => {} };
    const frame = this.frames.get(id);
    if (!frame) return { element: element("div", { class: "panel" }), init: () => {} };
    let isGone = false;
    return {
      element: frame.element,
      init: ({ api }) => {
        frame.show(api.isVisible);
        // The element moves after this event.
        api.onDidLocationChange(() => setTimeout(() => frame.followWindow()));
        api.onDidVisibilityChange(({ isVisible }) => !isGone && frame.show(isVisible));
      },
      dispose: () => {
        isGone = true;
        frame.show(false);
      },
    };
  }

  private headOf(group: DockviewGroupPanel): IHeaderActionsRenderer {
    return createGroupHead(this.api, group, {
      viewTools: this.view.tools,
      keyOf: (id) => this.of.panels.find((panel) => panel.id === id)?.key ?? "",
      isNarrow: () => this.isNarrow,
    });
  }
}

class TabTitle implements ITabRenderer {
  readonly element = element("span", { class: "tab-title" });

  init({ title }: { title: string }): void {
    this.element.textContent = title;
  }
}
