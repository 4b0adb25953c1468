// The part of zip.js that reads, on the page's own thread: its package has types for the whole only.
declare module "@zip.js/zip.js/lib/zip-no-worker-inflate.js" {
  export { BlobReader, ZipReader } from "@zip.js/zip.js";
}
