// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import { ApiError } from "../api/JsonServer";
import { element } from "../ui/element";
import { ListPage } from "./ListPage";

async function open(fetch: () => Promise<{ note: string; items: string[] }>) {
  const admit = vi.fn();
  const show = (item: string) => element("li", {}, item);
  const page = new ListPage<string>({ title: "Things", label: "Things", empty: "None.", fetch, show, admit });
  const host = document.createElement("div");
  page.show(host);
  await page.load();
  const form = host.querySelector<HTMLElement>("form")!;
  const enter = (token: string) => {
    form.querySelector("input")!.value = token;
    form.dispatchEvent(new Event("submit", { cancelable: true }));
  };
  const sentence = () => host.querySelector<HTMLElement>("[role=alert]")!;
  return { host, page, admit, form, enter, sentence };
}

test("after a token was typed, the request is repeated with it", async () => {
  const fetch = vi.fn(async () => ({ note: "here", items: ["a thing"] }));
  fetch.mockRejectedValueOnce(new ApiError(401, "this request requires a token"));
  fetch.mockRejectedValueOnce(new ApiError(403, "this token is wrong"));
  const { host, admit, form, enter, sentence } = await open(fetch);
  expect(form.hidden).toBe(false);
  enter("wrong");
  await vi.waitFor(() => expect(sentence().textContent).toBe("this token is wrong"));
  expect(form.hidden).toBe(false);
  enter(" right ");
  await vi.waitFor(() => expect(host.querySelector("li")?.textContent).toBe("a thing"));
  expect(admit.mock.calls).toEqual([["wrong"], ["right"]]);
  expect(form.hidden).toBe(true);
  expect(sentence().hidden).toBe(true);
});

test("errors other than a missing token do not ask for a token", async () => {
  const { form, sentence } = await open(async () => Promise.reject(new ApiError(503, "the broker is silent")));
  expect(sentence().textContent).toBe("the broker is silent");
  expect(form.hidden).toBe(true);
});
