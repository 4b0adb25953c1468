// The beams of robots in typed arrays.
import type { MarkerArrayMessage, MarkerMessage } from "./messages";
import { LINE_LIST, seconds } from "./messages";

// Used if the marker does not have a colour for each beam. The single colour of the marker is not
// used.
const BEAM_COLOUR = { r: 1, g: 0.012, b: 0.006 };

// The beams of one robot. Two successive ends are a beam.
export interface RobotBeams {
  robot: string;
  stamp: number; // s, simulated
  points: Float64Array; // x y z of each end, in the world
  colours: Float32Array; // r g b of each end
}

// Returns one element for each marker. It has no ends if the marker is of another kind or removes
// the beams.
export function beamsOf({ markers }: MarkerArrayMessage): RobotBeams[] {
  return markers.map((marker) => {
    const isOfLines = marker.type === LINE_LIST && marker.action === 0;
    const ends = isOfLines ? marker.points.length - (marker.points.length % 2) : 0;
    return { robot: marker.ns, stamp: seconds(marker.header.stamp), ...endsOf(marker, ends) };
  });
}

function endsOf({ points, colors }: MarkerMessage, count: number): Pick<RobotBeams, "points" | "colours"> {
  const packed = { points: new Float64Array(3 * count), colours: new Float32Array(3 * count) };
  for (let i = 0, at = 0; i < count; i++, at += 3) {
    const { x, y, z } = points[i]!;
    packed.points[at] = x;
    packed.points[at + 1] = y;
    packed.points[at + 2] = z;
    const { r, g, b } = colors[i] ?? BEAM_COLOUR;
    packed.colours[at] = r;
    packed.colours[at + 1] = g;
    packed.colours[at + 2] = b;
  }
  return packed;
}
