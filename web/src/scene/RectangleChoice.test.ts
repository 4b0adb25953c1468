// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import { RectangleChoice } from "./RectangleChoice";

function choice() {
  const host = document.createElement("div");
  host.setPointerCapture = () => {};
  const canvas = document.createElement("canvas");
  host.append(canvas);
  const events = { onAdd: vi.fn(), onChoose: vi.fn() };
  const rectangle = new RectangleChoice(host, events);
  rectangle.isOn = true;
  const beyond = vi.fn(); // the listener of the view's own gestures
  canvas.addEventListener("pointerdown", beyond);
  const send = (type: string, x: number, y: number, shiftKey = true) => {
    const event = new MouseEvent(type, { clientX: x, clientY: y, button: 0, shiftKey, bubbles: true });
    Object.defineProperty(event, "isPrimary", { value: true });
    canvas.dispatchEvent(event);
  };
  return { host, events, rectangle, beyond, send };
}

test("Shift and a click add the body there to the selection", () => {
  const { events, beyond, send } = choice();
  send("pointerdown", 10, 20);
  send("pointerup", 11, 21);
  expect(events.onAdd).toHaveBeenCalledWith({ x: 10, y: 20 });
  expect(events.onChoose).not.toHaveBeenCalled();
  expect(beyond).not.toHaveBeenCalled();
});

test("Shift and a drag select the bodies in the rectangle, which is shown", () => {
  const { host, events, send } = choice();
  const mark = host.querySelector<HTMLElement>(".choice-rectangle")!;
  send("pointerdown", 50, 60);
  send("pointermove", 20, 20);
  expect(mark.hidden).toBe(false);
  expect([mark.style.left, mark.style.width, mark.style.height]).toEqual(["20px", "30px", "40px"]);
  send("pointerup", 20, 20);
  expect(mark.hidden).toBe(true);
  const isInside = events.onChoose.mock.calls[0]![0] as (at: { x: number; y: number }) => boolean;
  expect(isInside({ x: 30, y: 40 })).toBe(true);
  expect(isInside({ x: 60, y: 40 })).toBe(false);
});

test("without Shift or Ctrl, and outside of editing, clicks and drags select nothing", () => {
  const { events, rectangle, beyond, send } = choice();
  send("pointerdown", 1, 1, false);
  rectangle.isOn = false;
  send("pointerdown", 1, 1);
  send("pointerup", 1, 1);
  expect(beyond).toHaveBeenCalledTimes(2);
  expect(events.onAdd).not.toHaveBeenCalled();
});
