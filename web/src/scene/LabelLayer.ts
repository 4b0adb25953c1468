// Names above the robots: text of the page, not of the picture, so that it stays sharp and can be
// read by a screen reader. Of a crowd only the nearest are named.
import type { Camera } from "three";
import { Vector3 } from "three";

const MOST_LABELS = 40;
const TEXT_PX = 11.5; // as style/panels.css has it

export interface Labelled {
  name: string;
  position: Vector3; // in the world
}

export class LabelLayer {
  readonly element = document.createElement("div");
  private readonly labels = new Map<string, HTMLElement>();

  constructor(private readonly onPick: (name: string) => void) {
    this.element.className = "labels";
  }

  place(camera: Camera, width: number, height: number, robots: Labelled[], selection: string | null): void {
    const shown = visible(camera, robots).slice(0, MOST_LABELS);
    const names = new Set(shown.map(({ robot }) => robot.name));
    for (const [name, label] of [...this.labels]) {
      if (names.has(name)) continue;
      label.remove();
      this.labels.delete(name);
    }
    for (const { robot, onScreen } of shown) {
      const label = this.labelOf(robot.name);
      const x = ((onScreen.x + 1) / 2) * width;
      const y = ((1 - onScreen.y) / 2) * height;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -100%)`;
      label.classList.toggle("selected", robot.name === selection);
    }
  }

  // The labels as they are placed now, on a picture of the view whose width is `width` on the page.
  paint(context: CanvasRenderingContext2D, width: number): void {
    const scale = context.canvas.width / width;
    context.save();
    context.scale(scale, scale);
    context.font = getComputedStyle(this.element).font.replace(/\d+(\.\d+)?px/, `${TEXT_PX}px`);
    context.textBaseline = "middle";
    const frame = this.element.getBoundingClientRect();
    for (const label of this.labels.values()) {
      const box = label.getBoundingClientRect();
      const [x, y] = [box.left - frame.left, box.top - frame.top];
      context.fillStyle = getComputedStyle(label).backgroundColor;
      context.beginPath();
      context.roundRect(x, y, box.width, box.height, 5);
      context.fill();
      context.fillStyle = getComputedStyle(label).color;
      context.fillText(label.textContent ?? "", x + 6, y + box.height / 2);
    }
    context.restore();
  }

  private labelOf(name: string): HTMLElement {
    let label = this.labels.get(name);
    if (!label) {
      label = document.createElement("span");
      label.className = "label";
      label.textContent = name;
      label.addEventListener("click", () => this.onPick(name));
      this.labels.set(name, label);
      this.element.append(label);
    }
    return label;
  }
}

// Those in front of the camera and inside the picture, the nearest first.
function visible(camera: Camera, robots: Labelled[]): { robot: Labelled; onScreen: Vector3 }[] {
  const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  return robots
    .map((robot) => ({ robot, onScreen: robot.position.clone().project(camera) }))
    .filter(({ onScreen: p }) => p.z < 1 && Math.abs(p.x) <= 1 && Math.abs(p.y) <= 1)
    .sort((a, b) => a.robot.position.distanceToSquared(eye) - b.robot.position.distanceToSquared(eye));
}
