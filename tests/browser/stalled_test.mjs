// Tests a tab whose machine stops for a while, as when a laptop sleeps, while other viewers receive
// updates. The others receive updates as before, and the tab catches up, or connects again and reports
// this.
//
// GSV_STALL_S  duration of the stop (5; `make soak`: 180, which is longer than a server waits for
// it)
import assert from "node:assert/strict";
import fs from "node:fs";
import process from "node:process";
import { after, before, test } from "node:test";
import { openBrowser, openPage, requireFromWeb, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { until } from "./viewing.mjs";

const { WebSocket } = requireFromWeb("ws");

const STALL_S = Number(process.env.GSV_STALL_S ?? 5);
const LONGEST_WAIT_S = 60; // the server disconnects a viewer that answers no ping for this time
const OTHERS = 20;
const RUN = ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander", "--in-process"];
const POSES = 1; // id of the subscription

let server;
let browsers = [];
let stalled;
let other;
let watchers = [];

before(async () => {
  server = await startServer(RUN);
  browsers = await Promise.all([openBrowser({ width: 900, height: 600 }), openBrowser({ width: 900, height: 600 })]);
  [stalled, other] = await Promise.all(browsers.map((browser) => openPage(browser, server.url)));
  for (const { page } of [stalled, other]) await waitUntilDrawn(page);
  watchers = await Promise.all(Array.from({ length: OTHERS }, watch));
});

after(async () => {
  for (const { socket } of watchers) socket.terminate();
  for (const browser of browsers) await browser.close();
  await server?.stop();
});

// Returns a viewer without a page that subscribes to the poses. `times` has the times of its
// updates.
async function watch() {
  const socket = new WebSocket(`${server.url.replace("http", "ws")}ws`, ["foxglove.sdk.v1"]);
  const watcher = { socket, times: [], dropped: null };
  socket.on("message", (data, isBinary) => {
    if (isBinary) {
      if (data[0] === 1 && data.readUInt32LE(1) === POSES) watcher.times.push(data.readBigUInt64LE(5));
      return;
    }
    const message = JSON.parse(String(data));
    if (message.op === "parameterValues") watcher.dropped = message.parameters[0].value;
    const poses = message.op === "advertise" && message.channels.find(({ topic }) => topic === "/gsv/poses");
    if (poses) socket.send(JSON.stringify({ op: "subscribe", subscriptions: [{ id: POSES, channelId: poses.id }] }));
  });
  await until(() => watcher.times.length > 0 || later(), "an update");
  return watcher;
}

// Lets messages arrive between two checks.
const later = () => new Promise((resolve) => setImmediate(() => resolve(false)));

// The processes that render a browser's pages.
function renderersOf({ profile }) {
  const processes = fs.readdirSync("/proc").filter((name) => /^\d+$/.test(name)).flatMap((pid) => {
    try {
      const command = fs.readFileSync(`/proc/${pid}/cmdline`, "latin1").replaceAll("\0", " ");
      const stat = fs.readFileSync(`/proc/${pid}/stat`, "latin1");
      return [{ pid: Number(pid), parent: Number(stat.slice(stat.lastIndexOf(")") + 2).split(" ")[1]), command }];
    } catch {
      return []; // the process has ended
    }
  });
  const main = processes.find(({ command }) => command.includes(`--user-data-dir=${profile}`) && !command.includes("--type="));
  assert.ok(main, "the browser's process");
  const isBelow = ({ parent }) => parent === main.pid || processes.some((each) => each.pid === parent && isBelow(each));
  const renderers = processes.filter((each) => each.command.includes("--type=renderer") && isBelow(each));
  assert.ok(renderers.length > 0, "the tab's process");
  return renderers.map(({ pid }) => pid);
}

// Waits until a watcher has received an update of this instant.
function reached({ socket, times }, time_s) {
  return new Promise((resolve, reject) => {
    socket.on("message", () => Number(times.at(-1)) >= time_s * 1e9 && resolve());
    socket.on("close", () => reject(new Error("the watcher was disconnected")));
  });
}

const timeNow = async () => (await (await fetch(`${server.url}api/simulations`)).json())[0].time_s;
const simulated = (page) => page.evaluate(() => window.gsv.time);

test(`a tab stands still for ${STALL_S} s: others receive updates as before, and it catches up`, { timeout: 1000 * (STALL_S + 300) }, async () => {
  const again = stalled.page.getByText("Connected again.").waitFor({ timeout: 1000 * (STALL_S + 120) });
  again.catch(() => {}); // below, the test waits for this notice only if it must appear
  const pids = renderersOf(browsers[0]);
  const began = await timeNow();
  const counts = watchers.map(({ times }) => times.length);
  for (const pid of pids) process.kill(pid, "SIGSTOP");
  try {
    await reached(watchers[0], began + STALL_S); // simulated time, which equals wall-clock time
  } finally {
    for (const pid of pids) process.kill(pid, "SIGCONT");
  }
  const ended = await timeNow();
  for (const [i, { times }] of watchers.entries()) {
    assert.ok(times.length > counts[i], "updates went on");
    assert.ok(times.every((time, k) => k === 0 || time >= times[k - 1]), "in their order");
  }
  await until(async () => (await simulated(other.page)) >= ended, "the other page's next instant");
  await until(async () => (await simulated(stalled.page)) >= ended, "the stalled page's next instant");
  if (STALL_S > 2 * LONGEST_WAIT_S) await again;
  for (const { socket } of watchers) {
    socket.send(JSON.stringify({ op: "getParameters", parameterNames: ["/gsv/dropped_updates"], id: "d" }));
  }
  await until(() => watchers.every(({ dropped }) => dropped !== null) || later(), "what was dropped");
  // On an idle machine, the other viewers lose nothing. If this process gets too little processor time, the server
  // may replace some states with newer ones.
  for (const [i, { dropped, times }] of watchers.entries()) {
    assert.ok(dropped < times.length - counts[i], `${dropped} updates were dropped, ${times.length - counts[i]} came`);
  }
  assert.equal(await other.page.getByText("Connection lost").isVisible(), false);
  assert.deepEqual(other.faults, []);
});
