// @vitest-environment jsdom
import { expect, test } from "vitest";
import { FIRST_EDITING } from "../../state/editing";
import { body, scene } from "../../scene/testScene";
import { testPorts } from "../contract/testPorts";
import { createPoseFields } from "./PoseFields";

const POSE = { body: "box", x: 1, y: 2, z: 0.5, roll: 0, pitch: 0, yaw: Math.PI / 2 };

function fields(pose = POSE) {
  const objects = scene({ bodies: [body("box", { isRobot: false }), body("a")] });
  const { ports, store } = testPorts({ editing: FIRST_EDITING, scene: objects, chosenPose: pose });
  const card = createPoseFields(ports);
  const input = (label: string) => {
    const found = [...card.querySelectorAll("label")].find(({ textContent }) => textContent === label)!;
    return card.querySelector<HTMLInputElement>(`#${found.htmlFor}`)!;
  };
  return { ports, store, card, input };
}

test("the pose is shown in metres and degrees, and hidden without a selection", () => {
  const { store, card, input } = fields();
  expect(input("x (m)").value).toBe("1");
  expect(input("Yaw (°)").value).toBe("90");
  store.set({ chosenPose: { ...POSE, x: 1.25 } });
  expect(input("x (m)").value).toBe("1.25");
  store.set({ chosenPose: null });
  expect(card.hidden).toBe(true);
});

test("a typed number changes one coordinate of the body, and no other", () => {
  const { ports, input } = fields();
  input("Roll (°)").value = "180";
  input("Roll (°)").dispatchEvent(new Event("input"));
  input("Roll (°)").dispatchEvent(new Event("change"));
  expect(ports.edits.pose).toHaveBeenCalledWith({ ...POSE, roll: Math.PI });
});

test("a robot is upright, so it has no fields for height, roll and pitch", () => {
  const { input } = fields({ ...POSE, body: "a" });
  const isShown = (label: string) => !input(label).closest<HTMLElement>(".field")!.hidden;
  expect(["x (m)", "y (m)", "Yaw (°)"].every(isShown)).toBe(true);
  expect(["z (m)", "Roll (°)", "Pitch (°)"].some(isShown)).toBe(false);
});

test("an invalid number is refused, and the field shows the pose again", () => {
  const { ports, input } = fields();
  input("x (m)").value = "";
  input("x (m)").dispatchEvent(new Event("input"));
  input("x (m)").dispatchEvent(new Event("change"));
  expect(ports.edits.pose).not.toHaveBeenCalled();
  expect(input("x (m)").value).toBe("1");
});
