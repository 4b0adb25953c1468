// Finds what the user clicks on. Places are in CSS pixels of the page.
import type { Camera, Vector3 } from "three";
import { Raycaster, Vector2 } from "three";

// A position on the page, in CSS pixels.
export interface ScreenPlace {
  x: number;
  y: number;
}

// A click within this distance selects a robot, because it is difficult to click on small robots
// exactly.
const NEAREST_PX = 18;
const DRAG_PX = 5;

// Reports clicks, but not the end of a drag.
export function onClick(canvas: HTMLCanvasElement, listener: (place: ScreenPlace) => void): void {
  let down: ScreenPlace | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    down = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
  });
  canvas.addEventListener("pointerup", ({ clientX: x, clientY: y }) => {
    if (down && Math.hypot(x - down.x, y - down.y) <= DRAG_PX) listener({ x, y });
    down = null;
  });
}

// The ray from the camera through a place in the image that fills `frame`.
export function rayThrough(place: ScreenPlace, frame: DOMRect, camera: Camera): Raycaster {
  const x = (2 * (place.x - frame.left)) / frame.width - 1;
  const y = 1 - (2 * (place.y - frame.top)) / frame.height;
  const raycaster = new Raycaster();
  raycaster.setFromCamera(new Vector2(x, y), camera);
  return raycaster;
}

// The place at which a point of the world is drawn; null if it is outside the image.
export function screenPlaceOf(point: Vector3, camera: Camera, frame: DOMRect): ScreenPlace | null {
  const { x, y, z } = point.clone().project(camera);
  if (z > 1 || Math.abs(x) > 1 || Math.abs(y) > 1) return null;
  return { x: frame.left + ((x + 1) / 2) * frame.width, y: frame.top + ((1 - y) / 2) * frame.height };
}

// Returns the robot that is drawn nearest to the place, if it is near enough.
export function nearest(
  place: ScreenPlace,
  robots: { name: string; at: ScreenPlace | null }[],
): string | null {
  let best: string | null = null;
  let bestPx = NEAREST_PX;
  for (const { name, at } of robots) {
    const px = at ? Math.hypot(at.x - place.x, at.y - place.y) : Infinity;
    if (px > bestPx) continue;
    best = name;
    bestPx = px;
  }
  return best;
}
