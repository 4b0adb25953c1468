// The part of the form that publishes a simulation to ROS 2 nodes.
import type { App } from "../app/App";
import { PLAIN_ROS2 } from "../api/ros2";
import type { Ros2SetUp, Ros2Support } from "../api/ros2";
import type { SetUp } from "../state/setUp";
import { element, setText } from "../ui/element";
import { checkField, choiceField } from "../ui/fields";

export interface Ros2Part {
  element: HTMLElement;
  show(setUp: SetUp): void;
  refuse(sentence: string): void;
}

export function createRos2Part(app: App): Ros2Part {
  const change = (patch: Partial<Ros2SetUp>) => {
    const ros2 = app.store.get().setUp?.scenario.ros2;
    if (ros2) app.setUp.change({ ros2: { ...ros2, ...patch } });
  };
  const isOn = checkField("Publish to ROS 2", (value) => app.setUp.change({ ros2: value ? PLAIN_ROS2 : null }));
  const command = choiceField("Type of cmd_vel", (cmd_vel) => change({ cmd_vel }));
  command.offer([
    { value: "", label: "Twist" },
    { value: "twist_stamped", label: "TwistStamped (Nav2 of Kilted and later)" },
  ]);
  const distro = choiceField("ROS 2 distribution of the other nodes", (name) => change({ distro: name }));
  distro.offer([
    { value: "", label: "Jazzy" },
    { value: "humble", label: "Humble" },
    { value: "kilted", label: "Kilted" },
    { value: "lyrical", label: "Lyrical" },
  ]);
  const hint = element("p", { class: "hint" });
  const part = element("div", { class: "set-up-part" }, element("h2", {}, "ROS 2"), isOn.element, command.element, distro.element, hint);
  return {
    element: part,
    show: ({ scenario: { ros2 }, ros2: support }) => {
      isOn.element.hidden = !support?.isAvailable && ros2 === null;
      isOn.show(ros2 !== null);
      command.element.hidden = distro.element.hidden = ros2 === null;
      command.show(ros2?.cmd_vel === "twist" ? "" : (ros2?.cmd_vel ?? ""));
      distro.show(ros2?.distro === "jazzy" ? "" : (ros2?.distro ?? ""));
      setText(hint, hintFor(support));
    },
    refuse: isOn.refuse,
  };
}

function hintFor(support: Ros2Support | null): string {
  if (support === null) return "";
  if (!support.isAvailable) return `Not available: ${support.reason || "this server does not publish to ROS 2"}.`;
  if (support.published) return `${support.published} is published to ROS 2 now. A ROS 2 domain has only one /clock, so remove that simulation first.`;
  return `ROS 2 nodes can read the robots' topics and drive robots without a behaviour (${support.reach}).`;
}
