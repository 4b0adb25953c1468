#!/usr/bin/env node
// Measures how long a viewer of a replay waits after a jump to a random instant, until both the
// answer and the poses of that instant have arrived.
//
//   bench/seek.mjs PACKAGE_JSON URL [SEEKS]
//
// PACKAGE_JSON is beside the node_modules with `ws` (web/package.json). URL is the address that
// `gsv replay --paused` prints. SEEKS is the number of jumps. Prints one JSON object; times in ms.
import { createRequire } from "node:module";
import path from "node:path";

const [packageJson, url, seeks = "100"] = process.argv.slice(2);
const { WebSocket } = createRequire(path.resolve(packageJson))("ws");
const TOPICS = ["/gsv/poses", "/gsv/status", "/gsv/events", "/gsv/beams"];

const json = async (target, options) => {
  const response = await fetch(`${url}${target}`, options);
  const body = await response.json();
  if (!response.ok) throw new Error(`${target}: ${body.error}`);
  return body;
};
const [{ name }] = await json("api/simulations");
const address = `api/simulations/${encodeURIComponent(name)}`;
const { start_s, end_s } = await json(`${address}/replay`);

// The instants are the same in every run.
let state = 1n;
const random = () => {
  state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
  return Number(state >> 11n) / 2 ** 53;
};

const ws = new WebSocket(`${url.replace("http", "ws")}ws`, ["foxglove.sdk.v1"], { perMessageDeflate: false });
let posesAt = () => {};
await new Promise((resolve) => {
  let poses = 0;
  ws.on("message", (data, isBinary) => {
    if (isBinary) {
      // A message has the opcode 1, the subscription, and the time in nanoseconds.
      if (data[0] === 1 && data.readUInt32LE(1) === poses) posesAt(Number(data.readBigUInt64LE(5)) * 1e-9);
      return;
    }
    const message = JSON.parse(data.toString());
    if (message.op !== "advertise" || poses !== 0) return;
    const subscriptions = message.channels.filter(({ topic }) => TOPICS.includes(topic))
      .map(({ id, topic }) => ({ id: TOPICS.indexOf(topic) + 1, channelId: id }));
    poses = TOPICS.indexOf("/gsv/poses") + 1;
    ws.send(JSON.stringify({ op: "subscribe", subscriptions }));
    posesAt = resolve;
  });
});

const times = [];
for (let i = 0; i < Number(seeks); ++i) {
  const target = start_s + (end_s - start_s) * random();
  const arrived = new Promise((resolve) => {
    posesAt = (time) => { if (time <= target + 1e-9 && time > target - 1) resolve(); };
  });
  const begin = performance.now();
  await json(`${address}/seek`, {
    method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ time_s: target }) });
  await arrived;
  times.push(performance.now() - begin);
}
times.sort((a, b) => a - b);
const at = (share) => Number(times[Math.min(times.length - 1, Math.floor(share * times.length))].toFixed(1));
console.log(JSON.stringify({ recording_s: end_s - start_s, seeks: times.length,
  p50_ms: at(0.5), p95_ms: at(0.95), worst_ms: at(1) }));
process.exit(0);
