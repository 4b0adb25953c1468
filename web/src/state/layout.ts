// A layout. It describes how the area beside the robot list is divided, and which panels are tabs
// of which part.
//
// The text of a layout is readable, and short enough for a link. r(…) is a row and c(…) is a
// column. Commas separate the parts of a row or column. Dots separate the tabs of one part, and *
// marks the visible tab. The number after ~ is the part's size in thousandths of the row or column:
//
//   r(view~740,c(inspector.topics*~600,camera~400)~260)
export interface Tabs {
  tabs: string[]; // ids of panels; at least one
  front: string; // id of the visible panel
}

// A part of the layout that is divided into a row or a column.
export interface Split {
  split: "row" | "column";
  // Shares in thousandths, at least 1; rows contain columns and tabs, columns contain rows and
  // tabs.
  parts: { part: Part; share: number }[];
}

export type Part = Tabs | Split;

export const VIEW = "view"; // the panel that is always open

export const MAX_LAYOUT_CHARACTERS = 4000;
const MAX_PANELS = 100;
const MAX_DEPTH = 12;

// The result of reading a text: a layout, or the reason why the text is not a layout. Panels that
// are not `known` are left out of the layout, and listed.
export type ReadLayout = { layout: Split; unknown: string[] } | { problem: string };

export function readLayout(text: string, known: ReadonlySet<string>): ReadLayout {
  if (text.length > MAX_LAYOUT_CHARACTERS) {
    return { problem: `it has ${text.length} characters; the limit is ${MAX_LAYOUT_CHARACTERS}` };
  }
  try {
    const root = new Reader(text).read();
    const panels = panelsOf(root);
    const unknown = panels.filter((id) => !known.has(id));
    const twice = panels.find((id, i) => panels.indexOf(id) !== i);
    if (twice !== undefined) return { problem: `the panel ${twice} occurs twice` };
    return { layout: withView(pruned(root, known)), unknown };
  } catch (error) {
    return { problem: (error as Error).message };
  }
}

export function panelsOf(part: Part): string[] {
  return "tabs" in part ? part.tabs : part.parts.flatMap((each) => panelsOf(each.part));
}

export function textOf(part: Part): string {
  if ("tabs" in part) {
    const isFirst = part.front === part.tabs[0];
    return part.tabs.map((id) => (id === part.front && !isFirst ? `${id}*` : id)).join(".");
  }
  const parts = part.parts.map((each) => `${textOf(each.part)}~${Math.max(1, Math.round(each.share))}`);
  return `${part.split === "row" ? "r" : "c"}(${parts.join(",")})`;
}

// On a narrow screen, all panels are tabs below the view.
export function narrowLayout(panels: readonly string[], front: string | null): Split {
  const others = panels.filter((id) => id !== VIEW);
  const view = { part: { tabs: [VIEW], front: VIEW }, share: 560 };
  if (others.length === 0) return { split: "column", parts: [view] };
  const shown = front !== null && others.includes(front) ? front : others[0]!;
  return { split: "column", parts: [view, { part: { tabs: others, front: shown }, share: 440 }] };
}

class Reader {
  private at = 0;
  private panels = 0;

  constructor(private readonly text: string) {}

  read(): Part {
    const part = this.part(0);
    if (this.at < this.text.length) this.fail("the end");
    return part;
  }

  private part(depth: number): Part {
    if (depth > MAX_DEPTH) throw new Error(`its rows and columns are nested more than ${MAX_DEPTH} levels deep`);
    return /^[rc]\(/.test(this.text.slice(this.at, this.at + 2)) ? this.split(depth) : this.tabs();
  }

  private split(depth: number): Split {
    const split = this.text[this.at] === "r" ? "row" : "column";
    this.at += 2;
    const parts: Split["parts"] = [];
    do {
      const part = this.part(depth + 1);
      if ("split" in part && part.split === split) throw new Error(`a ${split} is nested directly in a ${split}`);
      if (!this.take("~")) this.fail("~ and a share");
      parts.push({ part, share: this.share() });
    } while (this.take(","));
    if (!this.take(")")) this.fail(") or ,");
    return { split, parts };
  }

  private tabs(): Tabs {
    const tabs: string[] = [];
    let front: string | null = null;
    do {
      const id = this.match(/^[a-z][a-z0-9_-]{0,39}/);
      if (id === null) this.fail("a panel");
      if (++this.panels > MAX_PANELS) throw new Error(`it has more than ${MAX_PANELS} panels`);
      tabs.push(id);
      if (this.take("*")) front = id;
    } while (this.take("."));
    return { tabs, front: front ?? tabs[0]! };
  }

  private share(): number {
    const digits = this.match(/^\d{1,4}/);
    if (digits === null || Number(digits) < 1) this.fail("a share from 1 to 9999");
    return Number(digits);
  }

  private take(character: string): boolean {
    if (this.text[this.at] !== character) return false;
    this.at += 1;
    return true;
  }

  private match(pattern: RegExp): string | null {
    const found = pattern.exec(this.text.slice(this.at, this.at + 40))?.[0] ?? null;
    this.at += found?.length ?? 0;
    return found;
  }

  private fail(expected: string): never {
    const found = this.text[this.at];
    throw new Error(`expected ${expected} at character ${this.at + 1}, found ${found === undefined ? "the end" : `"${found}"`}`);
  }
}

// Returns the part without unknown panels, and without parts that are empty as a result. Null if no
// part remains.
function pruned(part: Part, known: ReadonlySet<string>): Part | null {
  if ("tabs" in part) {
    const tabs = part.tabs.filter((id) => known.has(id));
    return tabs.length === 0 ? null : { tabs, front: tabs.includes(part.front) ? part.front : tabs[0]! };
  }
  const parts = part.parts.flatMap(({ part: inner, share }) => {
    const kept = pruned(inner, known);
    if (kept && "split" in kept && kept.split === part.split) {
      // The parts of the inner row or column share its place.
      const total = kept.parts.reduce((sum, each) => sum + each.share, 0);
      return kept.parts.map((each) => ({ ...each, share: Math.max(1, Math.round((each.share * share) / total)) }));
    }
    return kept ? [{ part: kept, share }] : [];
  });
  if (parts.length === 0) return null;
  return parts.length === 1 ? parts[0]!.part : { split: part.split, parts };
}

// Adds the view if it is missing. If `part` consists of tabs, puts it into a row, because a layout
// must be a row or a column.
function withView(part: Part | null): Split {
  const view = { part: { tabs: [VIEW], front: VIEW }, share: 500 };
  if (!part) return { split: "row", parts: [view] };
  const isSplit = "split" in part;
  if (panelsOf(part).includes(VIEW)) return isSplit ? part : { split: "row", parts: [{ part, share: 1000 }] };
  if (isSplit && part.split === "row") return { split: "row", parts: [view, ...part.parts] };
  return { split: "row", parts: [view, { part, share: 500 }] };
}
