// @vitest-environment jsdom
import { expect, test } from "vitest";
import { JsonServer } from "../api/JsonServer";
import { createRecordingsPage } from "./RecordingsPage";

const RUN = {
  name: "run 1.mcap",
  size_bytes: 2_400_000,
  modified: "2026-01-31T12:00:00Z",
  state: "complete",
  problem: "",
  duration_s: 75,
  messages: 12,
};

async function open(recordings: object[], more: object = {}) {
  const body = { folder: "/data", left_out: 0, recordings, ...more };
  const server = new JsonServer("http://gsv/", async () => new Response(JSON.stringify(body)));
  const host = document.createElement("div");
  const page = createRecordingsPage(server, () => {});
  page.show(host);
  await page.load();
  return host;
}

test("each recording is listed with its size, length and date, and replayed by one click", async () => {
  const host = await open([RUN]);
  const item = host.querySelector(".recording")!;
  expect(item.querySelector("h2")!.textContent).toBe("run 1.mcap");
  expect(item.textContent).toContain("2.4 MB");
  expect(item.textContent).toContain("1:15.00 · 12 messages");
  expect(item.textContent).toContain("2026");
  expect(item.querySelector("a")!.getAttribute("href")).toBe("./?recording=run%201.mcap");
  expect(host.querySelector(".frame-note")!.textContent).toBe("/data");
});

test("an incomplete recording can be replayed, and an unreadable one shows the reason", async () => {
  const host = await open([
    { ...RUN, state: "unfinished" },
    { ...RUN, name: "<b>x</b>.mcap", state: "unreadable", problem: "it is no recording" },
  ]);
  const [unfinished, unreadable] = host.querySelectorAll(".recording");
  expect(unfinished!.querySelector("a")).not.toBeNull();
  expect(unfinished!.textContent).toContain("interrupted");
  expect(unreadable!.querySelector("a")).toBeNull();
  expect(unreadable!.querySelector("b")).toBeNull();
  expect(unreadable!.textContent).toContain("it is no recording");
});

test("without recordings the page explains how to make one; with very many, it shows the number of omitted ones", async () => {
  expect((await open([])).querySelector(".frame-list")!.textContent).toContain("No recordings yet");
  expect((await open([RUN], { left_out: 3 })).textContent).toContain("3 older ones not shown.");
});
