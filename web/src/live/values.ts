// Extracts the numbers in a message, each with a key and the server's unit. The code contains no
// sensor types: fields are shown by their names.

// Units by the path of a field in the sensor's messages. A path applies to all fields below it.
export type Units = Readonly<Record<string, string>>;

// One number of a message.
export interface LiveValue {
  key: string; // path of the field, such as "range", "pose.position.x" or "ranges.min"
  unit: string; // empty if there is none, or if it is unknown
  value: number; // may be infinite or NaN, for a missing echo or a lost value
}

const MOST_VALUES = 64; // maximum number of values of one message
const LONGEST_LISTED = 8; // longer lists are summarised
const DEEPEST = 6;
// Fields that are not shown. They describe the time, the uncertainty or the construction of the
// sensor, and not its reading.
const LEFT_OUT = new RegExp(
  `^(${[
    "header|stamp|.*covariance|.*_covariance_type|status",
    "radiation_type|field_of_view|(min|max)_range|range_(min|max)|angle_(min|max|increment)",
    "radius_m|range_m|angle_rad|intensity|reach_m|height_m|loudness_db",
    "time_increment|scan_time|intensities|cell_.*|power_supply_.*|design_capacity|vertical_reference",
  ].join("|")})$`,
);

export function valuesOf(message: unknown, units: Units = {}): LiveValue[] {
  const values: LiveValue[] = [];
  collect(message, "", 0, values);
  return values.map((value) => ({ ...value, unit: value.unit || unitOf(value.key, units) }));
}

// Returns the unit of a key. A path in `units` applies to the field itself and to all fields below
// it. The longest path that applies determines the unit.
export function unitOf(key: string, units: Units): string {
  const parts = key.replace(/\[[^\]]*\]/g, "").split(".");
  for (let count = parts.length; count > 0; count--) {
    const path = parts.slice(0, count).join(".");
    if (Object.hasOwn(units, path)) return units[path]!;
  }
  return "";
}

function add(values: LiveValue[], key: string, value: number, unit = ""): void {
  if (values.length < MOST_VALUES) values.push({ key, unit, value });
}

function collect(value: unknown, key: string, depth: number, values: LiveValue[]): void {
  if (typeof value === "number") add(values, key, value);
  else if (typeof value === "bigint") add(values, key, Number(value));
  else if (typeof value === "boolean") add(values, key, value ? 1 : 0);
  else if (isNumberList(value)) collectList(value, key, values);
  else if (typeof value === "object" && value !== null && !ArrayBuffer.isView(value) && depth < DEEPEST) {
    if (Array.isArray(value)) collectObjects(value, key, depth, values);
    else collectFields(value as Record<string, unknown>, key, depth, values);
  }
}

function collectFields(
  fields: Record<string, unknown>,
  key: string,
  depth: number,
  values: LiveValue[],
): void {
  const names = namesBeside(fields);
  for (const [name, value] of Object.entries(fields)) {
    if (LEFT_OUT.test(name)) continue;
    const path = key ? `${key}.${name}` : name;
    if (isQuaternion(value)) collectAngles(value, path, values);
    else if (names && isNumberList(value) && value.length === names.length) {
      names.forEach((each, i) => add(values, `${path}[${each}]`, Number(value[i])));
    } else collect(value, path, depth + 1, values);
  }
}

// Collects the number of objects in a list, and the values of the first object.
function collectObjects(list: unknown[], key: string, depth: number, values: LiveValue[]): void {
  if (typeof list[0] === "string") return;
  add(values, `${key}.count`, list.length);
  if (typeof list[0] === "object") collect(list[0], `${key}[0]`, depth + 1, values);
}

// Collects all values of a short list, or the minimum, maximum and mean of the finite values of a
// long list.
function collectList(list: NumberList, key: string, values: LiveValue[]): void {
  if (list.length === 0) return;
  if (list.length <= LONGEST_LISTED) {
    list.forEach((value: number | bigint, i: number) => add(values, `${key}[${i}]`, Number(value)));
    return;
  }
  let [min, max, sum, finite] = [Infinity, -Infinity, 0, 0];
  for (const each of list) {
    const value = Number(each);
    if (!Number.isFinite(value)) continue;
    min = Math.min(min, value);
    max = Math.max(max, value);
    sum += value;
    finite += 1;
  }
  add(values, `${key}.min`, finite > 0 ? min : NaN);
  add(values, `${key}.max`, finite > 0 ? max : NaN);
  add(values, `${key}.mean`, finite > 0 ? sum / finite : NaN);
}

type NumberList = Float64Array | Float32Array | Int32Array | number[];

function isNumberList(value: unknown): value is NumberList {
  // Byte arrays are images and point clouds.
  if (value instanceof Uint8Array || value instanceof Int8Array || value instanceof DataView) return false;
  if (ArrayBuffer.isView(value)) return true;
  return Array.isArray(value) && typeof value[0] === "number";
}

// Returns the names in messages such as JointState. These messages have one name for each number in
// the other fields.
function namesBeside(fields: Record<string, unknown>): string[] | null {
  const { name } = fields;
  if (!Array.isArray(name) || name.length === 0) return null;
  return name.every((each) => typeof each === "string") ? name : null;
}

interface Quaternion {
  x: number;
  y: number;
  z: number;
  w: number;
}

function isQuaternion(value: unknown): value is Quaternion {
  if (typeof value !== "object" || value === null) return false;
  const keys = Object.keys(value);
  return keys.length === 4 && ["x", "y", "z", "w"].every((key) => keys.includes(key));
}

function collectAngles(rotation: Quaternion, key: string, values: LiveValue[]): void {
  const angles = anglesOf(rotation);
  for (const name of ["roll", "pitch", "yaw"] as const) add(values, `${key}.${name}`, angles[name], "rad");
}

// Roll, pitch and yaw of R = Rz(yaw) Ry(pitch) Rx(roll), in radians.
export function anglesOf({ x, y, z, w }: Quaternion): { roll: number; pitch: number; yaw: number } {
  return {
    roll: Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    pitch: Math.asin(Math.min(1, Math.max(-1, 2 * (w * y - z * x)))),
    yaw: Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  };
}

// The time of a message in simulated seconds; null if it has none.
export function stampOf(message: unknown): number | null {
  const fields = message as { header?: { stamp?: unknown }; stamp?: unknown } | null;
  const stamp = (fields?.header?.stamp ?? fields?.stamp) as { sec?: unknown; nsec?: unknown } | undefined;
  if (typeof stamp?.sec !== "number" || typeof stamp.nsec !== "number") return null;
  return stamp.sec + stamp.nsec * 1e-9;
}
