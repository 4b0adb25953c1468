// Requests the data that the page shows first, while the rest of the page's script is still being
// loaded. Each answer is used once, for the page's own request of the same address.
import { simulationPath } from "./JsonServer";

// Maximum age of an early answer. An older answer is not used.
const LONGEST_AGE_MS = 5000;

interface Begun {
  at: number; // ms
  answer: Promise<Response>;
}

export class EarlyRequests {
  private readonly begun = new Map<string, Begun>(); // requests that have begun, by their address

  constructor(
    private readonly root: string,
    private readonly fetchPage: typeof fetch,
    private readonly now: () => number = () => performance.now(),
  ) {}

  // Requests the list of simulations. Then requests the status, the scene and the models of the
  // simulation `wanted`, or of the first simulation if `wanted` is null. Errors are ignored here,
  // because the page reports them when it repeats a request.
  async begin(wanted: string | null): Promise<void> {
    try {
      const simulations = (await this.ask("api/simulations")) as { name: string }[];
      const chosen = simulations.find(({ name }) => name === wanted) ?? simulations[0];
      if (chosen === undefined) return;
      const path = simulationPath(chosen.name);
      this.ask(path).catch(() => {});
      const { bodies } = (await this.ask(`${path}/scene`)) as { bodies: { model: string }[] };
      // Puts the models into the browser's cache, from which the page gets them later. The server
      // lets browsers cache models, because a model never changes.
      for (const model of new Set(bodies.map((body) => body.model))) {
        this.fetchPage(this.url(`api/models/${encodeURIComponent(model)}.glb`)).catch(() => {});
      }
    } catch {
      // Ignored: the page itself sends the failed request again. So the page only opens more
      // slowly.
    }
  }

  // Works like fetch(), but returns the early answer if there is one for this address.
  fetch: typeof fetch = async (input, init) => {
    const early = this.take(String(input), init?.method);
    return early ?? this.fetchPage(input, init);
  };

  private take(address: string, method = "GET"): Promise<Response> | null {
    const found = this.begun.get(address);
    this.begun.delete(address);
    if (found === undefined || method !== "GET" || this.now() - found.at > LONGEST_AGE_MS) return null;
    return found.answer.catch(() => this.fetchPage(address));
  }

  private async ask(path: string): Promise<unknown> {
    const address = this.url(path);
    const answer = this.fetchPage(address).then(readOnce);
    answer.catch(() => {});
    this.begun.set(address, { at: this.now(), answer });
    return (await answer).json();
  }

  private url(path: string): string {
    return new URL(path, this.root).href;
  }
}

// Reads the body of a response only once. After that, response.json() can be called several times:
// by begin() and by the page.
async function readOnce(response: Response): Promise<Response> {
  const json: Promise<unknown> = response.json();
  json.catch(() => {});
  return Object.defineProperty(response, "json", { value: () => json });
}
