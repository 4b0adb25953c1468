// The small curve beside a value: a press draws it against simulated time.
import { element } from "../../ui/element";
import { icon } from "../../ui/icons";

export function plotButton(label: string, onclick: () => void): HTMLElement {
  return element(
    "button",
    { class: "button plain tiny", type: "button", "aria-label": label, title: label, onclick },
    icon("plot"),
  );
}
