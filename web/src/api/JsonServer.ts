// Requests JSON from the server, relative to the page's address. Every call ends with an answer, an
// error sentence of the server, or a timeout.
import { textOr } from "./json";

// The server has refused a request. `message` is the server's sentence. `field` names the field of
// the request that caused the refusal (empty: no particular field).
export class ApiError extends Error {
  constructor(
    readonly httpStatus: number,
    sentence: string,
    readonly field = "",
  ) {
    super(sentence);
  }
}

// Whether the server requires a token and got no token, or a wrong token.
export function needsToken(error: unknown): boolean {
  return error instanceof ApiError && (error.httpStatus === 401 || error.httpStatus === 403);
}

const TIMEOUT_MS = 10_000;

export class JsonServer {
  private base: string;

  constructor(
    private readonly root: string,
    private readonly fetchPage: typeof fetch = (input, init) => fetch(input, init),
  ) {
    this.base = root;
  }

  url(path: string): string {
    return new URL(path, this.base).href;
  }

  // Sets the path below the root to which the paths of all later requests are relative. If this
  // path is empty, the paths of requests are relative to the root.
  moveTo(path: string): void {
    this.base = new URL(path, this.root).href;
  }

  get(path: string, timeoutMs = TIMEOUT_MS): Promise<unknown> {
    return this.request(path, { signal: AbortSignal.timeout(timeoutMs) });
  }

  post(path: string, body: object, timeoutMs = TIMEOUT_MS): Promise<unknown> {
    return this.request(path, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify(body),
      signal: AbortSignal.timeout(timeoutMs),
    });
  }

  // Requests a path, and returns the response as it is.
  fetch(path: string, signal: AbortSignal): Promise<Response> {
    return this.fetchPage(this.url(path), { signal });
  }

  // Sends the content of a file.
  put(path: string, content: Blob, timeoutMs: number): Promise<unknown> {
    return this.request(path, { method: "PUT", body: content, signal: AbortSignal.timeout(timeoutMs) });
  }

  delete(path: string, timeoutMs = TIMEOUT_MS): Promise<unknown> {
    return this.request(path, { method: "DELETE", signal: AbortSignal.timeout(timeoutMs) });
  }

  private async request(path: string, init: RequestInit): Promise<unknown> {
    const response = await this.fetchPage(this.url(path), init).catch((error: unknown) => {
      throw new Error(reasonOf(error));
    });
    const answer: unknown = await response.json().catch(() => null);
    if (response.ok) return answer;
    const refusal = answer as { error?: unknown; field?: unknown } | null;
    const sentence = textOr(refusal?.error, "") || `The server returned an error: ${response.status}.`;
    throw new ApiError(response.status, sentence, textOr(refusal?.field, ""));
  }
}

export function simulationPath(name: string): string {
  return `api/simulations/${encodeURIComponent(name)}`;
}

function reasonOf(error: unknown): string {
  const name = (error as { name?: string }).name;
  if (name === "TimeoutError") return "The server did not respond in time. Check that gsv still runs.";
  return "The server cannot be reached. Check that gsv still runs.";
}
