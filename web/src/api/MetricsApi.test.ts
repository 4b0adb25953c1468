import { expect, test } from "vitest";
import { MetricsApi, parseFigures } from "./MetricsApi";

test("metrics are read by name with their labels, and comments and invalid numbers are ignored", () => {
  const text = '# HELP a what it is\n# TYPE a gauge\na 1.5e3\nb{phase="running"} 2\nc NaN\n\nrubbish\n';
  expect([...parseFigures(text)]).toEqual([
    ["a", 1500],
    ['b{phase="running"}', 2],
  ]);
});

test("the warnings are those of the server, whatever simulation is shown", async () => {
  const asked: string[] = [];
  const api = new MetricsApi("http://gsv/x/", (async (url: string) => {
    asked.push(url);
    return new Response("a 1\n", { status: asked.length === 1 ? 200 : 503 });
  }) as typeof fetch);
  expect((await api.figures()).get("a")).toBe(1);
  await expect(api.figures()).rejects.toThrow("503");
  expect(asked[0]).toBe("http://gsv/x/metrics");
});
