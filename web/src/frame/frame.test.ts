// @vitest-environment jsdom
import { expect, test } from "vitest";
import { showFrame } from "./frame";

test("each page has links to all others, and marks itself", () => {
  const host = document.createElement("div");
  showFrame(host, "Recordings");
  const links = [...host.querySelectorAll("nav a")];
  expect(links.map((link) => link.getAttribute("href"))).toEqual(["./", "join.html", "recordings.html", "broker.html"]);
  const marked = links.filter((link) => link.getAttribute("aria-current") === "page");
  expect(marked.map((link) => link.textContent)).toEqual(["Recordings"]);
});
