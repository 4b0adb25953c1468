// Draws each radio message for a short time. It is a line from the sender to each receiver. If
// there is no receiver, it is a short vertical line at the sender.
import type { Matrix4 } from "three";
import { Matrix4 as Place, Vector3 } from "three";
import type { LineLayer } from "./LineLayer";
import { rgb } from "./LineLayer";

const SHOWN_MS = 500;
const MOST_LINKS = 500;
const COLOUR = rgb(0x7a3ff2);
const UNHEARD = 0.3; // m
const WORLD = new Place();

interface Link {
  from: string;
  to: string | null; // null if no robot has received the message
  until: number; // ms
}

export class RadioLinks {
  private links: Link[] = [];

  // Takes a message of /gsv/radio; ignores all other messages. `now` is the time of the page's
  // clock in ms.
  take(message: unknown, now: number): void {
    const { sender, heard_by } = (message ?? {}) as Record<string, unknown>;
    if (typeof sender !== "string" || !Array.isArray(heard_by)) return;
    const heard = heard_by.filter((name): name is string => typeof name === "string");
    const until = now + SHOWN_MS;
    for (const to of heard.length > 0 ? heard : [null]) this.links.push({ from: sender, to, until });
    this.links = this.links.slice(-MOST_LINKS);
  }

  clear(): void {
    this.links = [];
  }

  // Adds the present lines to `lines`. `worldFromRobot` returns the displayed pose of a robot.
  draw(lines: LineLayer, worldFromRobot: (robot: string) => Matrix4 | null, now: number): void {
    this.links = this.links.filter(({ until }) => until > now);
    for (const { from, to } of this.links) {
      const sender = placeOf(worldFromRobot(from));
      if (!sender) continue;
      const [x, y, z] = sender;
      const end = to === null ? [x, y, z + UNHEARD] : placeOf(worldFromRobot(to));
      if (end) lines.add(WORLD, sender, end, COLOUR);
    }
  }
}

const point = new Vector3();

// Returns x y z, slightly above the floor.
function placeOf(worldFromRobot: Matrix4 | null): [number, number, number] | null {
  if (!worldFromRobot) return null;
  const { x, y, z } = point.setFromMatrixPosition(worldFromRobot);
  return [x, y, z + 0.2];
}
