// Tests the development server with software by others: Foxglove's own client, its reader of
// message definitions and its CDR decoder. The robots drive by a formula (see
// testing/scripted_simulation.h), so every value follows from the time stamp of its message.
//
//   node interop_test.mjs MODULES_ROOT GATEWAY_DEV_SERVER
//
// MODULES_ROOT is the package.json whose node_modules contain these packages.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createRequire } from "node:module";
import path from "node:path";
import readline from "node:readline";

const [modulesRoot, devServer] = process.argv.slice(2);
const require = createRequire(path.resolve(modulesRoot));
const { parse } = require("@foxglove/rosmsg");
const { MessageReader, MessageWriter } = require("@foxglove/rosmsg2-serialization");
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { WebSocket } = require("ws");

const TURN_RATE = 0.2;
const SONAR_X = 0.25;
const CAPABILITIES = ["time", "connectionGraph", "services", "parameters", "parametersSubscribe", "gsvViews"];
const TOPICS = ["/clock", "/gsv/commands", "/gsv/contacts", "/gsv/poses", "/tf", "/tf_static", "/gsv/status", "/gsv/events", "/gsv/beams",
  "/robot_0/front_sonar", "/robot_0/lidar", "/robot_0/camera"];

const seconds = (stamp) => stamp.sec + stamp.nsec * 1e-9;
const near = (actual, expected, what) =>
  assert.ok(Math.abs(actual - expected) < 1e-6, `${what}: ${actual} instead of ${expected}`);

// A connection that remembers the first decoded message of each topic.
class Watcher {
  constructor(url, subprotocol) {
    this.first = new Map();
    this.waiting = new Map();
    this.serverTime = 0n;
    const channels = new Map();
    const ws = new WebSocket(url, [subprotocol]);
    const client = new FoxgloveClient({ ws });
    this.info = new Promise((resolve) => client.on("serverInfo", resolve));
    client.on("error", (error) => { throw error; });
    client.on("time", ({ timestamp }) => { this.serverTime = timestamp; });
    this.services = new Promise((resolve) => client.on("advertiseServices", resolve));
    client.on("status", ({ message }) => { this.onStatus(message); });
    client.on("advertise", (list) => {
      for (const channel of list) {
        if (!TOPICS.includes(channel.topic)) continue;
        assert.equal(channel.encoding, "cdr");
        assert.equal(channel.schemaEncoding, "ros2msg");
        const reader = new MessageReader(parse(channel.schema, { ros2: true }));
        channels.set(client.subscribe(channel.id), { topic: channel.topic, reader });
      }
    });
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const { topic, reader } = channels.get(subscriptionId);
      if (this.first.has(topic)) return;
      this.first.set(topic, { timestamp, message: reader.readMessage(data) });
      this.waiting.get(topic)?.();
    });
    this.client = client;
    this.ws = ws;
  }

  onStatus(message) {
    throw new Error(message);
  }

  // Waits for the next event with that name.
  next(name) {
    return new Promise((resolve) => {
      const once = (event) => {
        this.client.off(name, once);
        resolve(event);
      };
      this.client.on(name, once);
    });
  }

  // Calls a service as its advertisement describes it, and returns the decoded response.
  async call(name, request = {}) {
    const service = (await this.services).find((each) => each.name === name);
    assert.equal(service.request.encoding, "cdr");
    assert.equal(service.response.schemaEncoding, "ros2msg");
    const definition = parse(service.request.schema, { ros2: true });
    const response = this.next("serviceCallResponse");
    this.client.sendServiceCallRequest({
      serviceId: service.id, callId: 7, encoding: "cdr", data: new MessageWriter(definition).writeMessage(request) });
    const { serviceId, callId, encoding, data } = await response;
    assert.deepEqual([serviceId, callId, encoding], [service.id, 7, "cdr"]);
    return new MessageReader(parse(service.response.schema, { ros2: true })).readMessage(data);
  }

  async message(topic) {
    if (!this.first.has(topic)) await new Promise((resolve) => this.waiting.set(topic, resolve));
    return this.first.get(topic);
  }

  close() {
    this.client.close();
    return once(this.ws, "close");
  }
}

function robotPose(time) {
  const angle = TURN_RATE * time;
  return { x: Math.cos(angle), y: Math.sin(angle), yaw: angle + Math.PI / 2 };
}

async function checkServices(watcher, api) {
  const status = async () => (await fetch(api)).json();
  assert.deepEqual(await watcher.call("/gsv/pause"), { success: true, message: "" });
  const { step } = await status();
  assert.equal((await watcher.call("/gsv/step", { count: 3n })).success, true);
  assert.equal((await status()).step, step + 3);
  assert.equal((await watcher.call("/gsv/resume")).success, true);
  const refused = await watcher.call("/gsv/start");
  assert.equal(refused.success, false);
  assert.match(refused.message, /cannot be started/);

  const failure = watcher.next("serviceCallFailure");
  watcher.client.sendServiceCallRequest({ serviceId: 99, callId: 8, encoding: "cdr", data: new Uint8Array(4) });
  const { serviceId, callId, message } = await failure;
  assert.deepEqual([serviceId, callId, message], [99, 8, "there is no service 99"]);
}

async function checkParameters(watcher) {
  const values = watcher.next("parameterValues");
  watcher.client.getParameters(["/gsv/name", "/gsv/step_size_s"], "a");
  const { parameters, id } = await values;
  assert.equal(id, "a");
  assert.deepEqual(parameters, [{ name: "/gsv/name", value: "arena" },
    { name: "/gsv/step_size_s", value: 0.01, type: "float64" }]);
  const set = watcher.next("parameterValues");
  watcher.client.setParameters([{ name: "/gsv/real_time_factor", value: 2.5, type: "float64" }], "c");
  assert.equal((await set).parameters[0].value, 2.5);
  let complaint = "";
  watcher.onStatus = (message) => { complaint = message; };
  const again = watcher.next("parameterValues");
  watcher.client.setParameters([{ name: "/gsv/name", value: "other" }], "b");
  assert.equal((await again).parameters[0].value, "arena");
  assert.match(complaint, /cannot be changed/);
  watcher.client.subscribeParameterUpdates(["/gsv/phase"]);
  const paused = watcher.next("parameterValues");
  await watcher.call("/gsv/pause");
  assert.deepEqual((await paused).parameters, [{ name: "/gsv/phase", value: "paused" }]);
  await watcher.call("/gsv/resume");
}

async function checkGraph(watcher) {
  const update = watcher.next("connectionGraphUpdate");
  watcher.client.subscribeConnectionGraph();
  const graph = await update;
  const published = new Map(graph.publishedTopics.map(({ name, publisherIds }) => [name, publisherIds]));
  assert.deepEqual(published.get("/gsv/poses"), ["gsv"]);
  assert.deepEqual(published.get("/robot_0/lidar"), ["robot_0"]);
  assert.ok(published.get("/gsv/commands").includes("robot_1"));
  const subscribed = new Map(graph.subscribedTopics.map(({ name, subscriberIds }) => [name, subscriberIds]));
  assert.equal(subscribed.get("/robot_0/lidar").length, 1);
  assert.deepEqual(graph.advertisedServices.find(({ name }) => name === "/gsv/stop").providerIds, ["gsv"]);
  watcher.client.unsubscribeConnectionGraph();
}

async function check(origin, subprotocol) {
  const watcher = new Watcher(`${origin.replace("http", "ws")}ws?simulation=arena`, subprotocol);
  const info = await watcher.info;
  assert.equal(watcher.ws.protocol, subprotocol);
  assert.deepEqual(info.capabilities, CAPABILITIES);
  assert.deepEqual(info.supportedEncodings, ["cdr"]);

  const scene = await (await fetch(`${origin}api/simulations/arena/scene`)).json();
  const names = scene.poses.map(({ body, link }) => [scene.bodies[body].name, link]);
  const poses = await watcher.message("/gsv/poses");
  assert.equal(poses.message.layout_version, scene.layout_version);
  assert.equal(poses.message.poses.length, 7 * names.length);
  const entry = names.findIndex(([name, link]) => name === "robot_0" && link === null);
  const expected = robotPose(seconds(poses.message.stamp));
  near(poses.message.poses[7 * entry], expected.x, "x of robot_0");
  near(poses.message.poses[7 * entry + 1], expected.y, "y of robot_0");
  near(Number(poses.timestamp) * 1e-9, seconds(poses.message.stamp), "time of the poses");

  const transforms = (await watcher.message("/tf")).message.transforms;
  const base = transforms.find((t) => t.child_frame_id === "robot_0/base_link");
  assert.equal(base.header.frame_id, "map");
  near(base.transform.translation.x, robotPose(seconds(base.header.stamp)).x, "x in /tf");
  const fixed = (await watcher.message("/tf_static")).message.transforms;
  near(fixed.find((t) => t.child_frame_id === "robot_0/front_sonar").transform.translation.x, SONAR_X,
    "x of the sonar");

  const beams = (await watcher.message("/gsv/beams")).message.markers.find((m) => m.ns === "robot_0");
  assert.equal(beams.type, 5);
  assert.ok(beams.points.length >= 4 && beams.points.length % 2 === 0);

  const sonar = (await watcher.message("/robot_0/front_sonar")).message;
  assert.equal(sonar.header.frame_id, "robot_0/front_sonar");
  assert.ok(sonar.range > 0 && sonar.range <= sonar.max_range);
  assert.ok((await watcher.message("/robot_0/lidar")).message.ranges.length > 0);
  const picture = (await watcher.message("/robot_0/camera")).message;
  assert.equal(picture.format, "jpeg");
  assert.deepEqual([...picture.data.slice(0, 3)], [0xff, 0xd8, 0xff]);

  const command = (await watcher.message("/gsv/commands")).message;
  assert.match(command.robot, /^robot_[0-2]$/);
  near(command.angular_rad_s, TURN_RATE, "turning rate");

  const contact = await watcher.message("/gsv/contacts");
  assert.deepEqual([contact.message.first, contact.message.second], ["robot_0", "avatar"]);
  near(contact.message.point.x, robotPose(seconds(contact.message.stamp)).x, "where they met");

  const status = (await watcher.message("/gsv/status")).message;
  assert.equal(status.state, "running");
  assert.deepEqual(status.robots.map((robot) => robot.name), ["avatar", "robot_0", "robot_1", "robot_2"]);
  assert.equal((await watcher.message("/gsv/events")).message.event, "started");
  const clock = await watcher.message("/clock");
  assert.equal(BigInt(clock.message.clock.sec) * 1000000000n + BigInt(clock.message.clock.nsec),
    clock.timestamp);
  if (watcher.serverTime === 0n) await new Promise((resolve) => watcher.client.on("time", resolve));
  assert.ok(watcher.serverTime > 0n);
  await checkGraph(watcher);
  await checkServices(watcher, `${origin}api/simulations/arena`);
  await checkParameters(watcher);
  await watcher.close();
}

const server = spawn(devServer, ["--port", "0"], { stdio: ["ignore", "pipe", "inherit"] });
try {
  const [origin] = await once(readline.createInterface({ input: server.stdout }), "line");
  for (const subprotocol of ["foxglove.sdk.v1", "foxglove.websocket.v1"]) {
    await check(origin, subprotocol);
    console.log(`${subprotocol}: ${TOPICS.length} topics decoded, services, parameters and graph used`);
  }
} finally {
  server.kill("SIGTERM");
  const [code] = await once(server, "exit");
  assert.equal(code, 0, "the server ends cleanly");
}
