// Unpacks the poses of the bodies. A server offers rounded poses (/gsv/packed_poses), because they
// need only a third of the bytes of exact poses.
import type { PackedPosesMessage, PosesMessage } from "./messages";

export const PACKED_POSES = "/gsv/packed_poses";
export const POSES = "/gsv/poses"; // exact poses: the only topic of poses that replays and older servers offer

const METRES = 1e-4;
const HALF_SCALE = 16383.5;
const COMPONENT = 0x7fff;

export function posesOf(message: PosesMessage | PackedPosesMessage): PosesMessage {
  if ("poses" in message) return message;
  const { stamp, step, layout_version, positions, rotations } = message;
  const entries = Math.floor(Math.min(positions.length, rotations.length) / 3);
  const poses = new Float64Array(7 * entries);
  for (let entry = 0; entry < entries; entry++) {
    const from = 3 * entry;
    const at = 7 * entry;
    for (let k = 0; k < 3; k++) poses[at + k] = positions[from + k]! * METRES;
    unpackRotation(rotations, from, poses, at + 3);
  }
  return { stamp, step, layout_version, poses };
}

// The largest component of a unit quaternion x y z w is omitted. Two bits contain the index of this
// component.
function unpackRotation(packed: Uint16Array, from: number, out: Float64Array, at: number): void {
  const missing = 2 * (packed[from]! >> 15) + (packed[from + 1]! >> 15);
  let squared = 0;
  for (let k = 0, next = from; k < 4; k++) {
    if (k === missing) continue;
    const value = ((packed[next++]! & COMPONENT) / HALF_SCALE - 1) * Math.SQRT1_2;
    out[at + k] = value;
    squared += value * value;
  }
  out[at + missing] = Math.sqrt(Math.max(0, 1 - squared));
}
