// Reads the server's metrics from /metrics, in Prometheus' text format 0.0.4 (docs/monitoring.md).
const TIMEOUT_MS = 5000;

// Metrics by name. A metric with labels has the name "name{label=\"value\"}".
export type ServerFigures = ReadonlyMap<string, number>;

export class MetricsApi {
  // `base` is the address of the page.
  constructor(
    private readonly base: string,
    private readonly fetchPage: typeof fetch,
  ) {}

  async figures(): Promise<ServerFigures> {
    const signal = AbortSignal.timeout(TIMEOUT_MS);
    const answer = await this.fetchPage(new URL("metrics", this.base).href, { signal });
    if (!answer.ok) throw new Error(`The server returned an error: ${answer.status}.`);
    return parseFigures(await answer.text());
  }
}

export function parseFigures(text: string): ServerFigures {
  const figures = new Map<string, number>();
  for (const line of text.split("\n")) {
    const at = line.lastIndexOf(" ");
    if (line.startsWith("#") || at <= 0) continue;
    const value = Number(line.slice(at + 1));
    if (!Number.isNaN(value)) figures.set(line.slice(0, at), value);
  }
  return figures;
}
