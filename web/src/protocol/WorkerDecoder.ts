// Decodes messages for the readers that want only the newest one. Large messages whose form takes
// long to compute are decoded in a worker (ADR 119). All others are decoded here, because the way to
// the worker and back would take longer. If there is no worker, all messages are decoded here.
import type { Form } from "./forms";
import { inForm } from "./forms";
import type { Channel } from "./MessageDecoder";
import { MessageDecoders } from "./MessageDecoder";

const SMALLEST_BYTES = 16 << 10; // smallest message that is decoded in the worker

// The worker counts as lost if a message has no answer after two waits of this length. A page that
// was busy or asleep sees the first wait end late. The second one gives it time to take an answer
// that came meanwhile.
const WAIT_MS = 5_000;

// The messages between the page and the worker.
export interface DecodeRequest {
  number: number;
  channel: Channel;
  payload: DataView;
  form: Form;
}
export type DecodeAnswer =
  | { isReady: true } // the first message: the worker has started
  | { number: number; content: unknown }
  | { number: number; problem: string };

// Reports that the worker has ended without an answer, so the message is lost.
export class WorkerLost extends Error {}

interface Question {
  resolve(content: unknown): void;
  reject(error: Error): void;
  timer: ReturnType<typeof setTimeout>;
}

export class WorkerDecoder {
  private readonly decoders = new MessageDecoders();
  private worker: Worker | null = null;
  private state: "not started" | "starting" | "ready" | "lost" = "not started";
  private readonly questions = new Map<number, Question>(); // messages in the worker, by their number
  private nextNumber = 1;

  // `start` returns a new worker; null if the browser has none. It may throw an error.
  constructor(private readonly start: () => Worker | null = startWorker) {}

  // Returns a message in a form, or a promise of it. The promise is rejected with WorkerLost if the
  // worker ends before its answer. If `isShared` is false, nobody else reads the payload, so its
  // memory is passed to the worker.
  decode(channel: Channel, payload: DataView, form: Form, isShared: boolean): unknown {
    const isLarge = form !== "message" && payload.byteLength >= SMALLEST_BYTES;
    if (isLarge && this.isReady()) return this.ask(channel, isShared ? copyOf(payload) : payload, form);
    return inForm(form, this.decoders.decoderOf(channel)(payload));
  }

  // Ends the worker. Later messages start another one.
  close(): void {
    this.end("not started");
  }

  // The first call starts the worker.
  private isReady(): boolean {
    if (this.state === "not started") this.begin();
    return this.state === "ready";
  }

  private begin(): void {
    this.state = "starting";
    try {
      this.worker = this.start();
    } catch {
      this.worker = null; // some browsers forbid it
    }
    if (!this.worker) return this.end("lost");
    this.worker.onmessage = ({ data }: MessageEvent<DecodeAnswer>) => this.take(data);
    this.worker.onerror = this.worker.onmessageerror = () => this.end("lost");
  }

  private ask(channel: Channel, payload: DataView, form: Form): Promise<unknown> {
    const number = this.nextNumber++;
    const request: DecodeRequest = { number, channel, payload, form };
    return new Promise((resolve, reject) => {
      const question: Question = { resolve, reject, timer: setTimeout(() => this.waitAgain(question), WAIT_MS) };
      this.questions.set(number, question);
      this.worker!.postMessage(request, [payload.buffer as ArrayBuffer]);
    });
  }

  private waitAgain(question: Question): void {
    question.timer = setTimeout(() => this.end("lost"), WAIT_MS);
  }

  private take(answer: DecodeAnswer): void {
    if ("isReady" in answer) return void (this.state = "ready");
    const question = this.questions.get(answer.number);
    if (!question) return;
    this.questions.delete(answer.number);
    clearTimeout(question.timer);
    if ("problem" in answer) question.reject(new Error(answer.problem));
    else question.resolve(answer.content);
  }

  private end(state: "not started" | "lost"): void {
    this.state = state;
    if (this.worker) this.worker.onmessage = this.worker.onerror = this.worker.onmessageerror = null;
    this.worker?.terminate();
    this.worker = null;
    for (const { reject, timer } of this.questions.values()) {
      clearTimeout(timer);
      reject(new WorkerLost());
    }
    this.questions.clear();
  }
}

function startWorker(): Worker | null {
  if (typeof Worker === "undefined") return null;
  return new Worker(new URL("./decodeWorker.ts", import.meta.url), { type: "module" });
}

function copyOf({ buffer, byteOffset, byteLength }: DataView): DataView {
  return new DataView(buffer.slice(byteOffset, byteOffset + byteLength));
}
