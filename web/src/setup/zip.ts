// Zip archives of a world with what belongs to it (PKWARE's APPNOTE.TXT, sections 4.3 and 4.4): read
// here, in the page, so that the server gets plain files under the limits and the names that it allows.
//
// Input    hostile. The list at the archive's end is believed before anything is unpacked, and held to
//          while it is: a file that turns out longer than it said, or damaged, is refused.
// Bounded  MOST_FILES, LARGEST_FILE, LARGEST_TOTAL; one file is in memory at a time.
import { crc32 } from "./crc32";
import type { DroppedFile } from "./DroppedFile";
import { isHidden, LARGEST_FILE, MOST_FILES } from "./DroppedFile";

const LARGEST_TOTAL = 512 * 2 ** 20; // bytes, unpacked
const LARGEST_LIST = 2 ** 20; // bytes
const LONGEST_COMMENT = 0xffff;

const END = { signature: 0x06054b50, bytes: 22 };
const ENTRY = { signature: 0x02014b50, bytes: 46 };
const LOCAL = { signature: 0x04034b50, bytes: 30 };
const STORED = 0;
const DEFLATED = 8;
const IS_ENCRYPTED = 0x0001;
const IS_UTF8 = 0x0800;
const IN_ZIP64 = 0xffffffff;
const FILE_TYPE = 0xf000; // of Unix's modes
const SYMBOLIC_LINK = 0xa000;

export type Inflate = () => ReadableWritablePair<Uint8Array, Uint8Array>;

const inflateHere: Inflate = () =>
  new DecompressionStream("deflate-raw") as ReadableWritablePair<Uint8Array, Uint8Array>;

interface Entry {
  path: string;
  flags: number;
  method: number;
  crc: number;
  packed: number; // bytes
  size: number; // bytes, unpacked
  mode: number; // Unix's; 0: not told
  at: number; // of its own header
}

export async function isZip(file: Blob): Promise<boolean> {
  const bytes = await viewOf(file, 0, 4);
  const signature = bytes.byteLength === 4 ? bytes.getUint32(0, true) : 0;
  return signature === LOCAL.signature || signature === END.signature;
}

// Its files, each unpacked when its content is asked for; folders and hidden files are left out. Throws
// a sentence for people.
export async function filesInZip(name: string, archive: Blob, inflate: Inflate = inflateHere): Promise<DroppedFile[]> {
  const refuse = (reason: string): never => {
    throw new Error(`${name} cannot be taken: ${reason}.`);
  };
  const entries = (await listOf(archive, refuse)).filter(({ path }) => isWanted(path));
  if (entries.length > MOST_FILES) refuse(`it holds ${entries.length} files; at most ${MOST_FILES} can be taken`);
  for (const entry of entries) check(entry, refuse);
  const total = entries.reduce((sum, { size }) => sum + size, 0);
  if (total > LARGEST_TOTAL) refuse(`unpacked it has ${mebibytes(total)}; at most ${mebibytes(LARGEST_TOTAL)} can be taken`);
  return entries.map((entry) => ({
    path: entry.path,
    size: entry.size,
    content: () => unpack(archive, entry, inflate, refuse),
  }));
}

type Refuse = (reason: string) => never;

// Neither a folder nor what an operating system keeps for itself. A name with ".." is no hidden one.
function isWanted(path: string): boolean {
  return !path.endsWith("/") && !path.startsWith("__MACOSX/") && (leadsOut(path) || !isHidden(path));
}

function leadsOut(path: string): boolean {
  return path.startsWith("/") || /[\\:\0]/.test(path) || path.split("/").includes("..");
}

function mebibytes(bytes: number): string {
  return `${Math.round(bytes / 2 ** 20)} MiB`;
}

function check({ path, flags, method, size, mode }: Entry, refuse: Refuse): void {
  if (leadsOut(path)) refuse(`the name ${JSON.stringify(path.slice(0, 80))} in it leads out of it`);
  if ((mode & FILE_TYPE) === SYMBOLIC_LINK) refuse(`${path} in it is a symbolic link`);
  if ((flags & IS_ENCRYPTED) !== 0) refuse(`${path} in it is encrypted`);
  if (method !== STORED && method !== DEFLATED) refuse(`${path} in it is packed by a method that is not known here`);
  if (size > LARGEST_FILE) refuse(`${path} in it has ${mebibytes(size)} unpacked; at most ${mebibytes(LARGEST_FILE)} can be taken`);
}

// What the list at the archive's end says.
async function listOf(archive: Blob, refuse: Refuse): Promise<Entry[]> {
  const tail = await viewOf(archive, Math.max(0, archive.size - END.bytes - LONGEST_COMMENT), archive.size);
  let end = tail.byteLength - END.bytes;
  while (end >= 0 && tail.getUint32(end, true) !== END.signature) --end;
  if (end < 0) refuse("its end is missing, as if it was cut off");
  const count = tail.getUint16(end + 10, true);
  const bytes = tail.getUint32(end + 12, true);
  const at = tail.getUint32(end + 16, true);
  if (tail.getUint16(end + 4, true) !== 0) refuse("it is one of several parts");
  if (at === IN_ZIP64 || bytes > LARGEST_LIST) refuse("it is too large");
  const list = await viewOf(archive, at, at + bytes);
  const entries: Entry[] = [];
  let place = 0;
  for (let i = 0; i < count; ++i) {
    if (place + ENTRY.bytes > list.byteLength || list.getUint32(place, true) !== ENTRY.signature) refuse("its list of files is damaged");
    const nameBytes = list.getUint16(place + 28, true);
    const next = place + ENTRY.bytes + nameBytes + list.getUint16(place + 30, true) + list.getUint16(place + 32, true);
    if (next > list.byteLength) refuse("its list of files is damaged");
    const flags = list.getUint16(place + 8, true);
    entries.push({
      path: nameOf(new Uint8Array(list.buffer, place + ENTRY.bytes, nameBytes), flags),
      flags,
      method: list.getUint16(place + 10, true),
      crc: list.getUint32(place + 16, true),
      packed: list.getUint32(place + 20, true),
      size: list.getUint32(place + 24, true),
      mode: list.getUint32(place + 38, true) >>> 16,
      at: list.getUint32(place + 42, true),
    });
    place = next;
  }
  return entries;
}

// Older archives do not say what their names are written in: most are ASCII.
function nameOf(bytes: Uint8Array, flags: number): string {
  return new TextDecoder((flags & IS_UTF8) !== 0 ? "utf-8" : "windows-1252").decode(bytes);
}

async function unpack(archive: Blob, entry: Entry, inflate: Inflate, refuse: Refuse): Promise<Blob> {
  const header = await viewOf(archive, entry.at, entry.at + LOCAL.bytes);
  if (header.byteLength < LOCAL.bytes || header.getUint32(0, true) !== LOCAL.signature) refuse(`${entry.path} in it is damaged`);
  const from = entry.at + LOCAL.bytes + header.getUint16(26, true) + header.getUint16(28, true);
  const packed = archive.slice(from, from + entry.packed);
  const stream = packed.stream() as ReadableStream<Uint8Array>;
  const reader = (entry.method === STORED ? stream : stream.pipeThrough(inflate())).getReader();
  const content = new Uint8Array(entry.size);
  let filled = 0;
  for (;;) {
    const { done, value } = await reader.read().catch(() => refuse(`${entry.path} in it is damaged`));
    if (done) break;
    if (filled + value.length > content.length) {
      void reader.cancel().catch(() => {});
      refuse(`${entry.path} in it is longer than it says`);
    }
    content.set(value, filled);
    filled += value.length;
  }
  if (filled !== content.length || crc32(content) !== entry.crc) refuse(`${entry.path} in it is damaged`);
  return new Blob([content]);
}

async function viewOf(file: Blob, from: number, to: number): Promise<DataView> {
  return new DataView(await file.slice(from, to).arrayBuffer());
}
