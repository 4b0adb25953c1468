import { expect, test, vi } from "vitest";
import { ApiError, SimulationApi } from "./SimulationApi";

const STATUS = { name: "a b", phase: "running", mode: "real_time", robots: [] };

function answering(body: unknown, status = 200) {
  const fetchPage = vi.fn<typeof fetch>(async () => new Response(JSON.stringify(body), { status }));
  return { api: new SimulationApi("http://127.0.0.1:8080/", fetchPage), fetchPage };
}

test("an action is posted to its simulation, whose name may contain any character", async () => {
  const { api, fetchPage } = answering(STATUS);
  expect((await api.act("a b", "step", 5)).phase).toBe("running");
  const [url, init] = fetchPage.mock.calls[0]!;
  expect(url).toBe("http://127.0.0.1:8080/api/simulations/a%20b/step");
  expect(init).toMatchObject({ method: "POST", body: '{"count":5}' });
});

test("the real-time factor is posted to its own address", async () => {
  const { api, fetchPage } = answering({ ...STATUS, target_factor: 2.5 });
  expect((await api.setFactor("a b", 2.5)).targetFactor).toBe(2.5);
  const [url, init] = fetchPage.mock.calls[0]!;
  expect(url).toBe("http://127.0.0.1:8080/api/simulations/a%20b/real_time_factor");
  expect(init).toMatchObject({ method: "POST", body: '{"real_time_factor":2.5}' });
});

test("a drive command has a timeout, after which the robot stops", async () => {
  const { api, fetchPage } = answering({});
  await api.drive("a b", "r", { linear_m_s: 1, lateral_m_s: 0, angular_rad_s: 0 });
  expect(JSON.parse(String(fetchPage.mock.calls[0]![1]?.body))).toEqual({ linear_m_s: 1, lateral_m_s: 0, angular_rad_s: 0, timeout_s: 1 });
});

test("a command is posted to its own address with its arguments", async () => {
  const { api, fetchPage } = answering(STATUS);
  await api.command("a b", "set_gravity", { z: -1.62 });
  const [url, init] = fetchPage.mock.calls[0]!;
  expect(url).toBe("http://127.0.0.1:8080/api/simulations/a%20b/set_gravity");
  expect(init).toMatchObject({ method: "POST", body: '{"z":-1.62}' });
});

test("play, pause, seek and step requests of a replay have their own addresses", async () => {
  const { api, fetchPage } = answering({ ...STATUS, start_s: 0, end_s: 9, speed: 2, loop: false });
  await api.seek("a b", 1.5);
  await api.stepPoses("a b", -10);
  expect(await api.changeReplay("a b", { speed: 2 })).toEqual({ start: 0, end: 9, speed: 2, loop: false });
  expect(fetchPage.mock.calls.map(([url, init]) => [url, init?.body])).toEqual([
    ["http://127.0.0.1:8080/api/simulations/a%20b/seek", '{"time_s":1.5}'],
    ["http://127.0.0.1:8080/api/simulations/a%20b/step", '{"poses":-10}'],
    ["http://127.0.0.1:8080/api/simulations/a%20b/replay", '{"speed":2}'],
  ]);
});

test("a robot's topics are requested by its name, which may contain any character", async () => {
  const { api, fetchPage } = answering({ topics: [] });
  await api.listTopics("a b", "r/1");
  const [url, init] = fetchPage.mock.calls[0]!;
  expect(url).toBe("http://127.0.0.1:8080/api/simulations/a%20b/robots/r%2F1/topics");
  expect(init?.method ?? "GET").toBe("GET");
});

test("a refusal contains the server's sentence", async () => {
  const { api } = answering({ error: "to pause it must be running, and it is stopped" }, 409);
  const refusal = await api.act("a", "pause").catch((error: unknown) => error);
  expect(refusal).toBeInstanceOf(ApiError);
  expect(refusal).toMatchObject({
    httpStatus: 409,
    message: "to pause it must be running, and it is stopped",
  });
});

test("an error response without a sentence gets a default sentence", async () => {
  const api = new SimulationApi("http://127.0.0.1/", async () => new Response("<html>", { status: 502 }));
  await expect(api.simulations()).rejects.toThrow("The server returned an error: 502.");
});

test("an unreachable server and a silent server are distinguished", async () => {
  const refusing = new SimulationApi("http://127.0.0.1/", () =>
    Promise.reject(new TypeError("fetch failed")),
  );
  await expect(refusing.simulations()).rejects.toThrow("The server cannot be reached. Check that gsv still runs.");
  const silent = new SimulationApi("http://127.0.0.1/", () =>
    Promise.reject(new DOMException("timed out", "TimeoutError")),
  );
  await expect(silent.simulations()).rejects.toThrow("The server did not respond in time. Check that gsv still runs.");
});

test("request addresses are relative to the page's address", () => {
  const api = new SimulationApi("https://example.test/gsv/");
  expect(api.modelUrl("r/1")).toBe("https://example.test/gsv/api/models/r%2F1.glb");
  expect(api.socketUrl("a b")).toBe("wss://example.test/gsv/ws?simulation=a%20b");
});
