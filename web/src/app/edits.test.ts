import { expect, test } from "vitest";
import type { Edit } from "./edits";
import { inOrder, together } from "./edits";

// Makes edits that write to a log. `refuses` is called before each edit.
function recorder(refuses: (what: string, log: readonly string[]) => boolean = () => false) {
  const log: string[] = [];
  const edit = (name: string): Edit => {
    const act = async (what: string) => {
      if (refuses(what, log)) throw new Error(`no ${what}`);
      log.push(what);
    };
    return { name, apply: () => act(`+${name}`), revert: () => act(`-${name}`) };
  };
  return { log, edit };
}

test("several edits are done in order, and undone in the reverse order", async () => {
  const { log, edit } = recorder();
  const all = inOrder("all", [edit("a"), edit("b")]);
  await all.apply();
  await all.revert();
  expect(log).toEqual(["+a", "+b", "-b", "-a"]);
});

test("edits before a refused one are undone", async () => {
  const { log, edit } = recorder((what) => what === "+c");
  await expect(inOrder("all", [edit("a"), edit("b"), edit("c")]).apply()).rejects.toThrow("no +c");
  expect(log).toEqual(["+a", "+b", "-b", "-a"]);
});

test("bodies that obstruct each other move one after the other", async () => {
  // The edit "+a" fails until b is removed.
  const { log, edit } = recorder((what, log) => what === "+a" && !log.includes("+b"));
  await together("all", [edit("a"), edit("b")]).apply();
  expect(log).toEqual(["+b", "+a"]);
});

test("if one body cannot move, no body is moved", async () => {
  const { log, edit } = recorder((what) => what === "+b");
  await expect(together("all", [edit("a"), edit("b")]).apply()).rejects.toThrow("no +b");
  expect(log).toEqual(["+a", "-a"]);
});
