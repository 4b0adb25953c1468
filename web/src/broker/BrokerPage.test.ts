// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import { JsonServer } from "../api/JsonServer";
import { BrokerApi } from "./BrokerApi";
import { BrokerPage } from "./BrokerPage";

const TYPES = {
  broker: "corbaloc::1.2@127.0.0.1:1/TradingService",
  types: [
    { name: "Rover", super_types: ["Robot"], properties: [{ name: "speed", type: "double", mandatory: true }] },
    { name: "Robot", super_types: [], properties: [] },
  ],
};
const OFFERS = {
  offers: [
    { address: "a:1", properties: { speed: 4 }, matches: true, terms: [{ term: "speed > 3", result: "true" }] },
    {
      address: "b:2",
      properties: { name: "<b>" },
      matches: false,
      terms: [{ term: "speed > 3", result: "no value", missing: ["speed"] }],
    },
  ],
};
const LINKS = { links: [{ name: "north", address: "c:3", answers: false }] };

async function open(answers: Record<string, [status: number, body: unknown]>) {
  const asked: string[] = [];
  const fetchPage = (async (input: string) => {
    const { pathname, search } = new URL(input);
    asked.push(pathname + search);
    const [status, body] = answers[pathname.split("/").at(-1)!]!;
    return new Response(JSON.stringify(body), { status });
  }) as typeof fetch;
  const host = document.createElement("div");
  const admit = vi.fn();
  const page = new BrokerPage(new BrokerApi(new JsonServer("http://gsv/", fetchPage)), admit);
  page.show(host);
  await page.load();
  return { host, asked, admit };
}

async function find(host: HTMLElement, constraint: string) {
  host.querySelector<HTMLInputElement>("[name=constraint]")!.value = constraint;
  host.querySelector("form")!.dispatchEvent(new Event("submit", { cancelable: true }));
  await new Promise((resolve) => setTimeout(resolve));
}

test("shows the types in order, and requests the offers of the first", async () => {
  const { host, asked } = await open({ types: [200, TYPES], offers: [200, OFFERS], links: [200, LINKS] });
  const names = [...host.querySelectorAll("[data-type]")].map((button) => (button as HTMLElement).dataset.type);
  expect(names).toEqual(["Robot", "Rover"]);
  expect(asked).toContain("/api/broker/offers?type=Robot&constraint=&preference=");
  expect(host.querySelector(".summary")!.textContent).toBe("2 offers");
});

test("shows which offers match a constraint, and which term failed", async () => {
  const { host, asked } = await open({ types: [200, TYPES], offers: [200, OFFERS], links: [200, LINKS] });
  await find(host, "speed > 3");
  expect(asked).toContain("/api/broker/offers?type=Robot&constraint=speed%20%3E%203&preference=");
  expect(host.querySelector(".summary")!.textContent).toBe("1 of 2 offers match");
  expect(host.querySelector("[data-matches=false] .term")!.textContent).toContain("the offer has no property speed");
  expect(host.querySelector("[data-matches=false] dd")!.textContent).toBe('"<b>"');
});

test("shows the broker's reason for a rejected constraint, and a link that does not respond", async () => {
  const { host } = await open({
    types: [200, TYPES],
    offers: [400, { error: "expected a value at 9" }],
    links: [200, LINKS],
  });
  expect(host.querySelector("[role=alert]")!.textContent).toBe("expected a value at 9");
  expect(host.querySelector(".link")!.textContent).toContain("does not respond");
});

test("a typed token is sent to the server", async () => {
  const answers: Parameters<typeof open>[0] = { types: [401, { error: "this request requires a token" }], links: [401, {}] };
  const { host, admit } = await open(answers);
  expect(host.querySelector("[role=alert]")!.textContent).toBe("this request requires a token");
  answers.types = [200, TYPES];
  answers.offers = [200, OFFERS];
  host.querySelector<HTMLInputElement>(".token-field")!.value = " secret ";
  host.querySelector(".answer form")!.dispatchEvent(new Event("submit", { cancelable: true }));
  await vi.waitFor(() => expect(host.querySelector(".summary")).not.toBeNull());
  expect(admit.mock.calls).toEqual([["secret"]]);
  expect(host.querySelector(".token-field")).toBeNull();
});

test("the page of a replay explains that there is no broker", async () => {
  const missing: [number, unknown] = [404, { error: "there is nothing at this address" }];
  const { host } = await open({ types: missing, links: missing });
  expect(host.querySelector(".answer")!.textContent).toContain("A replay has no broker.");
});
