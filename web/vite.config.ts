import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

// What the page may load: its own files, its own server's API and socket, and pictures that came
// over them. The development server injects inline styles, so only the built page carries it.
const CONTENT_SECURITY_POLICY = [
  "default-src 'self'",
  "connect-src 'self' blob:",
  "img-src 'self' blob: data:",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

function contentSecurityPolicy(): Plugin {
  return {
    name: "gsv-content-security-policy",
    apply: "build",
    transformIndexHtml: () => [
      {
        tag: "meta",
        attrs: { "http-equiv": "Content-Security-Policy", content: CONTENT_SECURITY_POLICY },
        injectTo: "head-prepend",
      },
    ],
  };
}

// The page's first script loads the main one when it runs. The browser fetches both at the same
// time.
function preloadMain(): Plugin {
  return {
    name: "gsv-preload-main",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler: (_, { bundle, path }) => {
        const main = Object.values(bundle ?? {}).find(
          (chunk) => chunk.type === "chunk" && chunk.moduleIds.some((id) => id.endsWith("/src/main.ts")),
        );
        if (path !== "/index.html" || !main) return [];
        return [{ tag: "link", attrs: { rel: "modulepreload", crossorigin: true, href: `./${main.fileName}` }, injectTo: "head" }];
      },
    },
  };
}

// `npm run dev` shows a simulation that runs elsewhere: GSV_SERVER=http://127.0.0.1:PORT
const server = process.env.GSV_SERVER ?? "http://127.0.0.1:8080";

export default defineConfig({
  base: "./",
  plugins: [contentSecurityPolicy(), preloadMain()],
  build: {
    target: "es2022",
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    chunkSizeWarningLimit: 1500,
    rollupOptions: { input: ["index.html", "broker.html", "join.html", "recordings.html"] },
  },
  server: {
    proxy: {
      "/api": { target: server, changeOrigin: true },
      "/ws": { target: server, changeOrigin: true, ws: true },
    },
  },
  test: {
    environment: "node",
    include: ["src/**/*.test.ts"],
    // Test files share their worker, which saves four fifths of the time: they leave nothing
    // behind.
    pool: "threads",
    isolate: false,
    // Beside browsers on a busy machine what takes a tenth of a second may take five; only what
    // hangs is to end.
    testTimeout: 60_000,
  },
});
