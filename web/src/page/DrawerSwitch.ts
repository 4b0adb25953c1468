// The part of the status bar that shows whether the browser or the server draws the view, and
// changes it.
import type { ViewChoice } from "../app/ViewChoice";
import type { Drawer, State } from "../state/State";
import type { Store } from "../state/Store";
import { element, setText } from "../ui/element";

const TEXT: Record<Drawer, string> = { browser: "drawn by the browser", server: "drawn by the server" };
const TITLE: Record<Drawer, string> = {
  browser: "Let the server draw the view",
  server: "Let this browser draw the view",
};

// `choice` is null until the view has started. `canDraw` is true if the browser has WebGL.
export function createDrawerSwitch(
  store: Store<State>,
  choice: () => ViewChoice | null,
  canDraw: () => boolean,
  keep: (drawer: Drawer) => void,
): HTMLElement {
  const button = element("button", { class: "drawer-switch dim", type: "button", "data-testid": "drawer" });
  button.addEventListener("click", () => {
    const other = choice()?.other;
    if (!other) return;
    choice()!.choose(other);
    keep(other);
  });
  store.watch(
    ({ drawnBy }) => drawnBy,
    (drawer) => {
      button.hidden = drawer === null;
      if (drawer === null) return;
      setText(button, TEXT[drawer]);
      const hasChoice = drawer === "browser" || canDraw();
      button.disabled = !hasChoice;
      button.title = hasChoice ? TITLE[drawer] : "This browser has no WebGL, so the server draws the view";
    },
  );
  return button;
}
