// The menu for comparing the replayed recording with another recording. The menu shows the first
// difference between the two recordings.
import type { App } from "../app/App";
import type { RecordingLine } from "../recordings/recordings";
import { resultOf } from "../state/comparison";
import { shallowEqual } from "../state/Store";
import { element, setText } from "../ui/element";
import { formatDate } from "../ui/format";
import { createMenu } from "../ui/menu";

export function createCompareMenu(app: App): HTMLElement {
  const list = element("ul", { class: "compare-list", "aria-label": "Recordings to compare with" });
  const verdict = element("p", { class: "compare-verdict", role: "status" });
  const goTo = element("button", { class: "button small", type: "button" }, "Go to the first difference");
  const end = element("button", { class: "button small", type: "button", onclick: () => app.compare.end() }, "Stop comparing");
  const menu = createMenu("Compare with…", "layers", verdict, element("div", { class: "compare-actions" }, goTo, end), list);
  goTo.addEventListener("click", () => {
    const time = app.store.get().comparison?.difference?.time;
    if (time == null) return;
    menu.close();
    void app.past.lookAt(time);
  });
  menu.button.addEventListener("click", () => void fill(app, list, menu.close));
  app.menus.set("compare", () => {
    menu.open();
    void fill(app, list, menu.close);
  });
  app.store.watch(
    ({ replay, abilities }) => replay !== null && (abilities.recordings || abilities.recording !== ""),
    (isPossible) => (menu.element.hidden = !isPossible),
  );
  app.store.watch(
    ({ comparison }) => ({ comparison }),
    ({ comparison }) => {
      menu.button.setAttribute("aria-pressed", String(comparison !== null));
      const { sentence = "", details = "" } = comparison ? resultOf(comparison) : {};
      setText(verdict, comparison ? `${sentence}\n${details}`.trim() : "Choose a recording. Its robots are shown as ghosts, and its curves are dashed.");
      end.hidden = comparison === null;
      goTo.hidden = comparison?.difference?.time == null;
    },
    shallowEqual,
  );
  return menu.element;
}

async function fill(app: App, list: HTMLElement, close: () => void): Promise<void> {
  const say = (text: string) => list.replaceChildren(element("li", { class: "dim" }, text));
  try {
    const lines = await app.compare.choices();
    if (lines.length === 0) return say("This server has no other recording. To serve all recordings of a folder: gsv serve --recordings FOLDER");
    list.replaceChildren(...lines.map((line) => choice(app, line, close)));
  } catch (error) {
    say((error as Error).message);
  }
}

function choice(app: App, { name, world, modified, verdict }: RecordingLine, close: () => void): HTMLElement {
  const about = [world, verdict, formatDate(modified)].filter((part) => part !== "").join(" · ");
  const choose = () => {
    close();
    void app.compare.with(name);
  };
  return element(
    "li",
    {},
    element("button", { class: "menu-item", type: "button", onclick: choose }, element("span", {}, name), element("span", { class: "dim" }, about)),
  );
}
