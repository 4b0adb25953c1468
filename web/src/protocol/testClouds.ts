// Messages with points, for tests.
import { parse } from "@foxglove/rosmsg";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";

const FIELD = "string name\nuint32 offset\nuint8 datatype\nuint32 count";
const HEADER = "builtin_interfaces/Time stamp\nstring frame_id";
const LINE = "=".repeat(80);
const SCHEMA = `std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
${LINE}
MSG: std_msgs/Header
${HEADER}
${LINE}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
${LINE}
MSG: sensor_msgs/PointField
${FIELD}`;

export const CLOUD_CHANNEL = {
  id: 7,
  topic: "/a/depth",
  encoding: "cdr",
  schemaName: "sensor_msgs/msg/PointCloud2",
  schema: SCHEMA,
  schemaEncoding: "ros2msg",
};

// Returns a message with rows of points. Point i is at (1 + i, 0, 0).
export function cloudMessage(width: number, height: number): Uint8Array {
  const data = new Uint8Array(12 * width * height);
  const view = new DataView(data.buffer);
  for (let i = 0; i < width * height; i++) view.setFloat32(12 * i, 1 + i, true);
  return new MessageWriter(parse(SCHEMA, { ros2: true })).writeMessage({
    header: { stamp: { sec: 2, nsec: 500_000_000 }, frame_id: "a" },
    height,
    width,
    fields: ["x", "y", "z"].map((name, k) => ({ name, offset: 4 * k, datatype: 7, count: 1 })),
    is_bigendian: false,
    point_step: 12,
    row_step: 12 * width,
    data,
  });
}
