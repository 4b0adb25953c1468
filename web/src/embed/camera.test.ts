import { expect, test } from "vitest";
import { FIRST_SIDE, imageUrl, turned, zoomed } from "./camera";

const WANTED = { src: "http://host:8080/?simulation=a%20b", attributes: {}, side: FIRST_SIDE, width: 640, height: 360 };

test("the image shows the simulation in the address, from the side to which the view was turned", () => {
  const url = new URL(imageUrl("view.jpg", WANTED));
  expect(url.origin + url.pathname).toBe("http://host:8080/view.jpg");
  expect(Object.fromEntries(url.searchParams)).toEqual({
    simulation: "a b",
    size: "640x360",
    azimuth: "135.0",
    elevation: "34.0",
    zoom: "1.000",
  });
  expect(imageUrl("view.mjpeg", { ...WANTED, src: "http://host/replays/7/" })).toContain("http://host/replays/7/view.mjpeg?");
});

test("attributes place the camera instead of a side", () => {
  const attributes = { follow: "pebble", fov: "60", token: "secret", fps: "5" };
  const { searchParams } = new URL(imageUrl("view.mjpeg", { ...WANTED, attributes }));
  expect(searchParams.get("follow")).toBe("pebble");
  expect(searchParams.get("fov")).toBe("60");
  expect(searchParams.get("token")).toBe("secret");
  expect(searchParams.get("fps")).toBe("5");
  expect(searchParams.has("azimuth")).toBe(false);
  expect(new URL(imageUrl("view.jpg", { ...WANTED, attributes })).searchParams.has("fps")).toBe(false);
});

test("a drag turns the camera within the angles that the server accepts", () => {
  const side = turned(FIRST_SIDE, 100, 50);
  expect(side.azimuth).toBeCloseTo(95);
  expect(side.elevation).toBeCloseTo(54);
  expect(turned(FIRST_SIDE, 1000, 1000).azimuth).toBeCloseTo(95); // 135 - 400 + 360
  expect(turned(FIRST_SIDE, 0, 1000).elevation).toBe(90);
  expect(turned(FIRST_SIDE, 0, -1000).elevation).toBe(-5);
  expect(zoomed(FIRST_SIDE, 1000).zoom).toBe(20);
});
