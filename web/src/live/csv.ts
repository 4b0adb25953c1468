// Writes curves as a table: one row for each instant with a value, and one column per curve.
import type { Series } from "./Series";

// A curve with its name and unit.
export interface Column {
  name: string;
  unit: string; // empty: none
  series: Series;
}

export function csvOf(columns: Column[]): string {
  const heads = columns.map(({ name, unit }) => (unit ? `${name} [${unit}]` : name));
  const lines = [["time_s", ...heads].map(cell).join(",")];
  const next = columns.map(() => 0);
  for (;;) {
    const times = columns.map(({ series }, i) =>
      next[i]! < series.length ? series.timeAt(next[i]!) : Infinity,
    );
    const time = Math.min(...times);
    if (time === Infinity) break;
    const values = columns.map(({ series }, i) => {
      if (times[i] !== time) return "";
      return String(series.valueAt(next[i]!++));
    });
    lines.push([String(time), ...values].join(","));
  }
  return `${lines.join("\r\n")}\r\n`;
}

// Names are untrusted. If a spreadsheet would read a text as a formula, an apostrophe is put in
// front of it.
function cell(text: string): string {
  const safe = /^[=+\-@\t]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}
