// Draws radio messages for a moment: a line from the sender to each receiver, or a short vertical
// line at a sender without receivers.
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
  to: string | null; // null: no robot received it
  until: number; // ms
}

export class RadioLinks {
  private links: Link[] = [];

  // Ignores everything except messages of /gsv/radio. `now`: ms of the page's clock.
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

  // Uses the displayed poses of the robots.
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
