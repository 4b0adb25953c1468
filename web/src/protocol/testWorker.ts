// A worker for tests, which answers when the test tells it to.
import type { DecodeAnswer, DecodeRequest } from "./WorkerDecoder";

export class TestWorker {
  readonly requests: DecodeRequest[] = [];
  readonly transferred: Transferable[][] = [];
  isTerminated = false;
  onmessage: ((event: { data: DecodeAnswer }) => void) | null = null;
  onerror: (() => void) | null = null;
  onmessageerror: (() => void) | null = null;

  postMessage(request: DecodeRequest, transferred: Transferable[]): void {
    this.requests.push(request);
    this.transferred.push(transferred);
  }

  // Sends an answer to the page.
  send(answer: DecodeAnswer): void {
    this.onmessage?.({ data: answer });
  }

  // Answers the newest request.
  answer(content: unknown): void {
    this.send({ number: this.requests.at(-1)!.number, content });
  }

  terminate(): void {
    this.isTerminated = true;
  }

  get asWorker(): Worker {
    return this as unknown as Worker;
  }
}
