// A file that the user dropped onto the page or chose, or a file inside a dropped or chosen zip
// archive.
export interface DroppedFile {
  path: string; // "world.sdf", "folder/meshes/cube.stl"
  size: number; // bytes
  content(): Promise<Blob>;
}

export const LARGEST_FILE = 64 * 2 ** 20; // maximum size of a file that the server accepts, bytes
export const MOST_FILES = 2000;

export function droppedFile(path: string, file: File): DroppedFile {
  return { path, size: file.size, content: async () => file };
}

export function isHidden(path: string): boolean {
  return path.split("/").some((part) => part.startsWith("."));
}
