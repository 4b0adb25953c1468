// A worker that decodes the messages which WorkerDecoder sends to it.
import { MessageDecoders } from "./MessageDecoder";
import type { DecodeAnswer, DecodeRequest } from "./WorkerDecoder";
import { buffersIn } from "./buffersIn";
import { inForm } from "./forms";

const decoders = new MessageDecoders();

onmessage = async ({ data: { number, channel, payload, form } }: MessageEvent<DecodeRequest>) => {
  try {
    const content = await inForm(form, decoders.decoderOf(channel)(payload));
    answer({ number, content }, buffersIn(content));
  } catch (error) {
    answer({ number, problem: error instanceof Error ? error.message : String(error) });
  }
};

function answer(message: DecodeAnswer, transfer: ArrayBuffer[] = []): void {
  postMessage(message, { transfer });
}

answer({ isReady: true });
