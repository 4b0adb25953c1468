// Points from the messages of lidars and depth cameras, in the sensor's frame: x forward, y left, z
// up; metres.

export interface LaserScan {
  angle_min: number;
  angle_increment: number;
  range_min: number;
  range_max: number;
  ranges: Float32Array;
  intensities?: ArrayLike<number>; // one per beam; empty if the lidar does not measure them
}

// For a lidar with several rows, beam i of row r is ranges[r * beams + i].
export interface LidarScan extends LaserScan {
  beams: number;
  rows: number;
  vertical_angle_min: number;
  vertical_angle_increment: number;
}

export interface PointCloud {
  height: number;
  width: number;
  fields: { name: string; offset: number; datatype: number; count: number }[];
  is_bigendian: boolean;
  point_step: number;
  row_step: number;
  data: Uint8Array;
}

// maximum number of points per sensor; if there are more, every n-th point is used
export const MOST_POINTS = 20_000;

const FLOAT32 = 7;
const FLOAT64 = 8;

export interface Points {
  points: Float32Array; // x y z for each point
  intensities: Float32Array | null; // one for each point; null if they are not measured
}

const NO_POINTS: Points = { points: new Float32Array(0), intensities: null };

// Returns the points in a message. There are none if the message is of another kind or invalid.
export function cloudOf(message: unknown): Points {
  if (typeof message !== "object" || message === null) return NO_POINTS;
  if ("ranges" in message && "beams" in message) return pointsOfRows(message as LidarScan);
  if ("ranges" in message) return pointsOfScan(message as LaserScan);
  if ("point_step" in message) return pointsOfCloud(message as PointCloud);
  return NO_POINTS;
}

// Returns x y z for each point.
export function pointsOf(message: unknown): Float32Array {
  return cloudOf(message).points;
}

function pointsOfScan({ angle_min, angle_increment, range_min, range_max, ranges, intensities }: LaserScan): Points {
  const strengths = intensities?.length === ranges.length ? intensities : null;
  const points = new PointList(ranges.length, strengths !== null);
  for (let i = 0; i < ranges.length; i += points.stride) {
    const range = ranges[i]!;
    if (!(range >= range_min && range <= range_max)) continue;
    const angle = angle_min + i * angle_increment;
    points.add(range * Math.cos(angle), range * Math.sin(angle), 0, strengths?.[i]);
  }
  return points.taken();
}

function pointsOfRows(scan: LidarScan): Points {
  const { angle_min, angle_increment, range_min, range_max, ranges, beams } = scan;
  if (!(beams > 0)) return NO_POINTS;
  const strengths = scan.intensities?.length === ranges.length ? scan.intensities : null;
  const points = new PointList(ranges.length, strengths !== null);
  for (let i = 0; i < ranges.length; i += points.stride) {
    const range = ranges[i]!;
    if (!(range >= range_min && range <= range_max)) continue;
    const azimuth = angle_min + (i % beams) * angle_increment;
    const elevation = scan.vertical_angle_min + Math.floor(i / beams) * scan.vertical_angle_increment;
    const level = range * Math.cos(elevation);
    points.add(level * Math.cos(azimuth), level * Math.sin(azimuth), range * Math.sin(elevation), strengths?.[i]);
  }
  return points.taken();
}

function pointsOfCloud(cloud: PointCloud): Points {
  const offsets = ["x", "y", "z"].map((name) => cloud.fields.find((field) => field.name === name));
  const [x, y, z] = offsets;
  const isReadable =
    x && y && z && [FLOAT32, FLOAT64].includes(x.datatype) && cloud.point_step > 0 && cloud.row_step >= 0;
  if (!isReadable) return NO_POINTS;
  const strength = cloud.fields.find(({ name, datatype }) => name === "intensity" && datatype === FLOAT32);
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const bytes = x.datatype === FLOAT64 ? 8 : 4;
  const little = !cloud.is_bigendian;
  const read = (at: number) =>
    at + bytes > view.byteLength
      ? NaN
      : bytes === 8
        ? view.getFloat64(at, little)
        : view.getFloat32(at, little);
  const float32 = (at: number) => (at + 4 > view.byteLength ? NaN : view.getFloat32(at, little));
  const count = Math.min(cloud.width * cloud.height, Math.floor(view.byteLength / cloud.point_step));
  const points = new PointList(count, strength !== undefined);
  for (let i = 0; i < count; i += points.stride) {
    const row = Math.floor(i / cloud.width);
    const at = row * cloud.row_step + (i - row * cloud.width) * cloud.point_step;
    points.add(read(at + x.offset), read(at + y.offset), read(at + z.offset), strength && float32(at + strength.offset));
  }
  return points.taken();
}

class PointList {
  readonly stride: number;
  private readonly numbers: Float32Array;
  private readonly intensities: Float32Array | null;
  private used = 0; // points

  constructor(count: number, hasIntensities: boolean) {
    this.stride = Math.max(1, Math.ceil(count / MOST_POINTS));
    const taken = Math.ceil(count / this.stride);
    this.numbers = new Float32Array(3 * taken);
    this.intensities = hasIntensities ? new Float32Array(taken) : null;
  }

  add(x: number, y: number, z: number, intensity = 0): void {
    if (!Number.isFinite(x + y + z)) return;
    const at = 3 * this.used;
    this.numbers[at] = x;
    this.numbers[at + 1] = y;
    this.numbers[at + 2] = z;
    if (this.intensities) this.intensities[this.used] = intensity;
    this.used += 1;
  }

  taken(): Points {
    return { points: this.numbers.subarray(0, 3 * this.used), intensities: this.intensities?.subarray(0, this.used) ?? null };
  }
}

// A contact of a bumper.
export interface TouchPoint {
  point: [number, number, number];
  normal: [number, number, number]; // unit vector from the robot to the touched body
  force: [number, number, number] | null; // force on the robot, N; null if the engine does not compute it
}

const MOST_CONTACTS = 200;

// Returns the contacts in a bumper's message. If the message is of another kind, there are none.
export function contactsOf(message: unknown): TouchPoint[] {
  const contacts = (message as { contacts?: unknown } | null)?.contacts;
  if (!Array.isArray(contacts)) return [];
  return contacts.slice(0, MOST_CONTACTS).flatMap((contact: unknown) => {
    const { point, normal, force } = contact as { point?: unknown; normal?: unknown; force?: unknown };
    const [at, along, pressed] = [triple(point), triple(normal), triple(force)];
    const isComputed = pressed?.some((component) => component !== 0) ?? false;
    return at && along ? [{ point: at, normal: along, force: isComputed ? pressed : null }] : [];
  });
}

export const CURRENT_CONTACTS_TOPIC = "/gsv/current_contacts";
const MOST_WORLD_POINTS = 2000;

// Returns the points of all contacts in the world, in the world frame. Each point has the force on
// the first body of the contact. If this body is on the ground, the force points upwards.
export function worldContactsOf(message: unknown): TouchPoint[] {
  const contacts = (message as { contacts?: unknown } | null)?.contacts;
  if (!Array.isArray(contacts)) return [];
  const found: TouchPoint[] = [];
  for (const contact of contacts as { normal?: unknown; points?: unknown; forces?: unknown }[]) {
    const normal = triple(contact.normal);
    if (!normal || !Array.isArray(contact.points)) continue;
    const forces = Array.isArray(contact.forces) ? contact.forces : [];
    for (const [i, point] of contact.points.entries()) {
      const at = triple(point);
      const onSecond = triple(forces[i]);
      const isComputed = onSecond?.some((component) => component !== 0) ?? false;
      if (at && found.length < MOST_WORLD_POINTS) {
        found.push({ point: at, normal, force: isComputed ? [-onSecond![0], -onSecond![1], -onSecond![2]] : null });
      }
    }
  }
  return found;
}

function triple(value: unknown): [number, number, number] | null {
  const { x, y, z } = (value ?? {}) as Record<string, unknown>;
  const isPoint = typeof x === "number" && typeof y === "number" && typeof z === "number";
  return isPoint && Number.isFinite(x + y + z) ? [x, y, z] : null;
}
