// The command palette (Ctrl K): finds commands, panels, layouts, robots, objects, sensors and
// topics by text.
import type { App } from "../app/App";
import { element } from "../ui/element";
import type { Command } from "./commandList";
import { commandsOf, findCommands } from "./commandList";

export function createPalette(app: App): HTMLDialogElement {
  const list = element("ul", { class: "palette-list", id: "palette-list", role: "listbox", "aria-label": "Found" });
  const input = element("input", {
    type: "text",
    class: "palette-text",
    role: "combobox",
    "aria-label": "Command, robot, topic or panel",
    "aria-controls": "palette-list",
    "aria-expanded": "true",
    "aria-autocomplete": "list",
    placeholder: "command, robot, topic or panel…",
    autocomplete: "off",
    spellcheck: "false",
  });
  const none = element("p", { class: "hint" }, "Nothing matches. Change the text.");
  const dialog = element("dialog", { class: "card palette", "aria-label": "Commands" }, input, list, none);
  let known: Command[] = [];
  let found: Command[] = [];
  let at = 0;

  const mark = () => {
    [...list.children].forEach((item, i) => item.setAttribute("aria-selected", String(i === at)));
    const item = list.children[at];
    input.setAttribute("aria-activedescendant", item?.id ?? "");
    item?.scrollIntoView?.({ block: "nearest" });
  };
  const show = () => {
    found = findCommands(known, input.value);
    at = 0;
    none.hidden = found.length > 0;
    list.hidden = found.length === 0;
    list.replaceChildren(...found.map((command, i) => item(command, i)));
    mark();
  };
  const item = ({ group, label, key }: Command, i: number) =>
    element(
      "li",
      { role: "option", id: `palette-${i}`, class: "palette-item", onclick: () => run(i) },
      element("span", { class: "dim" }, group),
      element("span", { class: "palette-label" }, label),
      key !== undefined && element("kbd", { "aria-hidden": "true" }, key),
    );
  const run = (i: number) => {
    const command = found[i];
    dialog.close();
    command?.run();
  };
  input.addEventListener("input", show);
  dialog.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (step === 0 && event.key !== "Enter") return;
    event.preventDefault();
    if (step === 0) return run(at);
    at = (at + step + found.length) % Math.max(1, found.length);
    mark();
  });
  dialog.addEventListener("click", ({ target }) => target === dialog && dialog.close());
  dialog.addEventListener("close", () => app.openPalette(false));
  app.store.watch(
    ({ paletteOpen }) => paletteOpen,
    (isOpen) => {
      if (!isOpen && dialog.open) dialog.close();
      if (!isOpen || dialog.open) return;
      known = commandsOf(app);
      input.value = "";
      dialog.showModal();
      show();
      input.focus();
    },
  );
  return dialog;
}
