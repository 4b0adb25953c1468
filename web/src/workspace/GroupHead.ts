// The buttons at the right end of a part's tabs. With them, the user can move the visible tab
// without a mouse.
import type { DockviewApi, DockviewGroupPanel, IDockviewPanel, IHeaderActionsRenderer } from "dockview";
import { element, setText } from "../ui/element";
import { icon } from "../ui/icons";
import { createMenu } from "../ui/menu";
import { VIEW } from "../state/layout";

export interface HeadParts {
  viewTools: HTMLElement[]; // shown at the part that contains the view
  keyOf(panel: string): string; // single key of a panel; empty if it has none
  isNarrow(): boolean; // whether the page is too narrow for parts beside each other
}

// If a narrow part has more tabs than this, there is no space for the button Maximise. The command
// is then in the part's menu.
const MAX_TABS = 2;
const SIDES = [
  ["left", "Move to the left of the view"],
  ["right", "Move to the right of the view"],
  ["top", "Move above the view"],
  ["bottom", "Move below the view"],
] as const;

export function createGroupHead(api: DockviewApi, group: DockviewGroupPanel, parts: HeadParts): IHeaderActionsRenderer {
  const place = element("div", { class: "group-head" });
  const tools = element("div", { class: "view-tools", role: "group", "aria-label": "View" });
  const active = () => group.activePanel;
  const item = (label: string, act: (panel: IDockviewPanel) => void) =>
    element(
      "button",
      {
        class: "button plain menu-line",
        type: "button",
        onclick: () => {
          const panel = active();
          menu.close();
          if (panel) act(panel);
        },
      },
      label,
    );
  const maximise = item("Maximise", () =>
    group.api.isMaximized() ? api.exitMaximizedGroup() : group.api.maximize(),
  );
  const large = element(
    "button",
    { class: "button plain small", type: "button", onclick: () => (group.api.isMaximized() ? api.exitMaximizedGroup() : group.api.maximize()) },
    icon("enlarge"),
  );
  const window = item("Open in a separate window", (panel) => {
    if (panel.api.location.type === "popout") panel.api.moveTo(besideView(api, "right"));
    else void api.addPopoutGroup(panel);
  });
  const moves = SIDES.map(([side, label]) => item(label, (panel) => panel.api.moveTo(besideView(api, side))));
  const next = item("Move to the next group of panels, as a tab", (panel) => {
    const group = nextGroup(api, panel);
    if (group) panel.api.moveTo({ group });
  });
  const menu = createMenu("Arrange", "more", maximise, window, ...moves, next);
  menu.button.classList.add("small");
  const close = element(
    "button",
    { class: "button plain small", type: "button", onclick: () => active()?.api.close() },
    icon("close"),
  );
  place.append(tools, large, menu.element, close);

  const show = () => {
    const panel = active();
    const isView = panel?.id === VIEW;
    const hasView = group.panels.some(({ id }) => id === VIEW);
    if (hasView) tools.replaceChildren(...parts.viewTools);
    tools.hidden = !isView;
    const title = (panel?.title ?? "panel").toLowerCase();
    close.hidden = isView || !panel;
    const key = panel ? parts.keyOf(panel.id) : "";
    close.setAttribute("aria-label", `Close ${title}`);
    close.title = key ? `Close ${title} (${key})` : `Close ${title}`;
    menu.button.setAttribute("aria-label", `Arrange ${title}`);
    menu.button.title = `Arrange ${title}`;
    const isOut = panel?.api.location.type === "popout";
    const isMaximised = group.api.location.type === "grid" && group.api.isMaximized();
    setText(maximise, isMaximised ? "Restore the size" : "Maximise");
    const largeLabel = isMaximised ? `Restore the size of ${title}` : `Maximise ${title}`;
    large.setAttribute("aria-label", largeLabel);
    large.title = isMaximised ? `${largeLabel} (Esc)` : largeLabel;
    large.hidden = isView || isOut || parts.isNarrow() || (!isMaximised && group.panels.length > MAX_TABS);
    setText(window, isOut ? "Return to the page" : "Open in a separate window");
    maximise.hidden = isOut;
    window.hidden = isView;
    for (const move of moves) move.hidden = isView || isOut || parts.isNarrow();
    next.hidden = isView || isOut || parts.isNarrow();
    menu.button.hidden = parts.isNarrow() && isView;
  };
  const ends = [
    group.api.onDidActivePanelChange(show),
    group.api.onDidLocationChange(show),
    api.onDidMaximizedGroupChange(show),
    api.onDidMovePanel(show),
    api.onDidAddPanel(show),
  ];
  menu.button.addEventListener("click", show);
  return { element: place, init: show, dispose: () => ends.forEach((end) => end.dispose()) };
}

function besideView(api: DockviewApi, position: "left" | "right" | "top" | "bottom") {
  const view = api.getPanel(VIEW);
  return view ? { group: view.group, position } : { position };
}

function nextGroup(api: DockviewApi, panel: IDockviewPanel): DockviewGroupPanel | undefined {
  const groups = api.groups.filter((group) => group.api.location.type === "grid" && !group.panels.some(({ id }) => id === VIEW));
  const at = groups.indexOf(panel.group);
  return groups[(at + 1) % groups.length];
}
