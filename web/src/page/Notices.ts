// Notices that disappear after a while, such as refusals of the server and deaths of behaviours.
import type { App } from "../app/App";
import { element } from "../ui/element";
import { icon } from "../ui/icons";

export function createNotices(app: App): HTMLElement {
  const list = element("div", {
    class: "notices",
    role: "log",
    "aria-live": "polite",
    "aria-label": "Messages",
  });
  app.store.watch(
    ({ notices }) => notices,
    (notices) => {
      const items = notices.map(({ id, kind, sentence }) =>
        element(
          "div",
          { class: `card notice ${kind}`, role: kind === "error" ? "alert" : "note" },
          element("p", {}, sentence),
          element(
            "button",
            {
              class: "button plain small",
              type: "button",
              "aria-label": "Dismiss",
              onclick: () => app.dismiss(id),
            },
            icon("close"),
          ),
        ),
      );
      list.replaceChildren(...items);
    },
  );
  return list;
}
