// A button with an icon and a tooltip. If the page is wide enough, there is a word below the icon.
import { element } from "./element";
import type { IconName } from "./icons";
import { icon } from "./icons";

export interface IconButton {
  picture: IconName;
  label: string; // accessible name of the button
  word?: string; // text below the icon (default: the label)
  title?: string; // tooltip: the effect of the button (default: the label)
  key?: string; // single key of the command, shown in the tooltip
  onclick(): void;
}

export function iconButton({ picture, label, word = label, title = label, key = "", onclick }: IconButton): HTMLButtonElement {
  const shortcut = key !== "" && { "aria-keyshortcuts": key, "data-key": key, "data-title": title };
  return element(
    "button",
    {
      class: "button plain worded",
      type: "button",
      "aria-label": label,
      ...shortcut,
      title: key === "" ? title : `${title} (${key})`,
      onclick,
    },
    icon(picture),
    element("span", { class: "word", "aria-hidden": "true" }, word),
  );
}
