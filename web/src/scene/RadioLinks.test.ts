import { Matrix4 } from "three";
import { expect, test } from "vitest";
import { LineLayer } from "./LineLayer";
import { RadioLinks } from "./RadioLinks";

const PLACES: Record<string, Matrix4> = {
  ann: new Matrix4().makeTranslation(0, 0, 0),
  bob: new Matrix4().makeTranslation(2, 0, 0),
  cyd: new Matrix4().makeTranslation(0, 3, 0),
};

function drawn(links: RadioLinks, now: number): LineLayer {
  const lines = new LineLayer({});
  lines.begin();
  links.draw(lines, (robot) => PLACES[robot] ?? null, now);
  return lines;
}

test("a message is a line to each receiver for half a second", () => {
  const links = new RadioLinks();
  links.take({ sender: "ann", heard_by: ["bob", "cyd"] }, 1000);
  const lines = drawn(links, 1400);
  expect(lines.segments).toBe(2);
  lines.finish();
  expect(lines.lines.geometry.getAttribute("instanceEnd").getX(0)).toBe(2);
  expect(drawn(links, 1501).segments).toBe(0);
});

test("a message without receivers is a vertical line, and removed robots and other messages are ignored", () => {
  const links = new RadioLinks();
  links.take({ sender: "ann", heard_by: [] }, 0);
  expect(drawn(links, 1).segments).toBe(1);
  links.take({ sender: "ann", heard_by: ["gone"] }, 0);
  links.take({ sender: "gone", heard_by: ["bob"] }, 0);
  for (const message of [null, 7, {}, { sender: 7, heard_by: [] }]) links.take(message, 0);
  expect(drawn(links, 1).segments).toBe(1);
  links.clear();
  expect(drawn(links, 1).segments).toBe(0);
});

test("the number of lines is limited", () => {
  const links = new RadioLinks();
  for (let i = 0; i < 10_000; i++) links.take({ sender: "ann", heard_by: ["bob"] }, 0);
  expect(drawn(links, 1).segments).toBe(500);
});
