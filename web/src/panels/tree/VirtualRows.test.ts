// @vitest-environment jsdom
import { expect, test } from "vitest";
import { element } from "../../ui/element";
import { VirtualRows } from "./VirtualRows";

function rowsOf(numbers: number[]) {
  const rows = new VirtualRows<number>(
    {
      keyOf: String,
      kindOf: () => "number",
      heightOf: () => 50,
      make: () => {
        const made = element("li");
        return { element: made, write: (entry) => void (made.textContent = String(entry)) };
      },
    },
    "Numbers",
  );
  Object.defineProperty(rows.scroller, "clientHeight", { value: 500 });
  rows.show(numbers);
  return rows;
}

const shown = (rows: VirtualRows<number>) =>
  [...rows.list.children].map((row) => Number(row.textContent));
const FIVE_THOUSAND = Array.from({ length: 5000 }, (_, i) => i);

test("only the entries in sight have rows, out of five thousand", () => {
  const rows = rowsOf(FIVE_THOUSAND);
  expect(rows.list.style.height).toBe("250000px");
  expect(rows.list.children.length).toBeLessThan(25);
  expect(shown(rows)[0]).toBe(0);
});

test("rows are rewritten after scrolling", () => {
  const rows = rowsOf(FIVE_THOUSAND);
  rows.scrollTo(3000);
  expect(shown(rows)).toContain(3000);
  expect(shown(rows)).toEqual([...shown(rows)].sort((a, b) => a - b));
  expect(shown(rows)).not.toContain(0);
  expect(rows.list.children.length).toBeLessThan(40);
  const row = [...rows.list.children].find(({ textContent }) => textContent === "3000") as HTMLElement;
  expect(row.style.transform).toBe("translateY(150000px)");
  expect(row.getAttribute("aria-posinset")).toBe("3001");
});

test("an entry keeps its row when it moves in the list", () => {
  const rows = rowsOf([1, 2, 3]);
  const row = [...rows.list.children].find(({ textContent }) => textContent === "3")!;
  rows.show([3, 1, 2]);
  expect(row.textContent).toBe("3");
  expect((row as HTMLElement).style.transform).toBe("translateY(0px)");
  rows.show([]);
  expect(shown(rows)).toEqual([]);
});
