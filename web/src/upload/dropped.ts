// Handles files that the user dropped onto the page or chose. They are a world, or a folder or zip
// archive that contains a world.
import type { DroppedFile } from "../api/DroppedFile";
import { droppedFile, isHidden, LARGEST_FILE, MOST_FILES } from "../api/DroppedFile";
import { filesInZip, isZip } from "./zip";

// The files to send. World files are first, beginning with the most likely world.
export interface Delivery {
  files: DroppedFile[];
  worlds: number; // number of worlds among the files, at least one
}

// Finds the files to send. Throws an error with a message for the user.
export function worldsFirst(files: readonly DroppedFile[]): Delivery {
  if (files.length > MOST_FILES) throw new Error(`You chose ${files.length} files; at most ${MOST_FILES} are allowed.`);
  const large = files.find(({ size }) => size > LARGEST_FILE);
  if (large) {
    throw new Error(`${large.path} has ${Math.round(large.size / 2 ** 20)} MiB; at most 64 MiB are allowed.`);
  }
  if (files.length === 1) return { files: [...files], worlds: 1 };
  const candidates = files.filter(({ path }) => rankOf(path) < NO_WORLD).sort(byLikelihood);
  if (candidates.length === 0) throw new Error("These files contain no world. Add a file whose name ends in .world, .sdf or .urdf.");
  // If there are world files, models are parts of these worlds. So the user cannot choose a model.
  const worlds = candidates.filter(({ path }) => rankOf(path) < A_MODEL);
  const front = new Set(worlds.length > 0 ? worlds : candidates.slice(0, 1));
  return { files: [...front, ...files.filter((each) => !front.has(each))], worlds: front.size };
}

// Sorts world files before model files, and files in outer folders before files in inner folders.
function byLikelihood(a: DroppedFile, b: DroppedFile): number {
  const depth = ({ path }: DroppedFile) => path.split("/").length;
  return rankOf(a.path) - rankOf(b.path) || depth(a) - depth(b) || a.path.localeCompare(b.path);
}

const A_MODEL = 2;
const NO_WORLD = 9;

function rankOf(path: string): number {
  if (/\.world$/i.test(path)) return 0;
  if (/(^|\/)model[^/]*\.sdf$/i.test(path)) return A_MODEL;
  if (/\.sdf$/i.test(path)) return 1;
  return /\.urdf$/i.test(path) ? 3 : NO_WORLD;
}

// If there is a single file and it is an archive, returns its content. If this fails, throws an
// error with a message for the user.
export async function unpacked(files: readonly DroppedFile[]): Promise<readonly DroppedFile[]> {
  const [only, ...others] = files;
  if (!only || others.length > 0) return files;
  const content = await only.content();
  return (await isZip(content)) ? filesInZip(only.path, content) : files;
}

// Returns all dropped files, including the content of folders. Hidden files are left out.
export async function droppedFiles(transfer: DataTransfer): Promise<DroppedFile[]> {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  if (entries.length === 0) return [...transfer.files].map((file) => droppedFile(file.name, file));
  return (await Promise.all(entries.map((entry) => filesOf(entry, "")))).flat();
}

// Returns the files of a chosen folder.
export function chosenFiles(list: FileList): DroppedFile[] {
  return [...list]
    .map((file) => droppedFile(file.webkitRelativePath || file.name, file))
    .filter(({ path }) => !isHidden(path));
}

async function filesOf(entry: FileSystemEntry, above: string): Promise<DroppedFile[]> {
  if (entry.name.startsWith(".")) return [];
  const path = above + entry.name;
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
    return [droppedFile(path, file)];
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const found: DroppedFile[] = [];
  for (;;) {
    // A reader returns at most a hundred entries per call.
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return found;
    for (const each of some) found.push(...(await filesOf(each, `${path}/`)));
    if (found.length > MOST_FILES) return found; // too many files
  }
}
