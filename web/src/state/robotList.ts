// Selects, sorts and groups the robots of the list.
import type { RobotStatus } from "../api/status";
import type { RobotHealth, ShownState } from "./health";
import { STATE_WORDS, badness } from "./health";

export const SORTINGS = ["worst", "name", "distance", "collisions"] as const;
export type Sorting = (typeof SORTINGS)[number];
export const GROUPINGS = ["none", "namespace", "model", "state", "behaviour"] as const;
export type Grouping = (typeof GROUPINGS)[number];

export interface RobotFilter {
  text: string; // the text that the user typed
  state: ShownState | null; // null for all states
  sorting: Sorting;
  grouping: Grouping;
}

export const NO_FILTER: RobotFilter = { text: "", state: null, sorting: "worst", grouping: "none" };

export type RobotKind = "robot" | "avatar" | "station";

export interface ListedRobot {
  status: RobotStatus;
  kind: RobotKind;
  state: ShownState;
  health: RobotHealth | null;
}

export type Entry = { title: string; count: number } | ListedRobot;

export function isTitle(entry: Entry): entry is { title: string; count: number } {
  return "title" in entry;
}

// Returns the part of a name before its last slash. If the name has no slash, returns the name
// without the number at its end.
export function namespaceOf(name: string): string {
  const slash = name.lastIndexOf("/");
  return slash > 0 ? name.slice(0, slash) : name.replace(/[_-]?\d+$/, "");
}

// A parsed search text.
export interface Query {
  test(robot: ListedRobot): boolean;
  problem: string; // empty if the filter is valid
}

const FIELDS: Record<string, (robot: ListedRobot) => string> = {
  name: ({ status }) => status.name,
  ns: ({ status }) => namespaceOf(status.name),
  model: ({ status }) => status.model,
  behaviour: ({ status }) => status.behaviour,
  state: ({ state }) => `${state} ${STATE_WORDS[state]}`,
};

// Parses the words of a search. All of them must match. The word "pebble" matches a part of the
// name, and "model:scout" a part of another field. "/^a\d$/" is a regular expression for the name,
// and "model:/^sc/" one for a field.
export function queryOf(text: string): Query {
  const tests: ((robot: ListedRobot) => boolean)[] = [];
  let problem = "";
  for (const word of text.trim().split(/\s+/)) {
    if (word === "") continue;
    const [, field = "", wanted = ""] = /^(?:(\w+):)?(.*)$/.exec(word) ?? [];
    const read = field === "" ? FIELDS.name! : FIELDS[field];
    if (!read) {
      problem = `Unknown field ${field}. Use name, ns, model, behaviour or state.`;
      continue;
    }
    try {
      tests.push(testOf(read, wanted));
    } catch {
      problem = `${wanted} is not a regular expression.`;
    }
  }
  return { test: (robot) => tests.every((test) => test(robot)), problem };
}

function testOf(read: (robot: ListedRobot) => string, wanted: string): (robot: ListedRobot) => boolean {
  if (wanted.startsWith("/")) {
    const expression = new RegExp(wanted.replace(/^\//, "").replace(/\/$/, ""), "i");
    return (robot) => expression.test(read(robot));
  }
  const part = wanted.toLowerCase();
  return (robot) => read(robot).toLowerCase().includes(part);
}

export function isFiltering({ text, state }: RobotFilter): boolean {
  return text.trim() !== "" || state !== null;
}

export function filtered(robots: readonly ListedRobot[], { text, state }: RobotFilter): readonly ListedRobot[] {
  if (text.trim() === "" && state === null) return robots;
  const { test } = queryOf(text);
  return robots.filter((robot) => (state === null || robot.state === state) && test(robot));
}

const COLLATOR = new Intl.Collator("en", { numeric: true });

// Sorts names in natural order: "a2" before "a10". The order is cached while the names do not
// change. To compare thousands of texts for each update would take too long.
export class NameOrder {
  private names: readonly string[] = [];
  private ranks = new Map<string, number>();

  ranksOf(robots: readonly ListedRobot[]): ReadonlyMap<string, number> {
    const isSame = robots.length === this.names.length && robots.every(({ status }, i) => status.name === this.names[i]);
    if (isSame) return this.ranks;
    this.names = robots.map(({ status }) => status.name);
    this.ranks = new Map([...this.names].sort(COLLATOR.compare).map((name, rank) => [name, rank]));
    return this.ranks;
  }
}

// Returns the rows of the list.
export function entriesOf(robots: readonly ListedRobot[], filter: RobotFilter, order = new NameOrder()): Entry[] {
  const ranks = order.ranksOf(robots);
  const key = keyOf(filter.sorting);
  const sorted = filtered(robots, filter)
    .map((robot) => ({ robot, key: key(robot), rank: ranks.get(robot.status.name) ?? 0 }))
    .sort((a, b) => b.key - a.key || a.rank - b.rank)
    .map(({ robot }) => robot);
  return filter.grouping === "none" ? sorted : grouped(sorted, filter.grouping);
}

// Returns `entries` in the order of `shown`. New entries are last.
export function inOrderOf(shown: readonly Entry[], entries: readonly Entry[]): Entry[] {
  const places = new Map(shown.map((entry, place) => [nameOf(entry), place]));
  const placeOf = (entry: Entry) => places.get(nameOf(entry)) ?? shown.length;
  return [...entries].sort((a, b) => placeOf(a) - placeOf(b));
}

function nameOf(entry: Entry): string {
  return isTitle(entry) ? `group ${entry.title}` : `robot ${entry.status.name}`;
}

function keyOf(sorting: Sorting): (robot: ListedRobot) => number {
  switch (sorting) {
    case "worst":
      return ({ state, kind }) => (kind === "station" && state !== "dead" ? 0 : badness(state));
    case "distance":
      return ({ status }) => status.distance;
    case "collisions":
      return ({ status }) => status.collisions;
    case "name":
      return () => 0;
  }
}

// Groups are in the order of their first robots.
function grouped(robots: readonly ListedRobot[], grouping: Exclude<Grouping, "none">): Entry[] {
  const groups = new Map<string, ListedRobot[]>();
  for (const robot of robots) {
    const title = titleOf(robot, grouping);
    const group = groups.get(title);
    if (group) group.push(robot);
    else groups.set(title, [robot]);
  }
  return [...groups].flatMap(([title, members]) => [{ title, count: members.length }, ...members]);
}

function titleOf({ status, state }: ListedRobot, grouping: Exclude<Grouping, "none">): string {
  switch (grouping) {
    case "namespace":
      return namespaceOf(status.name) || status.name;
    case "model":
      return status.model || "no model";
    case "behaviour":
      return status.behaviour || "no behaviour";
    case "state":
      return STATE_WORDS[state];
  }
}
