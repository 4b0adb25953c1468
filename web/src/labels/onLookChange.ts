// Calls `listener` when the page changes its colours, or the screen its number of pixels for a CSS
// pixel.
export function onLookChange(listener: () => void): void {
  for (const query of ["(prefers-color-scheme: dark)", "(forced-colors: active)"]) {
    matchMedia(query).addEventListener("change", listener);
  }
  // The query is about the present ratio, so each change needs a new query.
  const watchRatio = () => {
    const changed = () => {
      listener();
      watchRatio();
    };
    matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener("change", changed, { once: true });
  };
  watchRatio();
}
