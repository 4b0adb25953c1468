// The inspector as a panel: the selected robot, or the selected object, link, joint or sensor. If
// nothing is selected, it explains how to select something.
import type { WorldNode } from "../world/nodes";
import { nodeId, nodeOf } from "../world/nodes";
import { NodeInspector } from "../world/NodeInspector";
import { Transforms } from "../world/Transforms";
import { shownPart } from "../../state/parts";
import { shallowEqual } from "../../state/Store";
import { element } from "../../ui/element";
import type { MountedPanel } from "../contract/Panel";
import { createInspector } from "./Inspector";
import { createPoseFields } from "./PoseFields";

type Ports = Parameters<typeof createInspector>[0] & Parameters<typeof createPoseFields>[0] & ConstructorParameters<typeof NodeInspector>[0];

export function mount(ports: Ports): MountedPanel {
  const { state } = ports;
  const hint = element("p", { class: "hint" }, "Select a robot or an object in the view, in the list or in the panel World to see its pose, its shapes and what its sensors read.");
  const part = new NodeInspector(ports, new Transforms(), "Selected object");
  part.element.classList.add("card");
  state.watch(
    (all) => (all.setUp === null ? shownPart(all) : null),
    (shown) => (hint.hidden = shown !== null),
    shallowEqual,
  );
  const whileOpen = () => {
    let shownId = "";
    const end = state.watch(
      (all) => ({ part: all.setUp === null ? shownPart(all) : null, scene: all.scene }),
      ({ part: shown, scene }) => {
        const node = objectOf(nodeOf(scene, shown));
        const id = node === null ? "" : `${scene!.layoutVersion} ${nodeId(node)}`;
        part.element.hidden = node === null;
        if (id === shownId) return;
        shownId = id;
        if (node) part.open(node);
        else part.close();
      },
      (a, b) => a.scene === b.scene && shallowEqual(a.part, b.part),
    );
    return () => {
      end();
      part.close();
    };
  };
  return { body: element("div", { class: "inspector-body" }, hint, createPoseFields(ports), part.element, createInspector(ports)), whileOpen };
}

// Returns the node that `part` shows. A robot or an avatar itself is not shown there but by
// createInspector(), so the result is null.
function objectOf(node: WorldNode | null): WorldNode | null {
  return node?.kind === "body" && (node.body.isRobot || node.body.isAvatar) ? null : node;
}
