import { expect, test, vi } from "vitest";
import { EarlyRequests } from "./EarlyRequests";

const ROOT = "http://host/";

function server(answers: Record<string, unknown>) {
  return vi.fn(async (input: RequestInfo | URL) => {
    const path = String(input).slice(ROOT.length);
    return path in answers ? Response.json(answers[path]) : new Response("{}", { status: 404 });
  });
}

function paths(fetched: ReturnType<typeof server>): string[] {
  return fetched.mock.calls.map(([input]) => String(input).slice(ROOT.length));
}

const ANSWERS = {
  "api/simulations": [{ name: "house" }, { name: "yard" }],
  "api/simulations/yard": { time_s: 3 },
  "api/simulations/yard/scene": { bodies: [{ model: "a" }, { model: "b" }, { model: "a" }] },
};

test("requests status, scene and each model of the wanted simulation", async () => {
  const fetched = server(ANSWERS);
  await new EarlyRequests(ROOT, fetched).begin("yard");
  expect(paths(fetched).sort()).toEqual([
    "api/models/a.glb",
    "api/models/b.glb",
    "api/simulations",
    "api/simulations/yard",
    "api/simulations/yard/scene",
  ]);
});

test("requests the first simulation if the wanted one is not there", async () => {
  const fetched = server(ANSWERS);
  await new EarlyRequests(ROOT, fetched).begin("attic");
  expect(paths(fetched)).toContain("api/simulations/house/scene");
});

test("an early answer is used once, and later requests reach the server", async () => {
  const fetched = server(ANSWERS);
  const early = new EarlyRequests(ROOT, fetched);
  await early.begin("yard");
  const before = fetched.mock.calls.length;
  const address = `${ROOT}api/simulations/yard`;
  expect(await (await early.fetch(address)).json()).toEqual({ time_s: 3 });
  expect(fetched.mock.calls.length).toBe(before);
  expect(await (await early.fetch(address)).json()).toEqual({ time_s: 3 });
  expect(fetched.mock.calls.length).toBe(before + 1);
});

test("a refused early request is returned with its HTTP status", async () => {
  const early = new EarlyRequests(ROOT, server({}));
  await early.begin(null);
  expect((await early.fetch(`${ROOT}api/simulations`)).status).toBe(404);
});

test("an early answer is not used if it is old, or for another kind of request", async () => {
  const fetched = server(ANSWERS);
  let now = 0;
  const early = new EarlyRequests(ROOT, fetched, () => now);
  await early.begin("yard");
  const before = fetched.mock.calls.length;
  await early.fetch(`${ROOT}api/simulations/yard`, { method: "DELETE" });
  now = 6000;
  await early.fetch(`${ROOT}api/simulations/yard/scene`);
  expect(fetched.mock.calls.length).toBe(before + 2);
});

test("after a failed early request, the page sends the request again", async () => {
  const fetched = vi.fn(async () => Response.json([])).mockRejectedValueOnce(new Error("no network"));
  const early = new EarlyRequests(ROOT, fetched as typeof fetch);
  await early.begin(null);
  expect((await early.fetch(`${ROOT}api/simulations`)).ok).toBe(true);
});
