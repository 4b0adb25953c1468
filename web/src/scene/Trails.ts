// The paths of the robots. A path consists of the last places of a robot, at small distances.
import type { LineLayer } from "./LineLayer";
import { rgb } from "./LineLayer";
import { scaleColour } from "./PointLayer";
import type { TrailColour } from "../state/overlays";

const MOST_PLACES = 400; // number of places of one robot
const MOST_ROBOTS = 200;
const APART_M = 0.05;
// m: if a robot moves farther between two updates, its trail begins again, because the robot was
// moved by an edit or the replay has jumped
const JUMP_M = 2;
const COLOURS = [0x2f81e0, 0xe0701a, 0x2a9d4a, 0xc2399b, 0xd0453e, 0x12938f].map(rgb);
const ABOVE_FLOOR_M = 0.02;
// m/s: the colour scale for speeds ends at this speed or higher. Otherwise, the noise of robots at
// rest would get the colours of high speeds.
const LEAST_TOP_SPEED = 0.1;

interface Trail {
  places: Float32Array; // x y z of each place, as a ring buffer
  stamps: Float64Array; // s, one for each place
  first: number;
  count: number;
}

export class Trails {
  private readonly trails = new Map<string, Trail>();
  private stamp = -Infinity;

  clear(): void {
    this.trails.clear();
    this.stamp = -Infinity;
  }

  // Adds the robots' places at the instant `stamp` (s, simulated). If the instant is earlier than
  // the last one, all trails are cleared first.
  push(stamp: number, robots: Iterable<{ name: string; x: number; y: number; z: number }>): void {
    if (stamp < this.stamp) this.trails.clear();
    this.stamp = stamp;
    for (const { name, x, y, z } of robots) {
      let trail = this.trails.get(name);
      if (!trail) {
        if (this.trails.size >= MOST_ROBOTS) continue;
        trail = { places: new Float32Array(3 * MOST_PLACES), stamps: new Float64Array(MOST_PLACES), first: 0, count: 0 };
        this.trails.set(name, trail);
      }
      extend(trail, stamp, x, y, z + ABOVE_FLOOR_M);
    }
  }

  keepOnly(robots: ReadonlySet<string>): void {
    for (const name of [...this.trails.keys()]) if (!robots.has(name)) this.trails.delete(name);
  }

  // Draws the trails in a colour for each robot, or coloured by speed. The scale is from 0 (dark)
  // to the largest speed of all trails.
  draw(lines: LineLayer, by: TrailColour = "robot"): void {
    const topSpeed = by === "speed" ? this.topSpeed() : 1;
    let index = 0;
    for (const trail of this.trails.values()) {
      const own = COLOURS[index++ % COLOURS.length]!;
      for (let i = 1; i < trail.count; i++) {
        const [from, to] = [(trail.first + i - 1) % MOST_PLACES, (trail.first + i) % MOST_PLACES];
        const colour = by === "speed" ? scaleColour(speedOf(trail, from, to) / topSpeed) : own;
        lines.addInWorld(trail.places, 3 * from, 3 * to, colour);
      }
    }
  }

  private topSpeed(): number {
    let top = LEAST_TOP_SPEED;
    for (const trail of this.trails.values()) {
      for (let i = 1; i < trail.count; i++) {
        top = Math.max(top, speedOf(trail, (trail.first + i - 1) % MOST_PLACES, (trail.first + i) % MOST_PLACES));
      }
    }
    return top;
  }
}

function extend(trail: Trail, stamp: number, x: number, y: number, z: number): void {
  const { places } = trail;
  if (trail.count > 0) {
    const last = 3 * ((trail.first + trail.count - 1) % MOST_PLACES);
    const moved = Math.hypot(x - places[last]!, y - places[last + 1]!, z - places[last + 2]!);
    if (moved < APART_M) return;
    if (moved > JUMP_M) trail.count = 0;
  }
  const at = (trail.first + trail.count) % MOST_PLACES;
  places.set([x, y, z], 3 * at);
  trail.stamps[at] = stamp;
  if (trail.count < MOST_PLACES) trail.count += 1;
  else trail.first = (trail.first + 1) % MOST_PLACES;
}

// Returns the mean speed between two places, in m/s; 0 if no time passed between them.
function speedOf({ places, stamps }: Trail, from: number, to: number): number {
  const time = stamps[to]! - stamps[from]!;
  const [a, b] = [3 * from, 3 * to];
  const way = Math.hypot(places[b]! - places[a]!, places[b + 1]! - places[a + 1]!, places[b + 2]! - places[a + 2]!);
  return time > 0 ? way / time : 0;
}
