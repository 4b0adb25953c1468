// Notices that disappear after a while, such as refusals of the server and deaths of behaviours.
import type { App } from "../app/App";
import type { NoticeAction } from "../state/State";
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
      const items = notices.map(({ id, kind, sentence, action }) =>
        element(
          "div",
          { class: `card notice ${kind}`, role: kind === "error" ? "alert" : "note" },
          element("p", {}, sentence),
          action !== undefined && actionButton(app, id, action),
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

function actionButton(app: App, id: number, { label, run }: NoticeAction): HTMLElement {
  const act = () => {
    app.dismiss(id);
    run();
  };
  return element("button", { class: "button small", type: "button", onclick: act }, label);
}
