// Decodes messages of every type with software by others: the definition with @foxglove/rosmsg, the
// bytes with @foxglove/rosmsg2-serialization. Each value must follow the rule of sample_filler.h,
// and each of ROS's types must equal that of ROS 2 Humble, according to
// @foxglove/rosmsg-msgs-common.
//
//   node interop_test.mjs MODULES_ROOT WRITE_SAMPLES
//
// MODULES_ROOT is the package.json whose node_modules contain these packages.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import path from "node:path";

const [modulesRoot, writeSamples] = process.argv.slice(2);
const require = createRequire(path.resolve(modulesRoot));
const { parse } = require("@foxglove/rosmsg");
const { ros2humble } = require("@foxglove/rosmsg-msgs-common");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

// Computes the expected values by the rule of sample_filler.h, from the definition as the parser
// returned it.
class Expectation {
  constructor(definitions, seed) {
    this.definitions = definitions;
    this.next = seed;
  }

  message(definition) {
    const result = {};
    for (const field of definition.definitions) {
      if (!field.isConstant) result[field.name] = this.field(field);
    }
    return result;
  }

  field(field) {
    if (!field.isArray) return this.value(field.type, field.isComplex);
    const count = field.arrayLength ?? this.next++ % 4;
    return Array.from({ length: count }, () => this.value(field.type, field.isComplex));
  }

  value(type, isComplex) {
    if (isComplex) return this.message(this.definitions.find((each) => each.name === type));
    if (type === "time" || type === "duration") {
      return { sec: this.value("int32"), nanosec: this.value("uint32") };
    }
    const n = this.next++;
    if (type === "bool") return n % 2 === 1;
    if (type === "string") return "x".repeat(n % 7);
    if (type.startsWith("float")) return n + 0.5;
    const size = n % 100;
    const value = type.startsWith("int") && n % 2 === 1 ? 0 - size : size;
    return type.endsWith("int64") ? BigInt(value) : value;
  }
}

// Typed arrays as plain arrays, so that only values are compared. Some versions of the reader call
// a time's nanoseconds "nsec".
function plain(value) {
  if (ArrayBuffer.isView(value)) return Array.from(value);
  if (Array.isArray(value)) return value.map(plain);
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key === "nsec" ? "nanosec" : key, plain(inner)]));
}

function assertIsHumbles(name, definition) {
  // rosmsg-msgs-common contains no services, no types of GSV, and no types of these packages.
  if (/^(gsv_msgs|ros_gz_interfaces|vision_msgs|simulation_interfaces|service_msgs)\/|\/srv\//.test(name)) return;
  const humbles = ros2humble[name.replace("/msg/", "/")];
  const fields = ({ definitions }) =>
    definitions.map(({ type, name, isArray = false, arrayLength, isConstant = false, value }) =>
      ({ type, name, isArray, arrayLength, isConstant, value }));
  assert.deepEqual(fields(definition), fields(humbles), `${name} differs from Humble's`);
}

const types = new Set();
let messages = 0;
for (const line of execFileSync(writeSamples, { maxBuffer: 1 << 28 }).toString().trim().split("\n")) {
  const [name, schema, seed, bytes] = line.split(" ");
  const definitions = parse(Buffer.from(schema, "hex").toString(), { ros2: true });
  const decoded = new MessageReader(definitions).readMessage(Buffer.from(bytes, "hex"));
  const expectation = new Expectation(definitions, Number(seed));
  assert.deepEqual(plain(decoded), expectation.message(definitions[0]), `${name}, seed ${seed}`);
  if (!types.has(name)) assertIsHumbles(name, definitions[0]);
  types.add(name);
  ++messages;
}
assert.ok(types.size >= 40, `expected every type, found ${types.size}`);
console.log(`${messages} messages of ${types.size} types decoded`);
