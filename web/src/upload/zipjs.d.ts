// The types of the part of zip.js that reads on the page's own thread. The package has types only
// for the complete library.
declare module "@zip.js/zip.js/lib/zip-no-worker-inflate.js" {
  export { BlobReader, ZipReader } from "@zip.js/zip.js";
}
