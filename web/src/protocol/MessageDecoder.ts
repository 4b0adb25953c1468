// Decodes ROS 2 messages in CDR according to the definition in their channel.
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

// A channel that the server advertises: a topic with its type.
export interface Channel {
  id: number;
  topic: string;
  encoding: string;
  schemaName: string;
  schema: string;
  schemaEncoding?: string;
}

export type Decoder = (payload: DataView) => unknown;

// Channels of one type share a decoder. Throws if the channel's encoding or definition is not
// supported.
export class MessageDecoders {
  private readonly bySchema = new Map<string, Decoder>();

  decoderOf(channel: Channel): Decoder {
    const key = `${channel.schemaName}\n${channel.schema}`;
    let decoder = this.bySchema.get(key);
    if (!decoder) {
      decoder = makeDecoder(channel);
      this.bySchema.set(key, decoder);
    }
    return decoder;
  }
}

function makeDecoder(channel: Channel): Decoder {
  if (channel.encoding !== "cdr") {
    throw new Error(`${channel.topic}: expected messages in cdr, found ${channel.encoding}`);
  }
  const schemaEncoding = channel.schemaEncoding ?? "ros2msg";
  if (schemaEncoding !== "ros2msg") {
    throw new Error(`${channel.topic}: expected a definition in ros2msg, found ${schemaEncoding}`);
  }
  const reader = new MessageReader(parse(channel.schema, { ros2: true }));
  return (payload) => reader.readMessage(payload);
}
