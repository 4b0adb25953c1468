// Offers files for download. The page has created these files.

export function download(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  // Release the address later: the browser reads it some time after the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

// Returns a name such as "office view 12.35s.png". It contains only characters that every file
// system accepts.
export function fileName(simulation: string | null, time: number, kind: string, ending: string): string {
  const name = (simulation ?? "gsv").replace(/[^\p{L}\p{N} _.-]+/gu, "_").slice(0, 80);
  return `${name} ${kind} ${time.toFixed(2)}s.${ending}`;
}
