// The motion that an input commands, as fractions of the maximum speeds. The input is keys, a pad
// or a gamepad.

export interface Wish {
  ahead: number; // -1 to 1
  left: number; // sideways
  turn: number; // counter-clockwise
}

export const STILL: Wish = { ahead: 0, left: 0, turn: 0 };

export interface Speeds {
  linear: number; // m/s
  angular: number; // rad/s
}

const FORWARD = ["w", "arrowup"];
const BACK = ["s", "arrowdown"];
const TURN_LEFT = ["a", "arrowleft"];
const TURN_RIGHT = ["d", "arrowright"];
const LEFT = ["q"];
const RIGHT = ["e"];
const KEYS = new Set([FORWARD, BACK, TURN_LEFT, TURN_RIGHT, LEFT, RIGHT].flat());
// Deflection of a stick that counts as zero, because a stick seldom rests exactly at zero.
const DEAD_ZONE = 0.12;

export function isDrivingKey(key: string): boolean {
  return KEYS.has(key.toLowerCase());
}

// The motion for the held keys (lower case). Opposite keys cancel each other.
export function wishOfKeys(held: ReadonlySet<string>): Wish {
  const any = (keys: string[]) => (keys.some((key) => held.has(key)) ? 1 : 0);
  return {
    ahead: any(FORWARD) - any(BACK),
    left: any(LEFT) - any(RIGHT),
    turn: any(TURN_LEFT) - any(TURN_RIGHT),
  };
}

// The motion for a point on the pad. x is to the right of the pad's centre and y is down from it,
// as fractions of the pad's radius.
export function wishOfPoint(x: number, y: number): Wish {
  const length = Math.max(1, Math.hypot(x, y));
  return { ahead: -y / length || 0, left: 0, turn: -x / length || 0 };
}

// The left stick drives and turns; the right stick moves sideways.
export function wishOfGamepad({ axes }: Pick<Gamepad, "axes">): Wish {
  const axis = (i: number) => {
    const value = axes[i] ?? 0;
    const size = Math.abs(value);
    return size <= DEAD_ZONE || !Number.isFinite(value) ? 0 : Math.sign(value) * Math.min(1, (size - DEAD_ZONE) / (1 - DEAD_ZONE));
  };
  return { ahead: -axis(1) || 0, left: -axis(2) || 0, turn: -axis(0) || 0 };
}

export function isStill({ ahead, left, turn }: Wish): boolean {
  return ahead === 0 && left === 0 && turn === 0;
}

export function driveOf({ ahead, left, turn }: Wish, { linear, angular }: Speeds) {
  return { linear_m_s: ahead * linear, lateral_m_s: left * linear, angular_rad_s: turn * angular };
}
