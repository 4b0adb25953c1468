#!/usr/bin/env node
// Draws the content of a recording with third-party code only: @mcap/core reads the file,
// @foxglove/rosmsg and @foxglove/rosmsg2-serialization decode the messages.
//
//   tools/draw_recording.mjs PACKAGE_JSON FILE.mcap OUT.svg
//
// PACKAGE_JSON is beside the node_modules with these packages (web/package.json). The drawing shows
// from above: each robot's path (/tf), the ends of its sonars' beams (/gsv/beams), and the points
// of its lidars (sensor_msgs/msg/LaserScan, placed by /tf and /tf_static).
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [packageJson, file, out] = process.argv.slice(2);
const require = createRequire(path.resolve(packageJson));
const { McapIndexedReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const fzstd = require("fzstd");

const COLOURS = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf", "#8c564b", "#e377c2"];
const WIDTH = 880;
const MARGIN = 24;
const LEGEND = 26;
const MOST_POINTS = 6000; // maximum number of points of each kind
const CELL = 0.03; // m; only one point of a cell is drawn

// Composes poses in the plane: [x, y, yaw].
const compose = ([x, y, yaw], [u, v, turn]) =>
  [x + Math.cos(yaw) * u - Math.sin(yaw) * v, y + Math.sin(yaw) * u + Math.cos(yaw) * v, yaw + turn];
function planar({ translation, rotation: { x, y, z, w } }) {
  return [translation.x, translation.y, Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))];
}

async function* messagesOf(bytes) {
  const reader = await McapIndexedReader.Initialize({
    readable: {
      size: async () => BigInt(bytes.length),
      read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
    },
    decompressHandlers: { zstd: (data, size) => fzstd.decompress(data, new Uint8Array(Number(size))) },
  });
  const decoders = new Map();
  for await (const { channelId, data } of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!decoders.has(schema.id)) {
      decoders.set(schema.id, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
    }
    yield { topic: channel.topic, type: schema.name, content: decoders.get(schema.id).readMessage(data) };
  }
}

// A set of points with at most one point per grid cell.
class Points {
  cells = new Map();

  add(x, y, robot) {
    const key = `${Math.round(x / CELL)} ${Math.round(y / CELL)}`;
    if (!this.cells.has(key)) this.cells.set(key, { x, y, robot });
  }

  get list() {
    const all = [...this.cells.values()];
    const every = Math.ceil(all.length / MOST_POINTS);
    return all.filter((_, index) => index % every === 0);
  }
}

class Drawing {
  paths = new Map(); // by robot
  poses = new Map(); // by frame, in the frame above
  parents = new Map();
  scans = new Points();
  echoes = new Points();
  messages = 0;
  topics = new Set();

  take({ topic, type, content }) {
    this.messages += 1;
    this.topics.add(topic);
    if (type === "tf2_msgs/msg/TFMessage") content.transforms.forEach((each) => this.takeTransform(each));
    if (type === "sensor_msgs/msg/LaserScan") this.takeScan(content);
    if (topic === "/gsv/beams") content.markers.forEach((each) => this.takeBeams(each));
  }

  takeTransform({ header, child_frame_id: frame, transform }) {
    const pose = planar(transform);
    this.poses.set(frame, pose);
    this.parents.set(frame, header.frame_id);
    if (header.frame_id !== "map" || !frame.endsWith("/base_link")) return;
    const robot = frame.split("/")[0];
    const track = this.paths.get(robot) ?? [];
    const last = track.at(-1);
    if (!last || Math.hypot(pose[0] - last[0], pose[1] - last[1]) > 0.02) track.push(pose);
    this.paths.set(robot, track);
  }

  worldFrom(frame) {
    if (frame === "map") return [0, 0, 0];
    const pose = this.poses.get(frame);
    return pose && compose(this.worldFrom(this.parents.get(frame)), pose);
  }

  takeScan({ header, angle_min, angle_increment, range_min, range_max, ranges }) {
    const sensor = this.worldFrom(header.frame_id);
    if (!sensor) return;
    ranges.forEach((range, index) => {
      if (!(range > range_min && range < range_max)) return;
      const [x, y] = compose(compose(sensor, [0, 0, angle_min + index * angle_increment]), [range, 0, 0]);
      this.scans.add(x, y, header.frame_id.split("/")[0]);
    });
  }

  takeBeams({ ns, points }) {
    for (let i = 1; i < points.length; i += 2) this.echoes.add(points[i].x, points[i].y, ns);
  }

  // Returns the robots that moved, ordered by name.
  get robots() {
    return [...this.paths.keys()].filter((robot) => this.paths.get(robot).length > 1).sort();
  }

  svg(title) {
    const robots = this.robots;
    const colour = (robot) => COLOURS[Math.max(0, robots.indexOf(robot)) % COLOURS.length];
    const scans = this.scans.list;
    const echoes = this.echoes.list;
    const drawn = [...scans, ...echoes, ...robots.flatMap((robot) => this.paths.get(robot).map(([x, y]) => ({ x, y })))];
    const span = (pick) => [Math.min(...drawn.map(pick)), Math.max(...drawn.map(pick))];
    const [[left, right], [bottom, top]] = [span(({ x }) => x), span(({ y }) => y)];
    const scale = (WIDTH - 2 * MARGIN) / (right - left);
    const px = (x) => (MARGIN + (x - left) * scale).toFixed(1);
    const py = (y) => (MARGIN + (top - y) * scale).toFixed(1);
    const dots = (points, radius, opacity, choose) => [...new Set(points.map(({ robot }) => choose(robot)))].map((fill) =>
      `<path fill="none" stroke="${fill}" stroke-width="${2 * radius}" stroke-linecap="round" opacity="${opacity}" d="${
        points.filter(({ robot }) => choose(robot) === fill).map(({ x, y }) => `M${px(x)} ${py(y)}h0`).join("")}"/>`);
    const height = 2 * MARGIN + (top - bottom) * scale;
    const lines = [
      `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${(height + 2 * LEGEND).toFixed(0)}" font-family="sans-serif" font-size="13">`,
      `<title>${title}</title>`,
      `<rect width="100%" height="100%" fill="#ffffff"/>`,
      ...dots(scans, 1.1, 0.9, () => "#6b7280"),
      ...dots(echoes, 1.3, 0.45, colour),
    ];
    for (const robot of robots) {
      const track = this.paths.get(robot);
      const [x, y] = track.at(-1);
      lines.push(
        `<path fill="none" stroke="${colour(robot)}" stroke-width="2" stroke-linejoin="round" d="M${
          track.map(([u, v]) => `${px(u)} ${py(v)}`).join("L")}"/>`,
        `<circle cx="${px(x)}" cy="${py(y)}" r="4.5" fill="${colour(robot)}" stroke="#ffffff"/>`);
    }
    robots.forEach((robot, index) => {
      const x = MARGIN + index * 130;
      lines.push(
        `<circle cx="${x + 5}" cy="${(height + LEGEND / 2).toFixed(0)}" r="4.5" fill="${colour(robot)}"/>`,
        `<text x="${x + 15}" y="${(height + LEGEND / 2 + 4).toFixed(0)}" fill="#1f2937">${robot}</text>`);
    });
    lines.push(
      `<text x="${MARGIN}" y="${(height + LEGEND + 14).toFixed(0)}" fill="#4b5563">lines: paths · coloured points: ends of sonar beams${
        scans.length > 0 ? " · grey points: lidar" : ""} · ${this.messages} messages on ${this.topics.size} topics</text>`,
      `<path stroke="#1f2937" stroke-width="2" fill="none" d="M${WIDTH - MARGIN - scale} ${height.toFixed(0)}h${scale.toFixed(1)}m0 -4v8m-${scale.toFixed(1)} 0v-8"/>`,
      `<text x="${WIDTH - MARGIN}" y="${(height + 18).toFixed(0)}" text-anchor="end" fill="#1f2937">1 m</text>`,
      `</svg>`, "");
    return lines.join("\n");
  }
}

const drawing = new Drawing();
for await (const message of messagesOf(readFileSync(file))) drawing.take(message);
if (drawing.robots.length === 0) throw new Error(`${file}: no robot moves in it`);
writeFileSync(out, drawing.svg(`The content of ${path.basename(file)}, seen from above`));
console.log(`${out}: ${drawing.robots.length} robots, ${drawing.messages} messages on ${drawing.topics.size} topics`);
