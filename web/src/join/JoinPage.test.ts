// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import { JsonServer } from "../api/JsonServer";
import { createJoinPage } from "./JoinPage";

const SIMULATION = { name: "a b", phase: "running", mode: "lockstep", time_s: 75, robots: 2 };

async function open(instances: object[], status = 200, lost: { number: number }[] | null = null) {
  const body = status === 200 ? { broker: "corbaloc:", instances } : { error: "the broker is silent" };
  const answer = async (input: RequestInfo | URL, init?: RequestInit) => {
    const path = new URL(String(input)).pathname;
    if (!path.startsWith("/api/lost")) return new Response(JSON.stringify(body), { status });
    if (lost === null) return new Response("{}", { status: 404 });
    if (init?.method === "DELETE") lost.splice(lost.findIndex(({ number }) => path === `/api/lost/${number}`), 1);
    return new Response(JSON.stringify({ lost }), { status: 200 });
  };
  const server = new JsonServer("http://gsv/", answer);
  const host = document.createElement("div");
  const page = createJoinPage(server, () => {});
  page.show(host);
  await page.load();
  return host;
}

const links = (host: HTMLElement) =>
  [...host.querySelectorAll<HTMLAnchorElement>(".instance a")].map((link) => link.getAttribute("href"));

test("each simulation is one click away, here and elsewhere", async () => {
  const host = await open([
    { name: "one", place: "h:1", is_here: true, viewer_url: "http://x/", simulations: [SIMULATION] },
    { name: "two", place: "h:2", viewer_url: "http://127.0.0.1:8081/", simulations: [SIMULATION] },
  ]);
  expect(links(host)).toEqual(["./?simulation=a%20b", "http://127.0.0.1:8081/?simulation=a%20b"]);
  expect(host.querySelector(".joinable")!.textContent).toBe("a brunning · lockstep · 1:15.00 · 2 robots");
});

test("only web addresses become links, and markup in names is text", async () => {
  const host = await open([
    { name: "<b>x</b>", place: "h:1", viewer_url: "javascript:alert(1)", simulations: [SIMULATION] },
    { name: "y", place: "h:2", viewer_url: "", simulations: [] },
  ]);
  expect(links(host)).toEqual([]);
  expect(host.querySelector("b")).toBeNull();
  expect(host.textContent).toContain("<b>x</b>");
  expect(host.textContent).toContain("This instance runs without a viewer. Start it without --headless.");
});

test("an instance that does not respond, or a silent broker, is shown with the reason", async () => {
  const host = await open([{ name: "gone", place: "h:3", problem: "h:3 does not respond", simulations: [] }]);
  expect(host.querySelector(".instance .field-error")!.textContent).toBe("h:3 does not respond");
  const silent = await open([], 504);
  expect(silent.querySelector("[role=alert]")!.textContent).toBe("the broker is silent");
});

test("simulations of a crashed server are listed with their recording until they are dismissed", async () => {
  const lost = [
    { number: 3, name: "<i>arena</i>", sentence: "arena was lost at about 12.3 s", replay: "a b.mcap" },
    { number: 4, name: "maze", sentence: "maze was lost" },
  ];
  const host = await open([{ name: "one", place: "h:1", is_here: true, simulations: [] }], 200, lost);
  const items = () => [...host.querySelectorAll(".lost")];
  expect(items().map((item) => item.querySelector("h2")!.textContent)).toEqual(["<i>arena</i> ended because its server crashed", "maze ended because its server crashed"]);
  expect(items()[0]!.textContent).toContain("arena was lost at about 12.3 s");
  expect(items()[0]!.querySelector("a")!.getAttribute("href")).toBe("./?recording=a%20b.mcap");
  expect(items()[1]!.querySelector("a")).toBeNull();
  items()[0]!.querySelector("button")!.click();
  await vi.waitFor(() => expect(items().map((item) => item.querySelector("h2")!.textContent)).toEqual(["maze ended because its server crashed"]));
  expect(host.querySelectorAll(".instance").length).toBe(1);
});
