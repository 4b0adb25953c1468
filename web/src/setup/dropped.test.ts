import { expect, test } from "vitest";
import type { DroppedFile } from "./DroppedFile";
import { unpacked, worldFirst } from "./dropped";

function file(path: string, size = 10): DroppedFile {
  return { path, size, content: async () => new Blob() };
}
const first = (...paths: string[]) => worldFirst(paths.map((path) => file(path)))[0]!.path;

test("of a folder's files the world goes first", () => {
  expect(first("a/meshes/x.stl", "a/models/box/model.sdf", "a/b/deep.world", "a/room.world")).toBe("a/room.world");
  expect(first("box/model.config", "box/model.sdf")).toBe("box/model.sdf");
  expect(worldFirst([file("m.stl"), file("w.sdf")]).map(({ path }) => path)).toEqual(["w.sdf", "m.stl"]);
});

test("a single file is sent whatever its name: the server says what is wrong with it", () => {
  expect(first("holiday.jpg")).toBe("holiday.jpg");
});

test("what is too large, too many, or holds no world is refused with a sentence", () => {
  expect(() => worldFirst([file("big.sdf", 2 ** 31)])).toThrow("big.sdf has 2048 MiB; at most 64 MiB");
  expect(() => worldFirst([file("a.stl"), file("b.stl")])).toThrow("no world among these files");
  expect(() => worldFirst(Array.from({ length: 2001 }, (_, i) => file(`${i}.sdf`)))).toThrow("2001 files");
});

test("only an archive on its own is unpacked", async () => {
  const files = [file("a.zip"), file("w.world")];
  expect(await unpacked(files)).toBe(files);
  expect(await unpacked(files.slice(1))).toEqual(files.slice(1));
  const zip = { ...file("a.zip"), content: async () => new Blob([new Uint8Array([0x50, 0x4b, 3, 4])]) };
  await expect(unpacked([zip])).rejects.toThrow("a.zip cannot be taken: its list of files is missing or damaged");
});
