// Reads the messages of a recording with third-party code, as the expected content of a replay.
import fs from "node:fs";
import { requireFromWeb } from "./browser.mjs";

const { McapIndexedReader } = requireFromWeb("@mcap/core");
const { parse } = requireFromWeb("@foxglove/rosmsg");
const { MessageReader } = requireFromWeb("@foxglove/rosmsg2-serialization");
const fzstd = requireFromWeb("fzstd");

// Returns [{time, poses}], ordered by time. `poses` has seven numbers for each body, in the order
// of the scene.
export async function readPoses(file) {
  return (await readTopic(file, "/gsv/poses")).map(({ time, message }) => ({ time, poses: message.poses }));
}

// Returns [{time, message}], ordered by time.
export async function readTopic(file, topic) {
  const bytes = fs.readFileSync(file);
  const reader = await McapIndexedReader.Initialize({
    readable: {
      size: async () => BigInt(bytes.length),
      read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
    },
    decompressHandlers: { zstd: (data) => fzstd.decompress(data) },
  });
  const channel = [...reader.channelsById.values()].find((each) => each.topic === topic);
  const schema = reader.schemasById.get(channel.schemaId);
  const decoder = new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true }));
  const messages = [];
  for await (const { logTime, data } of reader.readMessages({ topics: [topic] })) {
    messages.push({ time: Number(logTime) / 1e9, message: decoder.readMessage(data) });
  }
  return messages;
}

// Returns the newest entry that is not after `time`.
export function posesAt(messages, time) {
  return messages.findLast((message) => message.time <= time + 1e-9);
}
