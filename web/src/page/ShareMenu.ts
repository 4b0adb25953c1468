// The menu of what a person takes away: a picture, a video, a link.
import type { App } from "../app/App";
import { createMenu, menuItem } from "../ui/menu";

export function createShareMenu(app: App): HTMLElement {
  const film = menuItem(
    "Film the view",
    "M",
    "A video until the next press, as WebM",
    () => app.film(),
    "film",
  );
  const menu = createMenu(
    "Share",
    "share",
    menuItem("Copy link", "L", "An address that shows this again", () => app.copyLink(), "link"),
    menuItem("Save picture", "X", "What is seen now, as PNG", () => void app.savePicture(), "camera"),
    film,
  );
  // Without a picture there is still a link.
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
      menu.button.title = filming ? "Share (filming)" : "Share";
    },
  );
  return menu.element;
}
