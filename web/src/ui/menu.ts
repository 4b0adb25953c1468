// A button that opens a small sheet of choices above the page. A click outside of the sheet or Esc
// closes it. On a narrow screen, the sheet covers the page; there, a choice closes it too.
import { element } from "./element";
import type { IconName } from "./icons";
import { icon } from "./icons";
import { isNarrow } from "./narrow";

const GAP_PX = 6;
const EDGE_PX = 8;

export interface Menu {
  element: HTMLElement;
  button: HTMLButtonElement;
  sheet: HTMLElement;
  open(): void; // also focuses the first control of the sheet
  close(): void;
}

// The first word of the label is shown below the icon if the page is wide enough.
export function createMenu(label: string, picture: IconName, ...items: HTMLElement[]): Menu {
  return createWordedMenu({ label, picture, word: wordOf(label) }, ...items);
}

interface MenuLook {
  label: string;
  picture: IconName;
  word: string;
  title?: string; // tooltip (default: the label)
}

export function createWordedMenu({ label, picture, word, title = label }: MenuLook, ...items: HTMLElement[]): Menu {
  const button = element(
    "button",
    { class: "button plain worded", type: "button", "aria-label": label, title, "aria-expanded": "false" },
    icon(picture),
    element("span", { class: "word", "aria-hidden": "true" }, word),
  );
  const sheet = element("div", { class: "card menu-sheet", role: "group", "aria-label": label, popover: "manual" }, ...items);
  sheet.hidden = true;
  // Choices may be added later, and make the sheet larger.
  if (typeof ResizeObserver !== "undefined") new ResizeObserver(() => sheet.hidden || standBelow(button, sheet)).observe(sheet);
  const place = element("div", { class: "menu" }, button, sheet);

  const open = (value: boolean) => {
    if (value === !sheet.hidden) return;
    sheet.hidden = !value;
    if (value) {
      sheet.showPopover?.();
      standBelow(button, sheet);
    } else if (sheet.isConnected) {
      sheet.hidePopover?.();
    }
    button.setAttribute("aria-expanded", String(value));
    const listen = value ? addEventListener : removeEventListener;
    listen("pointerdown", closeOutside, true);
    listen("keydown", closeByKey, true);
    listen("resize", close);
  };
  const close = () => open(false);
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
  sheet.addEventListener("click", ({ target }) => {
    if (isNarrow() && target instanceof Element && target.closest("button")) close();
  });
  const openForKeys = () => {
    open(true);
    sheet.querySelector<HTMLElement>("input, select, button")?.focus();
  };
  return { element: place, button, sheet, open: openForKeys, close };
}

// Returns "Speed" for "Speed and steps".
function wordOf(label: string): string {
  return label.split(" ")[0]!;
}

// Keeps the sheet inside the window.
function standBelow(button: HTMLElement, sheet: HTMLElement): void {
  const at = button.getBoundingClientRect();
  const { innerWidth, innerHeight } = button.ownerDocument.defaultView ?? window;
  const { width, height } = sheet.getBoundingClientRect();
  const left = Math.max(EDGE_PX, Math.min(at.left, innerWidth - width - EDGE_PX));
  const isBelow = at.bottom + GAP_PX + height <= innerHeight - EDGE_PX;
  const top = isBelow ? at.bottom + GAP_PX : Math.max(EDGE_PX, at.top - GAP_PX - height);
  sheet.style.left = `${left}px`;
  sheet.style.top = `${top}px`;
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
      "data-key": key,
      "data-title": hint,
      title: hint,
      onclick,
    },
    picture ? icon(picture) : element("span", { class: "check", "aria-hidden": "true" }),
    element("span", {}, label),
    element("kbd", { "aria-hidden": "true" }, key),
  );
}
