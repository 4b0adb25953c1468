// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { Drive } from "../api/SimulationApi";
import { AvatarSteering, STANDING, driveOf } from "./AvatarSteering";

function press(steering: AvatarSteering, key: string): void {
  steering.keyDown(new KeyboardEvent("keydown", { key }));
}

test("W drives forward, A turns left, Shift is faster, opposites cancel", () => {
  expect(driveOf(new Set(["w"]))).toEqual({ ...STANDING, linear_m_s: 0.8 });
  expect(driveOf(new Set(["arrowup", "shift"]))).toEqual({ ...STANDING, linear_m_s: 1.6 });
  expect(driveOf(new Set(["a"]))).toEqual({ ...STANDING, angular_rad_s: 1.4 });
  expect(driveOf(new Set(["w", "s", "d"]))).toEqual({ ...STANDING, angular_rad_s: -1.4 });
  expect(driveOf(new Set(["q"]))).toEqual({ ...STANDING, lateral_m_s: 0.8 });
});

test("releasing the keys sends one stop", async () => {
  const sent: Drive[] = [];
  const steering = new AvatarSteering(
    () => "me",
    async (_, drive) => void sent.push(drive),
  );
  press(steering, "w");
  await vi.waitFor(() => expect(sent).toHaveLength(1));
  steering.keyUp("w");
  await vi.waitFor(() => expect(sent).toHaveLength(2));
  steering.keyUp("w");
  expect(sent).toEqual([{ ...STANDING, linear_m_s: 0.8 }, STANDING]);
});

test("during a call only the newest command is kept", async () => {
  const sent: Drive[] = [];
  let answer = () => {};
  const steering = new AvatarSteering(
    () => "me",
    (_, drive) => {
      sent.push(drive);
      return new Promise((resolve) => (answer = resolve));
    },
  );
  press(steering, "w");
  press(steering, "a");
  steering.keyUp("w");
  steering.keyUp("a");
  expect(sent).toHaveLength(1);
  answer();
  await vi.waitFor(() => expect(sent).toHaveLength(2));
  expect(sent[1]).toEqual(STANDING);
});

test("without an avatar the keys have no effect", () => {
  const send = vi.fn();
  const steering = new AvatarSteering(() => null, send);
  press(steering, "w");
  expect(send).not.toHaveBeenCalled();
});

test("with single keys turned off, only the arrow keys drive", async () => {
  const sent: Drive[] = [];
  const steering = new AvatarSteering(
    () => "me",
    async (_, drive) => void sent.push(drive),
    () => false,
  );
  press(steering, "w");
  press(steering, "ArrowUp");
  await vi.waitFor(() => expect(sent).toHaveLength(1));
  expect(sent).toEqual([{ ...STANDING, linear_m_s: 0.8 }]);
  steering.keyUp("ArrowUp");
});
