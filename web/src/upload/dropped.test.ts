import { expect, test } from "vitest";
import type { DroppedFile } from "../api/DroppedFile";
import { unpacked, worldsFirst } from "./dropped";

function file(path: string, size = 10): DroppedFile {
  return { path, size, content: async () => new Blob() };
}
const first = (...paths: string[]) => worldsFirst(paths.map((path) => file(path))).files[0]!.path;

test("in a folder, the world file is sent first", () => {
  expect(first("a/meshes/x.stl", "a/models/box/model.sdf", "a/b/deep.world", "a/room.world")).toBe("a/room.world");
  expect(first("box/model.config", "box/model.sdf")).toBe("box/model.sdf");
  expect(worldsFirst([file("m.stl"), file("w.sdf")]).files.map(({ path }) => path)).toEqual(["w.sdf", "m.stl"]);
});

test("all worlds can be chosen, but not the models beside them", () => {
  const worlds = (...paths: string[]) => {
    const { files, worlds: count } = worldsFirst(paths.map((path) => file(path)));
    return files.slice(0, count).map(({ path }) => path);
  };
  expect(worlds("models/box/model.sdf", "worlds/b.world", "worlds/deep/a.world", "worlds/c.sdf")).toEqual([
    "worlds/b.world",
    "worlds/deep/a.world",
    "worlds/c.sdf",
  ]);
  expect(worlds("b/model.sdf", "a/model.sdf")).toEqual(["a/model.sdf"]);
});

test("a single file is sent whatever its name is, and the server reports its errors", () => {
  expect(first("holiday.jpg")).toBe("holiday.jpg");
});

test("too large files, too many files, and files without a world are rejected with a sentence", () => {
  expect(() => worldsFirst([file("big.sdf", 2 ** 31)])).toThrow("big.sdf has 2048 MiB; at most 64 MiB");
  expect(() => worldsFirst([file("a.stl"), file("b.stl")])).toThrow("These files contain no world");
  expect(() => worldsFirst(Array.from({ length: 2001 }, (_, i) => file(`${i}.sdf`)))).toThrow("2001 files");
});

test("only a single archive is unpacked", async () => {
  const files = [file("a.zip"), file("w.world")];
  expect(await unpacked(files)).toBe(files);
  expect(await unpacked(files.slice(1))).toEqual(files.slice(1));
  const zip = { ...file("a.zip"), content: async () => new Blob([new Uint8Array([0x50, 0x4b, 3, 4])]) };
  await expect(unpacked([zip])).rejects.toThrow("a.zip cannot be used: its list of files is missing or damaged");
});
