// The button of an inspector that opens the panel of joints.
import type { SceneBody } from "../../api/scene";
import { element } from "../../ui/element";
import { icon } from "../../ui/icons";
import type { PanelPorts } from "../contract/ports";

export function jointsButton({ control }: Pick<PanelPorts, "control">): HTMLElement {
  return element(
    "button",
    { class: "button small", type: "button", title: "Show the joints with their limits and sliders", onclick: () => control.showJoints() },
    icon("joints"),
    "Move joints",
  );
}

// Whether the body has joints that the panel shows. The scene lists only joints that can move, so
// static bodies have none.
export function hasJoints(body: SceneBody | undefined): boolean {
  return body !== undefined && body.joints.length > 0;
}
