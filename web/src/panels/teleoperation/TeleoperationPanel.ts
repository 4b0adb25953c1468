// Drives a robot by hand: by keys while the pad has the focus, by finger or mouse on the pad, or by
// gamepad. The robot stops when the input ends or when the pad, the panel or the page loses the
// focus.
import { needsControl } from "../../state/people";
import type { State } from "../../state/State";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import { controlLine } from "../control/controlLine";
import { resumeLine } from "../control/resumeLine";
import { Driver } from "./Driver";
import type { Wish } from "./driving";
import { STILL, isStill } from "./driving";
import { DrivingPad } from "./DrivingPad";
import { GamepadReader } from "./GamepadReader";

type Ports = Pick<PanelPorts, "state" | "control">;

const NONE = "No robot can be driven. You can drive avatars, and robots that have a drive and no running behaviour. To add a robot that you can drive: press Edit, choose a model, leave Behaviour at None, press Add, then Resume.";
const HINT = "Press the pad, then hold W A S D or the arrow keys (Q and E: sideways). Or drag on the pad. Or use a gamepad.";
const MAX_LISTED = 200;

export function mount({ state, control }: Ports): MountedPanel {
  const choice = element("select", { "aria-label": "Robot to drive" });
  const note = element("p", { class: "dim teleoperation-note", role: "status" });
  const moving = element("p", { class: "number teleoperation-speed" });
  const { line, follow } = controlLine(state, control);
  const linear = speedSlider("Speed", "m/s", 0.1, 3, 0.5);
  const angular = speedSlider("Turn rate", "rad/s", 0.1, 3, 1);
  const { line: paused, follow: followPhase } = resumeLine(state, control, "Resume it to drive.");
  const place = element("div", { class: "pad-place" });
  const speeds = element("div", { class: "teleoperation-speeds" }, linear.element, angular.element);
  const wishes = { pad: STILL, gamepad: STILL };
  let robot: string | null = null;
  // Whether the gamepad's stick is ignored until it returns to its centre. It is ignored if it was
  // pushed when the robot was stopped, because the browser reports the stick's last position while
  // the page is hidden.
  let isStickIgnored = false;

  const driver = new Driver(
    (name, drive) => {
      const { simulation } = state.get();
      return simulation === null ? Promise.resolve() : control.drive(simulation, name, drive);
    },
    (sentence) => {
      setText(note, sentence);
      show(STILL);
    },
  );
  const pad = new DrivingPad((wish) => {
    wishes.pad = wish;
    update();
  });
  place.append(pad.element);
  const show = (wish: Wish) => {
    pad.show(wish);
    const isMoving = !isStill(wish) && robot !== null;
    setText(moving, isMoving && runs() ? `${robot}: ${(wish.ahead * linear.value()).toFixed(2)} m/s, ${(wish.turn * angular.value()).toFixed(2)} rad/s` : "Stopped");
  };
  const runs = () => state.get().status?.phase === "running";
  const mayDrive = () => robot !== null && needsControl(state.get().people) === "";
  const update = () => {
    const wish = isStill(wishes.pad) ? wishes.gamepad : wishes.pad;
    if (!mayDrive() && !isStill(wish)) return;
    show(wish);
    if (!isStill(wish)) control.setDriven(robot);
    driver.move(wish, { linear: linear.value(), angular: angular.value() });
  };
  const letGo = () => {
    isStickIgnored ||= !isStill(wishes.gamepad);
    wishes.gamepad = STILL;
    pad.letGo();
    update();
  };
  for (const slider of [linear, angular]) slider.input.addEventListener("input", () => driver.isDriving && update());

  const gamepad = new GamepadReader({
    onWish: (wish) => {
      if (isStill(wish)) isStickIgnored = false;
      if (isStickIgnored || (isStill(wish) && isStill(wishes.gamepad))) return;
      wishes.gamepad = wish;
      update();
    },
    onConnected: (name) => setText(note, `Gamepad connected: ${name}. The left stick drives and turns the robot, the right stick moves it sideways.`),
    onPulledOut: () => setText(note, "The gamepad was disconnected. The robot stops."),
  });

  const choose = (name: string | null) => {
    if (name === robot) return;
    letGo();
    control.setDriven(null);
    robot = name;
    driver.setRobot(name);
    choice.value = name ?? "";
    show(STILL);
  };
  choice.addEventListener("change", () => choose(choice.value));
  const offer = (names: readonly string[]) => {
    choice.replaceChildren(...names.map((name) => new Option(name, name)));
    const { selection } = state.get();
    const isThere = (name: string | null): name is string => name !== null && names.includes(name);
    choose(isThere(robot) ? robot : isThere(selection) ? selection : (names[0] ?? null));
    choice.value = robot ?? "";
    const isEmpty = names.length === 0;
    for (const hidden of [choice, place, speeds, moving]) hidden.hidden = isEmpty;
    tellHow();
  };
  const tellHow = () => setText(note, robot === null ? NONE : HINT);
  const whileOpen = () => {
    const ends = [
      follow(),
      gamepad.open(),
      whenPageIsLeft(letGo),
      letGo,
      () => control.setDriven(null),
      state.watch(drivable, offer, shallowEqual),
      state.watch(
        ({ selection }) => selection,
        (selection) => selection !== null && drivable(state.get()).includes(selection) && choose(selection),
      ),
      followPhase(),
      state.watch(
        ({ people }) => needsControl(people) !== "",
        (isMissing) => {
          if (!isMissing) return;
          letGo();
          control.setDriven(null);
        },
      ),
    ];
    show(STILL);
    return () => ends.forEach((end) => end());
  };
  const body = element("div", { class: "teleoperation-body" }, line, paused, place, speeds, moving, note);
  return { body, tools: [choice], whileOpen };
}

// Calls `letGo` when the window loses the focus, or is hidden or closed. Returns a function that
// removes the listeners.
function whenPageIsLeft(letGo: () => void): () => void {
  const hide = () => document.visibilityState === "hidden" && letGo();
  document.addEventListener("visibilitychange", hide);
  for (const event of ["blur", "pagehide"]) window.addEventListener(event, letGo);
  return () => {
    document.removeEventListener("visibilitychange", hide);
    for (const event of ["blur", "pagehide"]) window.removeEventListener(event, letGo);
  };
}

// Returns the robots with a drive and without a running behaviour, then the avatars.
function drivable({ scene, status }: State): readonly string[] {
  const free = new Set(
    (status?.robots ?? []).filter(({ behaviour, agentPhase }) => behaviour === "" || agentPhase === "finished").map(({ name }) => name),
  );
  const bodies = (scene?.bodies ?? []).filter(({ name, isAvatar, isRobot, hasDrive }) => isAvatar || (isRobot && hasDrive && free.has(name)));
  return [...bodies.filter(({ isAvatar }) => !isAvatar), ...bodies.filter(({ isAvatar }) => isAvatar)]
    .slice(0, MAX_LISTED)
    .map(({ name }) => name);
}

function speedSlider(label: string, unit: string, least: number, most: number, first: number) {
  const input = element("input", { type: "range", min: String(least), max: String(most), step: "0.05", value: String(first) });
  const text = element("span", { class: "number" }, `${first.toFixed(2)} ${unit}`);
  input.addEventListener("input", () => setText(text, `${Number(input.value).toFixed(2)} ${unit}`));
  return { input, value: () => Number(input.value), element: element("label", {}, label, input, text) };
}
