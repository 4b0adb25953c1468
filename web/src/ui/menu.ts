// A button that opens a small sheet of choices. A press elsewhere or Esc closes it.
import { element } from "./element";
import type { IconName } from "./icons";
import { icon } from "./icons";

export interface Menu {
  element: HTMLElement;
  button: HTMLButtonElement;
  sheet: HTMLElement;
}

export function createMenu(label: string, picture: IconName, ...items: HTMLElement[]): Menu {
  const button = element(
    "button",
    { class: "button plain", type: "button", "aria-label": label, title: label, "aria-expanded": "false" },
    icon(picture),
  );
  const sheet = element("div", { class: "card menu-sheet", role: "group", "aria-label": label }, ...items);
  sheet.hidden = true;
  const place = element("div", { class: "menu" }, button, sheet);

  const open = (value: boolean) => {
    sheet.hidden = !value;
    button.setAttribute("aria-expanded", String(value));
    const listen = value ? addEventListener : removeEventListener;
    listen("pointerdown", closeOutside, true);
    listen("keydown", closeByKey, true);
  };
  const closeOutside = (event: Event) => {
    if (!(event.target instanceof Node && place.contains(event.target))) open(false);
  };
  const closeByKey = (event: KeyboardEvent) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    const hadFocus = sheet.contains(document.activeElement);
    open(false);
    if (hadFocus) button.focus();
  };
  button.addEventListener("click", () => open(sheet.hidden));
  return { element: place, button, sheet };
}

export function menuItem(
  label: string,
  key: string,
  hint: string,
  onclick: () => void,
  picture: IconName | null = null,
): HTMLButtonElement {
  return element(
    "button",
    {
      class: "menu-item",
      type: "button",
      "aria-keyshortcuts": key,
      title: hint,
      onclick,
    },
    picture ? icon(picture) : element("span", { class: "check", "aria-hidden": "true" }),
    element("span", {}, label),
    element("kbd", { "aria-hidden": "true" }, key),
  );
}
