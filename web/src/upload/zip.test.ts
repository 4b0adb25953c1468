import { execFileSync } from "node:child_process";
import { expect, test, vi } from "vitest";
import { filesInZip, isZip } from "./zip";

vi.setConfig({ testTimeout: 60_000 }); // each archive is made by another process

// The archives are made by Python's zipfile.
const MAKE = `
import io, json, sys, zipfile
out = io.BytesIO()
with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
    for entry in json.load(sys.stdin):
        info = zipfile.ZipInfo(entry["path"])
        info.compress_type = zipfile.ZIP_STORED if entry.get("stored") else zipfile.ZIP_DEFLATED
        info.external_attr = entry.get("mode", 0o100644) << 16
        archive.writestr(info, entry.get("text", "") * entry.get("times", 1))
sys.stdout.buffer.write(out.getvalue())
`;
interface Made {
  path: string;
  text?: string;
  times?: number;
  mode?: number;
  stored?: boolean;
}

function zipped(...entries: Made[]): Uint8Array {
  const options = { input: JSON.stringify(entries), maxBuffer: 2 ** 26 };
  return new Uint8Array(execFileSync("/usr/bin/python3", ["-I", "-S", "-c", MAKE], options));
}

const file = (bytes: Uint8Array) => new File([bytes as BlobPart], "my.zip");
const read = (bytes: Uint8Array) => filesInZip("my.zip", file(bytes));

// Sets a field in each entry of the archive's central directory. `offset` is the position of the
// field in the entry.
function patched(bytes: Uint8Array, offset: number, value: number, size: 2 | 4 = 4): Uint8Array {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  for (let at = 0; at + 46 < bytes.length; ++at) {
    if (view.getUint32(at, true) !== 0x02014b50) continue;
    if (size === 2) view.setUint16(at + offset, value, true);
    else view.setUint32(at + offset, value, true);
  }
  return bytes;
}

test("its files are unpacked as they were, deflated or stored, without folders and hidden ones", async () => {
  const long = "solid cube\n".repeat(10_000);
  const files = await read(
    zipped(
      { path: "lab/", mode: 0o40755 },
      { path: "lab/räum.world", text: "<sdf/>" },
      { path: "lab/meshes/cube.stl", text: long },
      { path: "lab/plain.txt", text: "as it is", stored: true },
      { path: "lab/empty" },
      { path: "lab/.git/config", text: "x" },
      { path: "__MACOSX/lab/räum.world", text: "x" },
    ),
  );
  const found = await Promise.all(files.map(async ({ path, size, content }) => [path, size, await (await content()).text()]));
  expect(found).toEqual([
    ["lab/räum.world", 6, "<sdf/>"],
    ["lab/meshes/cube.stl", long.length, long],
    ["lab/plain.txt", 8, "as it is"],
    ["lab/empty", 0, ""],
  ]);
});

test("an archive is recognised by its first bytes", async () => {
  expect(await isZip(file(zipped({ path: "a" })))).toBe(true);
  expect(await isZip(file(zipped()))).toBe(true);
  expect(await isZip(new File(["<sdf/>"], "a.zip"))).toBe(false);
  expect(await isZip(new File(["P"], "a.zip"))).toBe(false);
});

test.each([
  ["../a.world", 'must be a relative path without "..", ":" or backslashes'],
  ["a/../../b", 'must be a relative path without "..", ":" or backslashes'],
  ["/etc/passwd", 'must be a relative path without "..", ":" or backslashes'],
  ["C:\\b", 'must be a relative path without "..", ":" or backslashes'],
  ["a\\b", 'must be a relative path without "..", ":" or backslashes'],
])("the name %s is refused", async (path, reason) => {
  await expect(read(zipped({ path: "w.world" }, { path }))).rejects.toThrow(`my.zip cannot be used: the name ${JSON.stringify(path)} ${reason}.`);
});

test("links, encryption and unknown methods are rejected", async () => {
  await expect(read(zipped({ path: "l", text: "/etc/passwd", mode: 0o120777 }))).rejects.toThrow("l in the archive is a symbolic link");
  await expect(read(patched(zipped({ path: "a" }), 8, 1, 2))).rejects.toThrow("a in the archive is encrypted");
  await expect(read(patched(zipped({ path: "a" }), 10, 14, 2))).rejects.toThrow("uses an unsupported compression method");
});

test("a too large archive is rejected before anything is unpacked", async () => {
  await expect(read(patched(zipped({ path: "a" }), 24, 2 ** 31))).rejects.toThrow("a in the archive has 2048 MiB unpacked; at most 64 MiB are allowed");
  const nine = Array.from({ length: 9 }, (_, i) => ({ path: `${i}` }));
  await expect(read(patched(zipped(...nine), 24, 60 * 2 ** 20))).rejects.toThrow("unpacked it has 540 MiB; at most 512 MiB are allowed");
  const many = Array.from({ length: 2001 }, (_, i) => ({ path: `${i}` }));
  await expect(read(zipped(...many))).rejects.toThrow("it contains 2001 files; at most 2000 are allowed");
});

test("a damaged file, or one of a wrong size, is rejected while it is unpacked", async () => {
  const unpack = async (bytes: Uint8Array) => (await read(bytes))[0]!.content();
  const bomb = () => zipped({ path: "a", text: "0", times: 2 ** 22 });
  await expect(unpack(patched(bomb(), 24, 100))).rejects.toThrow("a in the archive is longer than declared");
  await expect(unpack(patched(bomb(), 24, 2 ** 22 + 1))).rejects.toThrow("a in the archive is damaged");
  await expect(unpack(patched(bomb(), 16, 1))).rejects.toThrow("a in the archive is damaged");
  await expect(unpack(patched(bomb(), 42, 7))).rejects.toThrow("a in the archive is damaged");
  await expect(unpack(patched(bomb(), 42, 2 ** 31))).rejects.toThrow("a in the archive is damaged");
});

test("a truncated archive, or one with a wrong directory, is rejected", async () => {
  const bytes = zipped({ path: "a", text: "x" });
  await expect(read(bytes.slice(0, -10))).rejects.toThrow("its list of files is missing or damaged");
  await expect(read(bytes.slice(0, 4))).rejects.toThrow("its list of files is missing or damaged");
  const counted = zipped({ path: "a" });
  for (const back of [12, 14]) new DataView(counted.buffer).setUint16(counted.length - back, 9, true);
  await expect(read(counted)).rejects.toThrow("its list of files is missing or damaged");
});
