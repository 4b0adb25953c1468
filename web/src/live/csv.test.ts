import { expect, test } from "vitest";
import { csvOf } from "./csv";
import { Series } from "./Series";

function series(...samples: [number, number][]): Series {
  const made = new Series();
  for (const [time, value] of samples) made.push(time, value);
  return made;
}

test("curves with different times share a table", () => {
  const csv = csvOf([
    { name: "a x", unit: "m", series: series([0, 1.5], [0.1, 2]) },
    { name: "factor", unit: "", series: series([0.1, 0.99], [0.2, NaN]) },
  ]);
  expect(csv).toBe("time_s,a x [m],factor\r\n0,1.5,\r\n0.1,2,0.99\r\n0.2,,NaN\r\n");
});

test("names are shown as text, whatever they contain", () => {
  const csv = csvOf([
    { name: 'say "a,b"', unit: "", series: series() },
    { name: "=1+1", unit: "m", series: series() },
  ]);
  expect(csv).toBe(`time_s,"say ""a,b""",'=1+1 [m]\r\n`);
});

test("without curves there is only a header", () => {
  expect(csvOf([])).toBe("time_s\r\n");
});
