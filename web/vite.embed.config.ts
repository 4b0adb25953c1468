// <gsv-view> as one script without imports (src/embed/).
import { defineConfig } from "vite";

export default defineConfig({
  build: {
    target: "es2022",
    emptyOutDir: false, // the page is there already
    copyPublicDir: false,
    reportCompressedSize: false,
    lib: { entry: "src/embed/main.ts", formats: ["iife"], name: "GsvView", fileName: () => "gsv-view.js" },
  },
});
