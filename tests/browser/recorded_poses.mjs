// The poses in a recording, read by other people's code: what a replay has to show.
import fs from "node:fs";
import { requireFromWeb } from "./browser.mjs";

const { McapIndexedReader } = requireFromWeb("@mcap/core");
const { parse } = requireFromWeb("@foxglove/rosmsg");
const { MessageReader } = requireFromWeb("@foxglove/rosmsg2-serialization");
const fzstd = requireFromWeb("fzstd");

const TOPIC = "/gsv/poses";

// [{time, poses}], by time; `poses` are seven numbers each, as the scene lists them.
export async function readPoses(file) {
  const bytes = fs.readFileSync(file);
  const reader = await McapIndexedReader.Initialize({
    readable: {
      size: async () => BigInt(bytes.length),
      read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
    },
    decompressHandlers: { zstd: (data) => fzstd.decompress(data) },
  });
  const channel = [...reader.channelsById.values()].find(({ topic }) => topic === TOPIC);
  const schema = reader.schemasById.get(channel.schemaId);
  const decoder = new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true }));
  const messages = [];
  for await (const { logTime, data } of reader.readMessages({ topics: [TOPIC] })) {
    messages.push({ time: Number(logTime) / 1e9, poses: decoder.readMessage(data).poses });
  }
  return messages;
}

// The newest that is not after `time`.
export function posesAt(messages, time) {
  return messages.findLast((message) => message.time <= time + 1e-9);
}
