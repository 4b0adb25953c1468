// Fails if the files that a browser fetches for the page exceed 700 kB, compressed, or if the
// script of <gsv-view> exceeds 8 kB.
//
//   node check_size.mjs DIST
import fs from "node:fs";
import path from "node:path";
import process from "node:process";
import { gzipSync } from "node:zlib";

const LARGEST_BYTES = 700_000;
const EMBED = "gsv-view.js"; // no part of the page
const LARGEST_EMBED_BYTES = 8000;

const dist = process.argv[2];
let total = 0;
for (const name of fs.readdirSync(dist, { recursive: true })) {
  const file = path.join(dist, name);
  if (!fs.statSync(file).isFile()) continue;
  const bytes = gzipSync(fs.readFileSync(file), { level: 9 }).length;
  if (name === EMBED) {
    if (bytes > LARGEST_EMBED_BYTES) process.exitCode = 1;
  } else {
    total += bytes;
  }
  console.log(`${String(bytes).padStart(8)}  ${name}`);
}
console.log(`${String(total).padStart(8)}  in all, of ${LARGEST_BYTES}`);
if (total === 0 || total > LARGEST_BYTES) process.exitCode = 1;
