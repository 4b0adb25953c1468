import { expect, test } from "vitest";
import type { LinkedView } from "./link";
import { hashOf, linkedView } from "./link";
import { FIRST_SHOWN } from "./overlays";

const NOTHING = { time: null, viewpoint: null, selection: null, viewMode: null, shown: null, layout: null };

test("a view is unchanged after writing and reading its link", () => {
  const view: LinkedView = {
    time: 12.345678,
    viewpoint: [1.5, -2.25, 3, 0, 0.125, -0.5],
    selection: "a b&c=<d>",
    viewMode: "chase",
    shown: { ...FIRST_SHOWN, trails: true, grid: false },
    layout: "r(view~740,c(inspector.log*~600,images~400)~260)",
  };
  expect(linkedView(hashOf(view))).toEqual(view);
});

test("it reads as a person would write it", () => {
  const viewpoint: LinkedView["viewpoint"] = [1, 2, 3.00049, 0, 0, 0];
  const view: LinkedView = { ...NOTHING, time: 2, viewpoint, viewMode: "orbit" };
  expect(hashOf(view)).toBe("#t=2&view=1,2,3,0,0,0");
  expect(linkedView("")).toEqual(NOTHING);
});

test.each([
  "#t=",
  "#t=soon",
  "#t=Infinity",
  "#view=1,2,3",
  "#view=1,2,3,4,5,x",
  "#view=1,2,3,4,5,",
  "#view=1e300,0,0,0,0,0",
  "#view=1,1,1,1,1,1",
  "#mode=upside-down",
  "#select=",
  "#%E0%A4%A",
])("%s asks for nothing", (hash) => {
  expect(linkedView(hash)).toEqual(NOTHING);
});
