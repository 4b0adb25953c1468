// A small button with an icon and no word, as in the head of a panel.
import { element } from "./element";
import type { IconName } from "./icons";
import { icon } from "./icons";

export function smallButton(picture: IconName, label: string, onclick: () => void): HTMLButtonElement {
  return element(
    "button",
    { class: "button plain small", type: "button", "aria-label": label, title: label, onclick },
    icon(picture),
  );
}
