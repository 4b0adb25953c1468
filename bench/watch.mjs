#!/usr/bin/env node
// Measures the load of viewers on a server: its processor time, memory and late steps. VIEWERS
// clients subscribe to the topics of the viewer, and STALLED of them stop reading.
//
//   bench/watch.mjs PACKAGE_JSON URL PID [VIEWERS] [STALLED] [SECONDS]
//
// PACKAGE_JSON is beside the node_modules with `ws` (web/package.json). URL and PID are the address
// and the process of `gsv run`, `gsv serve` or gateway_dev_server. Prints one JSON object.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [packageJson, url, pid, viewers = "20", stalled = "0", seconds = "20"] = process.argv.slice(2);
const { WebSocket } = createRequire(path.resolve(packageJson))("ws");
const TOPICS = ["/gsv/poses", "/gsv/status", "/gsv/events"];
const TICKS = 100; // clock ticks per second in /proc/PID/stat

const processorTime = () => {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
  return (Number(fields[11]) + Number(fields[12])) / TICKS;
};
const memory = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]) / 1024;
const status = async () => {
  const [first] = await (await fetch(`${url}api/simulations`)).json();
  return (await fetch(`${url}api/simulations/${first.name}`)).json();
};
const pause = (s) => new Promise((resolve) => setTimeout(resolve, s * 1000));

class Watcher {
  messages = 0;
  bytes = 0;

  constructor(isStalled) {
    this.ws = new WebSocket(`${url.replace("http", "ws")}ws`, ["foxglove.sdk.v1"], { perMessageDeflate: false });
    this.ready = new Promise((resolve) => {
      this.ws.on("message", (data, isBinary) => {
        if (isBinary && data[0] === 1) {
          this.messages += 1;
          this.bytes += data.length;
        }
        if (isBinary) return;
        const message = JSON.parse(data.toString());
        if (message.op !== "advertise" || this.subscribed) return;
        const subscriptions = message.channels.filter(({ topic }) => TOPICS.includes(topic))
          .map(({ id }, index) => ({ id: index + 1, channelId: id }));
        if (subscriptions.length < TOPICS.length) return;
        this.subscribed = true;
        this.ws.send(JSON.stringify({ op: "subscribe", subscriptions }));
        if (isStalled) this.ws.pause();
        resolve();
      });
    });
  }
}

async function measure() {
  const before = { status: await status(), cpu: processorTime(), wall: performance.now() };
  await pause(Number(seconds));
  const wall = (performance.now() - before.wall) / 1000;
  const now = await status();
  return {
    cores: (processorTime() - before.cpu) / wall,
    rss_mib: memory(),
    steps: now.step - before.status.step,
    late_steps: now.late_steps - before.status.late_steps,
    factor: (now.time_s - before.status.time_s) / wall,
    wall_s: wall,
  };
}

const alone = await measure();
const readers = Array.from({ length: Number(viewers) }, () => new Watcher(false));
const others = Array.from({ length: Number(stalled) }, () => new Watcher(true));
await Promise.all([...readers, ...others].map(({ ready }) => ready));
await pause(2);
for (const reader of readers) reader.messages = reader.bytes = 0;
const watched = await measure();
const each = (pick) => readers.reduce((sum, reader) => sum + pick(reader), 0) / Math.max(1, readers.length) / watched.wall_s;
console.log(JSON.stringify({
  robots: (await status()).robots.length,
  viewers: readers.length,
  stalled: others.length,
  alone,
  watched,
  cores_a_viewer: (watched.cores - alone.cores) / Math.max(1, readers.length),
  messages_a_second_and_viewer: each(({ messages }) => messages),
  mib_a_second_and_viewer: each(({ bytes }) => bytes) / 1048576,
}, null, 2));
process.exit(0);
