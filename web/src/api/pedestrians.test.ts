import { expect, test } from "vitest";
import { newPedestrians, parsePedestrians, parseRoute, pedestriansJson, routeText } from "./pedestrians";

test("a route is written as on the command line, and read back", () => {
  const route = [
    { x: -4, y: 0.5, radius: 1 },
    { x: 4, y: 0, radius: 0 },
  ];
  expect(routeText(route)).toBe("-4,0.5,1:4,0");
  expect(parseRoute("-4,0.5,1:4,0")).toEqual(route);
  for (const wrong of ["", "1", "1,2,3,4", "1,x", "1,2:", "1,,2"]) expect(parseRoute(wrong), wrong).toBeNull();
});

test("keys that the form does not show are kept", () => {
  const json = { name: "crowd", count: 3, speed: 1.1, route: [{ x: 1, y: 2, radius: 0.5 }] };
  const [group] = parsePedestrians([json]);
  expect(group).toEqual({ name: "crowd", count: 3, route: json.route, others: { speed: 1.1 } });
  expect(pedestriansJson(group!)).toEqual(json);
});

test("a second group gets another name, and an invalid group is rejected with its place", () => {
  const first = newPedestrians([]);
  expect(newPedestrians([first]).name).toBe("pedestrian_2");
  expect(() => parsePedestrians([3])).toThrow("pedestrians[0]: expected an object");
});
