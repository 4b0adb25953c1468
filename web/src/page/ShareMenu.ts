// The menu for saving an image, a video or a link.
import type { App } from "../app/App";
import { createMenu, menuItem } from "../ui/menu";

export function createShareMenu(app: App): HTMLElement {
  const film = menuItem(
    "Record video",
    "M",
    "Record a video of the view (WebM); press again to stop",
    () => app.film(),
    "film",
  );
  const menu = createMenu(
    "Share",
    "share",
    menuItem("Copy link", "L", "Copy an address that shows this view again", () => app.copyLink(), "link"),
    menuItem("Save image", "X", "Save the current view as PNG", () => void app.savePicture(), "camera"),
    film,
  );
  // The first button copies a link, which also works without a view. The other buttons need the
  // view.
  const ofTheView = [...menu.sheet.querySelectorAll("button")].slice(1);
  app.store.watch(
    ({ view }) => view === "open",
    (isOpen) => ofTheView.forEach((item) => (item.disabled = !isOpen)),
  );
  app.store.watch(
    ({ filming }) => filming,
    (filming) => {
      film.setAttribute("aria-pressed", String(filming));
      menu.button.classList.toggle("filming", filming);
      menu.button.title = filming ? "Share (recording video)" : "Share";
    },
  );
  return menu.element;
}
