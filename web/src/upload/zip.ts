// Reads zip archives that contain a world and its files. The page unpacks them, so that the server
// receives plain files with limited size and valid names.
//
// Input    untrusted. The listed sizes are checked before anything is unpacked. A file that is
//          longer than its listed size, or damaged, is refused.
// Bounded  MOST_FILES, LARGEST_FILE, LARGEST_TOTAL; one file is in memory at a time.
import type { Entry } from "@zip.js/zip.js";
import { BlobReader, ZipReader } from "@zip.js/zip.js/lib/zip-no-worker-inflate.js";
import type { DroppedFile } from "../api/DroppedFile";
import { isHidden, LARGEST_FILE, MOST_FILES } from "../api/DroppedFile";

const LARGEST_TOTAL = 512 * 2 ** 20; // bytes, unpacked
const MOST_ENTRIES = 4 * MOST_FILES; // includes folders and hidden files

// The first bytes of a zip archive with files, and the first bytes of an empty archive.
const FIRST_FILE = 0x04034b50;
const NO_FILE = 0x06054b50;
const STORED = 0;
const DEFLATED = 8;
const FILE_TYPE = 0xf000; // mask of the file type in a Unix mode
const SYMBOLIC_LINK = 0xa000;

type Refuse = (reason: string) => never;

export async function isZip(file: Blob): Promise<boolean> {
  const bytes = new DataView(await file.slice(0, 4).arrayBuffer());
  const signature = bytes.byteLength === 4 ? bytes.getUint32(0, true) : 0;
  return signature === FIRST_FILE || signature === NO_FILE;
}

// Returns the files of an archive, each unpacked when its content is requested. Folders and hidden
// files are left out. Throws an error with a message for the user.
export async function filesInZip(name: string, archive: Blob): Promise<DroppedFile[]> {
  const refuse = (reason: string): never => {
    throw new Error(`${name} cannot be used: ${reason}.`);
  };
  const entries = (await listOf(archive, refuse)).filter(isWanted);
  if (entries.length > MOST_FILES) refuse(`it contains ${entries.length} files; at most ${MOST_FILES} are allowed`);
  for (const entry of entries) check(entry, refuse);
  const total = entries.reduce((sum, { uncompressedSize }) => sum + uncompressedSize, 0);
  if (total > LARGEST_TOTAL) refuse(`unpacked it has ${mebibytes(total)}; at most ${mebibytes(LARGEST_TOTAL)} are allowed`);
  return entries.map((entry) => ({
    path: entry.filename,
    size: entry.uncompressedSize,
    content: () => unpack(entry, refuse),
  }));
}

// Whether the entry is a normal file. It must be neither a folder nor a hidden file of an operating
// system. A path that leads out of the archive's folder, for example with "..", is not counted as
// hidden, so that check() refuses it.
function isWanted({ filename, directory }: Entry): boolean {
  return !directory && !filename.startsWith("__MACOSX/") && (leadsOut(filename) || !isHidden(filename));
}

function leadsOut(path: string): boolean {
  return path.startsWith("/") || /[\\:\0]/.test(path) || path.split("/").includes("..");
}

function mebibytes(bytes: number): string {
  return `${Math.round(bytes / 2 ** 20)} MiB`;
}

function check({ filename, encrypted, compressionMethod, uncompressedSize, externalFileAttributes }: Entry, refuse: Refuse): void {
  if (leadsOut(filename)) refuse(`the name ${JSON.stringify(filename.slice(0, 80))} must be a relative path without "..", ":" or backslashes`);
  const unixMode = externalFileAttributes >>> 16;
  if ((unixMode & FILE_TYPE) === SYMBOLIC_LINK) refuse(`${filename} in the archive is a symbolic link`);
  if (encrypted) refuse(`${filename} in the archive is encrypted`);
  if (compressionMethod !== STORED && compressionMethod !== DEFLATED) refuse(`${filename} uses an unsupported compression method`);
  if (uncompressedSize > LARGEST_FILE) refuse(`${filename} in the archive has ${mebibytes(uncompressedSize)} unpacked; at most ${mebibytes(LARGEST_FILE)} are allowed`);
}

async function listOf(archive: Blob, refuse: Refuse): Promise<Entry[]> {
  const reader = new ZipReader(new BlobReader(archive), { checkSignature: true, useWebWorkers: false });
  const entries: Entry[] = [];
  const list = reader.getEntriesGenerator();
  for (;;) {
    const { done, value } = await list.next().catch(() => refuse("its list of files is missing or damaged"));
    if (done) return entries;
    if (entries.push(value) > MOST_ENTRIES) refuse(`it contains more than ${MOST_ENTRIES} files and folders`);
  }
}

async function unpack(entry: Entry, refuse: Refuse): Promise<Blob> {
  const content = new Uint8Array(entry.uncompressedSize);
  let filled = 0;
  let isLonger = false;
  const sink = new WritableStream<Uint8Array>({
    write(chunk) {
      isLonger = filled + chunk.length > content.length;
      if (isLonger) throw new Error("longer than declared");
      content.set(chunk, filled);
      filled += chunk.length;
    },
  });
  try {
    await entry.getData!(sink);
  } catch {
    refuse(`${entry.filename} in the archive is ${isLonger ? "longer than declared" : "damaged"}`);
  }
  if (filled !== content.length) refuse(`${entry.filename} in the archive is damaged`);
  return new Blob([content]);
}
