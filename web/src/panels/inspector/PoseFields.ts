// The pose of the edited body as numbers that can be typed: metres, and degrees of roll, pitch and
// yaw.
import type { BodyPose } from "../../state/State";
import { allChosen } from "../../state/editing";
import type { Field } from "../../ui/fields";
import { numberField } from "../../ui/fields";
import { element, setText } from "../../ui/element";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "edits">;
type Name = Exclude<keyof BodyPose, "body">;

const DEGREES = 180 / Math.PI;
const FIELDS: readonly { name: Name; label: string; scale: number; digits: number }[] = [
  { name: "x", label: "x (m)", scale: 1, digits: 4 },
  { name: "y", label: "y (m)", scale: 1, digits: 4 },
  { name: "z", label: "z (m)", scale: 1, digits: 4 },
  { name: "roll", label: "Roll (°)", scale: DEGREES, digits: 3 },
  { name: "pitch", label: "Pitch (°)", scale: DEGREES, digits: 3 },
  { name: "yaw", label: "Yaw (°)", scale: DEGREES, digits: 3 },
];
const OF_ROBOTS: readonly Name[] = ["x", "y", "yaw"]; // robots stand upright on the floor

export function createPoseFields({ state, edits }: Ports): HTMLElement {
  const fields = new Map<Name, Field<number | null>>(
    FIELDS.map(({ name, label, scale, digits }) => [
      name,
      numberField(label, null, (value) => void set(name, value === null ? null : value / scale), { digits }),
    ]),
  );
  const title = element("h2", {});
  const kind = element("p", { class: "dim" });
  const card = element(
    "section",
    { class: "card pose-fields", "aria-label": "Pose" },
    element("div", { class: "card-head" }, title),
    kind,
    element("div", { class: "field-pair" }, ...elementsOf(["x", "y", "z"])),
    element("div", { class: "field-pair" }, ...elementsOf(["roll", "pitch", "yaw"])),
  );
  const set = async (name: Name, value: number | null) => {
    const { chosenPose } = state.get();
    if (!chosenPose) return;
    if (value !== null && Number.isFinite(value) && (await edits.pose({ ...chosenPose, [name]: value }))) return;
    show(state.get().chosenPose); // the body was not moved, so its pose is shown again
  };
  const show = (pose: BodyPose | null) => {
    for (const { name, scale } of FIELDS) fields.get(name)!.show(pose && pose[name] * scale);
  };

  function elementsOf(names: Name[]): HTMLElement[] {
    return names.map((name) => fields.get(name)!.element);
  }

  state.watch(
    ({ chosenPose }) => chosenPose,
    (pose) => {
      card.hidden = pose === null;
      show(pose);
      if (!pose) return;
      const body = state.get().scene?.bodies.find(({ name }) => name === pose.body);
      const isRobot = body !== undefined && (body.isRobot || body.isAvatar);
      for (const [name, field] of fields) field.element.hidden = isRobot && !OF_ROBOTS.includes(name);
      setText(title, pose.body);
      setText(kind, isRobot ? "Robots and avatars stand upright on the floor." : body?.isStatic ? "Static object" : "Object");
    },
  );
  state.watch(
    (all) => allChosen(all).length,
    (count) => (card.dataset.chosen = String(count)),
  );
  return card;
}
