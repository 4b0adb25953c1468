// A button with a curve symbol beside a value. A click plots the value against simulated time.
import { element } from "../../ui/element";
import { icon } from "../../ui/icons";

export function plotButton(label: string, onclick: () => void): HTMLElement {
  return element(
    "button",
    { class: "button plain tiny", type: "button", "aria-label": label, title: label, onclick },
    icon("plot"),
  );
}
