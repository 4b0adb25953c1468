// @vitest-environment jsdom
import { afterEach, expect, test, vi } from "vitest";
import { Credentials, pageCredentials } from "./credentials";
import { SimulationApi } from "./SimulationApi";

afterEach(() => {
  sessionStorage.clear();
  vi.unstubAllGlobals();
});

test("a token in the address is removed from it and kept for this tab", () => {
  history.replaceState(null, "", "/?quality=high#token=secret-secret-secret&t=3");
  expect(pageCredentials(window).token).toBe("secret-secret-secret");
  expect(location.href).not.toContain("secret");
  expect(location.hash).toBe("#t=3");
  expect(location.search).toBe("?quality=high");
  expect(pageCredentials(window).token).toBe("secret-secret-secret");
});

test("token and viewer's key are sent with each request and with the socket", async () => {
  const asked = vi.fn(async (_input: string, _init: { headers: object }) => new Response("[]"));
  vi.stubGlobal("fetch", asked);
  const credentials = new Credentials();
  const api = new SimulationApi("http://gsv/", credentials.fetch, credentials);
  await api.simulations();
  expect(asked.mock.lastCall![1].headers).toEqual({});
  credentials.token = "a+b";
  credentials.viewer = "k";
  await api.simulations();
  expect(asked.mock.lastCall![1].headers).toEqual({ authorization: "Bearer a+b", "gsv-viewer": "k" });
  expect(api.socketUrl("a b")).toBe("ws://gsv/ws?simulation=a%20b&token=a%2Bb&viewer=k");
});
