// The tree of the world: every body with its links, joints and sensors, the transforms, and an
// inspector of the selected part.
import { shownPart } from "../../state/parts";
import { shallowEqual } from "../../state/Store";
import { element } from "../../ui/element";
import type { MountedPanel } from "../contract/Panel";
import { NodeInspector } from "./NodeInspector";
import type { WorldNode } from "./nodes";
import { bodiesOf, nodeId, nodeOf, partOf } from "./nodes";
import { Transforms } from "./Transforms";
import { WorldTree } from "./WorldTree";

type Ports = ConstructorParameters<typeof NodeInspector>[0];

const UPDATE_MS = 500;

export function mount(ports: Ports): MountedPanel {
  const { state, topics, robots } = ports;
  const filter = element("input", { type: "search", class: "log-filter", placeholder: "Name…", "aria-label": "Search the world by name", autocomplete: "off", spellcheck: "false" });
  const transforms = new Transforms();
  const inspector = new NodeInspector(ports, transforms);
  let chosen: WorldNode | null = null;
  let isOpen = false;
  let showsFrames = false;
  let endFrames = () => {};
  const open = (node: WorldNode) => {
    chosen = node;
    tree.select(nodeId(node));
    inspector.open(node);
  };
  const tree = new WorldTree(
    (node) => {
      open(node);
      const part = partOf(node);
      if (part) robots.inspect(part);
    },
    (open) => {
      if (open === showsFrames) return;
      showsFrames = open;
      follow();
    },
  );
  const showFrames = () => tree.showFrames(transforms.list(), state.get().time);
  // Transforms are read while they are shown.
  const follow = () => {
    endFrames();
    endFrames = () => {};
    if (!isOpen || !showsFrames) return;
    let isDirty = true;
    const end = transforms.open(topics, () => (isDirty = true));
    const timer = setInterval(() => {
      if (isDirty) showFrames();
      isDirty = false;
    }, UPDATE_MS);
    endFrames = () => {
      clearInterval(timer);
      end();
    };
  };
  const showBodies = () => tree.showBodies(bodiesOf(state.get().scene, filter.value), filter.value.trim() !== "");
  filter.addEventListener("input", showBodies);
  const whileOpen = () => {
    isOpen = true;
    follow();
    const ends = [
      // A selection in the view, in the list or in the edit panel is shown in the tree, too.
      state.watch(shownPart, (part) => {
        const node = nodeOf(state.get().scene, part);
        if (node && nodeId(node) !== (chosen && nodeId(chosen))) open(node);
        if (node || chosen?.kind === "transform") return;
        chosen = null;
        tree.select("");
        inspector.close();
      }, shallowEqual),
      state.watch(({ scene, simulation }) => ({ scene, simulation }), () => {
        showBodies();
        // In a new scene, the selected part may be missing or different, so it is searched again.
        const name = chosen && chosen.kind !== "transform" ? chosen.body.name : null;
        if (name === null) return;
        const body = state.get().scene?.bodies.find((each) => each.name === name);
        if (!body || !chosen || chosen.kind === "transform") {
          chosen = null;
          return inspector.close();
        }
        chosen = { ...chosen, body };
      }, shallowEqual),
    ];
    if (chosen) inspector.open(chosen);
    return () => {
      isOpen = false;
      follow();
      inspector.close();
      ends.forEach((end) => end());
    };
  };
  return { body: element("div", { class: "world-panel" }, tree.element, inspector.element), tools: [filter], whileOpen };
}
