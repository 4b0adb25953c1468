// The inspector as a panel. Without a selection, it explains how to select a robot.
import { element } from "../../ui/element";
import type { MountedPanel } from "../contract/Panel";
import { createInspector } from "./Inspector";
import { createPoseFields } from "./PoseFields";

type Ports = Parameters<typeof createInspector>[0] & Parameters<typeof createPoseFields>[0];

export function mount(ports: Ports): MountedPanel {
  const hint = element("p", { class: "hint" }, "Select a robot in the view or in the list to see what it does and what its sensors read.");
  ports.state.watch(
    ({ selection, setUp, chosenPose }) => (selection !== null || chosenPose !== null) && setUp === null,
    (isSelected) => (hint.hidden = isSelected),
  );
  return { body: element("div", { class: "inspector-body" }, hint, createPoseFields(ports), createInspector(ports)) };
}
