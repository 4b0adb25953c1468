// The menu of layouts: presets, saved layouts, and files.
import type { App } from "../app/App";
import { element } from "../ui/element";
import { icon } from "../ui/icons";
import { createMenu } from "../ui/menu";
import { PRESETS } from "../workspace/presets";

export function createLayoutMenu(app: App): HTMLElement {
  const { layouts } = app;
  const saved = element("div", { class: "layout-list", role: "group", "aria-label": "Saved layouts" });
  const name = element("input", { type: "text", maxlength: "60", "aria-label": "Name of the layout", placeholder: "name…", autocomplete: "off" });
  const form = element(
    "form",
    { class: "layout-save" },
    name,
    element("button", { class: "button small", type: "submit", title: "Save the present layout in this browser" }, "Save"),
  );
  const file = element("input", { type: "file", accept: ".json,application/json", class: "unseen-file", "aria-label": "Layout file", tabindex: "-1" });
  const menu = createMenu(
    "Layout",
    "layout",
    ...PRESETS.map((preset) => line(preset.title, preset.hint, () => done(() => layouts.showPreset(preset)))),
    saved,
    form,
    line("Export layout", "Save the present layout as a file", () => done(() => layouts.exportFile())),
    line("Import layout", "Read a layout from a file", () => file.click()),
    file,
  );
  const done = (act: () => void) => {
    menu.close();
    act();
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    layouts.save(name.value);
    name.value = "";
  });
  file.addEventListener("change", () => {
    const chosen = file.files?.[0];
    file.value = "";
    menu.close();
    if (chosen) void layouts.importFile(chosen);
  });
  app.store.watch(
    ({ layouts: list }) => list,
    (list) => {
      saved.hidden = list.length === 0;
      saved.replaceChildren(
        ...list.map((each) =>
          element(
            "div",
            { class: "layout-line" },
            line(each.name, `Show the layout ${each.name}`, () => done(() => layouts.showSaved(each))),
            element(
              "button",
              {
                class: "button plain small",
                type: "button",
                "aria-label": `Delete layout ${each.name}`,
                title: `Delete layout ${each.name}`,
                onclick: () => layouts.remove(each.name),
              },
              icon("close"),
            ),
          ),
        ),
      );
    },
  );
  app.menus.set("layout", menu.open);
  return menu.element;
}

function line(label: string, hint: string, onclick: () => void): HTMLButtonElement {
  return element("button", { class: "button plain menu-line", type: "button", title: hint, onclick }, label);
}
