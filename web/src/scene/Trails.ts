// The paths of the robots: for each, its last places at small distances.
import type { LineLayer } from "./LineLayer";
import { rgb } from "./LineLayer";

const MOST_PLACES = 400; // of one robot
const MOST_ROBOTS = 200;
const APART_M = 0.05;
const JUMP_M = 2; // between two updates: it was put there, or the recording was moved
const COLOURS = [0x2f81e0, 0xe0701a, 0x2a9d4a, 0xc2399b, 0xd0453e, 0x12938f].map(rgb);
const ABOVE_FLOOR_M = 0.02;

interface Trail {
  places: Float32Array; // x y z, a ring
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

  // Adds the robots' places at the instant `stamp` (s, simulated). An earlier instant than the last
  // one restarts all trails.
  push(stamp: number, robots: Iterable<{ name: string; x: number; y: number; z: number }>): void {
    if (stamp < this.stamp) this.trails.clear();
    this.stamp = stamp;
    for (const { name, x, y, z } of robots) {
      let trail = this.trails.get(name);
      if (!trail) {
        if (this.trails.size >= MOST_ROBOTS) continue;
        trail = { places: new Float32Array(3 * MOST_PLACES), first: 0, count: 0 };
        this.trails.set(name, trail);
      }
      extend(trail, x, y, z + ABOVE_FLOOR_M);
    }
  }

  keepOnly(robots: ReadonlySet<string>): void {
    for (const name of [...this.trails.keys()]) if (!robots.has(name)) this.trails.delete(name);
  }

  draw(lines: LineLayer): void {
    let index = 0;
    for (const { places, first, count } of this.trails.values()) {
      const colour = COLOURS[index++ % COLOURS.length]!;
      for (let i = 1; i < count; i++) {
        const from = 3 * ((first + i - 1) % MOST_PLACES);
        lines.addInWorld(places, from, 3 * ((first + i) % MOST_PLACES), colour);
      }
    }
  }
}

function extend(trail: Trail, x: number, y: number, z: number): void {
  const { places } = trail;
  if (trail.count > 0) {
    const last = 3 * ((trail.first + trail.count - 1) % MOST_PLACES);
    const moved = Math.hypot(x - places[last]!, y - places[last + 1]!, z - places[last + 2]!);
    if (moved < APART_M) return;
    if (moved > JUMP_M) trail.count = 0;
  }
  places.set([x, y, z], 3 * ((trail.first + trail.count) % MOST_PLACES));
  if (trail.count < MOST_PLACES) trail.count += 1;
  else trail.first = (trail.first + 1) % MOST_PLACES;
}
