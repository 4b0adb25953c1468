// The part of the status bar that shows whether the browser or the server draws the view, and
// changes it.
import type { App } from "../app/App";
import type { Drawer, State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { element, setText } from "../ui/element";

const TEXT: Record<Drawer, string> = { browser: "drawn by the browser", server: "drawn by the server" };
const TITLE: Record<Drawer, string> = {
  browser: "Let the server draw the view",
  server: "Let this browser draw the view",
};

export function createDrawerSwitch(store: Store<State>, app: Pick<App, "drawBy">): HTMLElement {
  const button = element("button", { class: "drawer-switch dim", type: "button", "data-testid": "drawer" });
  button.addEventListener("click", () => app.drawBy(store.get().drawnBy === "browser" ? "server" : "browser"));
  store.watch(
    ({ drawnBy, whyNotBrowser }) => ({ drawnBy, whyNotBrowser }),
    ({ drawnBy, whyNotBrowser }) => {
      button.hidden = drawnBy === null;
      if (drawnBy === null) return;
      setText(button, TEXT[drawnBy]);
      const reason = drawnBy === "server" ? whyNotBrowser : "";
      button.disabled = reason !== "";
      button.title = reason || TITLE[drawnBy];
    },
    shallowEqual,
  );
  return button;
}
