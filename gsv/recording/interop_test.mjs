// Reads recordings of GSV with software by others: @mcap/core, by index and as a stream, and
// @foxglove/rosmsg2-serialization for the messages. Compares all checksums.
//
//   node interop_test.mjs PACKAGE_JSON WRITE_RECORDINGS DRAW_RECORDING
//
// PACKAGE_JSON is the package.json whose node_modules contain these packages. DRAW_RECORDING is
// tools/draw_recording.mjs, which uses the same readers.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";

const [packageJson, writeRecordings, drawRecording] = process.argv.slice(2);
const require = createRequire(path.resolve(packageJson));
const { crc32 } = createRequire(require.resolve("@mcap/core"))("@foxglove/crc");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const decompressHandlers = { zstd: await loadZstd() };

async function loadZstd() {
  try {
    const zstd = require("@foxglove/wasm-zstd");
    await zstd.isLoaded;
    return (bytes, size) => zstd.decompress(bytes, Number(size));
  } catch (error) {
    if (error.code !== "MODULE_NOT_FOUND") throw error;
    const fzstd = require("fzstd");
    return (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size)));
  }
}

function readable(bytes) {
  return {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => {
      assert.ok(offset + size <= BigInt(bytes.length), "a read behind the end of the file");
      return bytes.subarray(Number(offset), Number(offset + size));
    },
  };
}

// The results of each kind of reader, in one form.
class Finding {
  schemas = new Map();
  channels = new Map();
  messages = [];
  decoders = new Map();

  add(message) {
    const channel = this.channels.get(message.channelId);
    const schema = this.schemas.get(channel.schemaId);
    assert.equal(channel.messageEncoding, "cdr");
    assert.equal(schema.encoding, "ros2msg");
    if (!this.decoders.has(schema.id)) {
      const text = new TextDecoder().decode(schema.data);
      this.decoders.set(schema.id, new MessageReader(parse(text, { ros2: true })));
    }
    const content = this.decoders.get(schema.id).readMessage(message.data);
    const { logTime, publishTime, sequence } = message;
    this.messages.push({ topic: channel.topic, type: schema.name, logTime, publishTime, sequence, content });
  }
}

async function readByIndex(bytes) {
  const reader = await McapIndexedReader.Initialize({ readable: readable(bytes), decompressHandlers });
  const finding = new Finding();
  finding.schemas = reader.schemasById;
  finding.channels = reader.channelsById;
  for await (const message of reader.readMessages({ validateCrcs: true })) finding.add(message);
  const dataEnd = Number(reader.dataEndOffset);
  assert.notEqual(reader.dataSectionCrc, 0);
  assert.equal(reader.dataSectionCrc, crc32(bytes.subarray(0, dataEnd)), "the data section's CRC");
  return { reader, finding };
}

function readAsStream(bytes) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const finding = new Finding();
  const kinds = new Set();
  // The file is passed in pieces of odd sizes, as a network would deliver it.
  for (let at = 0; at < bytes.length; at += 12_345) {
    reader.append(bytes.subarray(at, at + 12_345));
    for (let record; (record = reader.nextRecord()); ) {
      kinds.add(record.type);
      if (record.type === "Schema") finding.schemas.set(record.id, record);
      if (record.type === "Channel") finding.channels.set(record.id, record);
      if (record.type === "Message") finding.add(record);
    }
  }
  assert.ok(reader.done(), "the stream ends with a footer");
  assert.ok(!kinds.has("Unknown"));
  return finding;
}

function assertInOrder(messages) {
  for (let i = 1; i < messages.length; ++i) {
    assert.ok(messages[i - 1].logTime <= messages[i].logTime, "messages are in the order of time");
  }
}

async function collect(records) {
  const all = [];
  for await (const record of records) all.push(record);
  return all;
}

async function checkWhole(bytes, info) {
  const { reader, finding } = await readByIndex(bytes);
  assert.equal(reader.header.profile, "ros2");
  assertInOrder(finding.messages);
  assert.deepEqual(readAsStream(bytes).messages, finding.messages);

  // There are 200 rounds of every type, ten milliseconds apart.
  const types = finding.channels.size;
  assert.ok(types >= 40);
  assert.equal(finding.messages.length, 200 * types);
  assert.equal(reader.statistics.messageCount, BigInt(200 * types));
  assert.equal(reader.statistics.messageStartTime, 0n);
  assert.equal(reader.statistics.messageEndTime, 1_990_000_000n);
  for (const [id, count] of reader.statistics.channelMessageCounts) {
    assert.ok(finding.channels.has(id));
    assert.equal(count, 200n);
  }
  for (const message of finding.messages) {
    assert.equal(message.logTime, BigInt(message.sequence) * 10_000_000n);
    assert.equal(message.publishTime, message.logTime);
    // By the rule of the samples, a clock's seconds are its seed mod 100, negative if odd.
    if (message.topic === "/sample_rosgraph_msgs_msg_Clock") {
      const n = message.sequence % 100;
      assert.equal(message.content.clock.sec, message.sequence % 2 === 1 ? -n : n);
    }
  }

  const [attachment] = await collect(reader.readAttachments());
  assert.equal(attachment.name, "world.sdf");
  assert.equal(new TextDecoder().decode(attachment.data), "<sdf version='1.9'/>");
  const [metadata] = await collect(reader.readMetadata());
  assert.deepEqual(Object.fromEntries(metadata.metadata), { seed: "1", command_line: "gsv run" });

  // Reads one topic from the middle on.
  const topics = ["/sample_sensor_msgs_msg_Range"];
  const late = await collect(reader.readMessages({ startTime: 1_500_000_000n, topics }));
  assert.equal(late.length, 50);

  assert.equal(info.messages, finding.messages.length);
  assert.equal(info.duration_s, 1.99);
  assert.equal(info.size_bytes, bytes.length);
  assert.deepEqual(
    info.channels.map(({ topic }) => topic),
    [...finding.channels.values()].map(({ topic }) => topic).sort(),
  );
  return finding.messages;
}

async function checkRecovered(bytes, whole) {
  const { finding } = await readByIndex(bytes);
  const { messages } = finding;
  assert.ok(messages.length > 0 && messages.length < whole.length);
  assert.deepEqual(messages, whole.slice(0, messages.length));
  assert.deepEqual(readAsStream(bytes).messages, messages);
  return messages.length;
}

// Checks the recording of a simulation: every topic can be decoded, and has the content of the run.
async function checkRun(bytes) {
  const { reader, finding } = await readByIndex(bytes);
  assertInOrder(finding.messages);
  assert.deepEqual(readAsStream(bytes).messages, finding.messages);
  const byTopic = (name) => finding.messages.filter(({ topic }) => topic === name);
  const topics = [...finding.channels.values()].map(({ topic }) => topic).sort();
  assert.deepEqual(topics, ["/clock", "/diagnostics", "/gsv/actuators", "/gsv/beams", "/gsv/commands", "/gsv/contacts",
    "/gsv/events", "/gsv/expectations", "/gsv/health", "/gsv/notes", "/gsv/output", "/gsv/poses", "/gsv/radio", "/gsv/state_hash",
    "/gsv/status", "/robot/back", "/robot/front", "/rosout", "/tf", "/tf_static"]);
  // These topics have no messages: the robot touches nothing, its behaviour prints nothing, and
  // there are no expectations.
  const silent = ["/gsv/actuators", "/gsv/contacts", "/gsv/expectations", "/gsv/notes", "/gsv/output", "/gsv/radio"];
  for (const topic of topics) assert.equal(byTopic(topic).length > 0, !silent.includes(topic), topic);
  for (const { logTime, content } of byTopic("/robot/front")) {
    assert.ok(Math.abs(content.range - (2.9 - 0.5e-9 * Number(logTime))) < 1e-6);
  }
  const last = byTopic("/tf").at(-1);
  assert.equal(last.logTime, 2_000_000_000n);
  const { translation } = last.content.transforms.find((each) => each.child_frame_id === "robot/base_link").transform;
  assert.ok(Math.abs(translation.x - 1) < 1e-9);
  assert.deepEqual(byTopic("/gsv/events").map(({ content }) => content.event), ["started", "finished"]);
  assert.deepEqual(byTopic("/rosout").map(({ content }) => content.msg), ["started", "finished"]);
  const { status } = byTopic("/diagnostics").at(-1).content;
  assert.deepEqual(status.map(({ name, level }) => [name, level]), [["simulation", 0], ["robot", 0]]);
  const scenes = (await collect(reader.readAttachments())).filter(({ name }) => name === "scene.json");
  const scene = JSON.parse(new TextDecoder().decode(scenes.at(-1).data));
  assert.deepEqual(scene.bodies.map(({ name }) => name), ["robot", "wall"]);
  return finding.messages.length;
}

function checkDrawing(file) {
  const svg = `${file}.svg`;
  execFileSync(process.execPath, [drawRecording, packageJson, file, svg]);
  const text = readFileSync(svg, "utf8");
  assert.match(text, /<text [^>]*>robot<\/text>/);
  assert.match(text, /ends of sonar beams/);
  assert.ok(!text.includes("NaN") && !text.includes("undefined"));
}

const folder = mkdtempSync(path.join(os.tmpdir(), "gsv-"));
try {
  const info = JSON.parse(execFileSync(writeRecordings, [folder]).toString());
  const whole = await checkWhole(readFileSync(path.join(folder, "whole.mcap")), info);
  const recovered = await checkRecovered(readFileSync(path.join(folder, "recovered.mcap")), whole);
  const run = await checkRun(readFileSync(path.join(folder, "run.mcap")));
  checkDrawing(path.join(folder, "run.mcap"));
  console.log(`${whole.length} messages read by index and as a stream; ${recovered} of half the file; ${run} of a run`);
} finally {
  rmSync(folder, { recursive: true });
}
