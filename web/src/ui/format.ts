// Formats numbers for the page.

// Returns "1:15.25" for 75.25, and "1:01:15.25" for 3675.25. The last digit is never rounded up.
export function formatTime(seconds: number): string {
  const hundredths = Math.max(0, Math.floor(seconds * 100 + 1e-6));
  const two = (value: number) => String(value).padStart(2, "0");
  const s = Math.floor(hundredths / 100);
  const tail = `${two(s % 60)}.${two(hundredths % 100)}`;
  const minutes = Math.floor(s / 60);
  if (minutes < 60) return `${minutes}:${tail}`;
  return `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${tail}`;
}

// Parses a time such as "75.25", "1:15.25" or "1:01:15". Returns null for other texts.
export function parseTime(text: string): number | null {
  const parts = text.trim().split(":");
  const isTime = parts.length <= 3 && parts.every((part) => /^\d+(\.\d*)?$/.test(part));
  return isTime ? parts.reduce((sum, part) => 60 * sum + Number(part), 0) : null;
}

// Returns "0.99×" for 0.9871, "12.3×" for 12.34, and "250×" for 250.2.
export function formatFactor(factor: number): string {
  const digits = factor < 10 ? 2 : factor < 100 ? 1 : 0;
  return `${factor.toFixed(digits)}×`;
}

// Returns "0.12 m" for 0.123, and "1.23 km" for 1234.5.
export function formatDistance(metres: number): string {
  if (metres >= 1000) return `${(metres / 1000).toFixed(2)} km`;
  return `${metres.toFixed(metres < 100 ? 2 : 1)} m`;
}

// Returns the number as text: "0", never "-0".
export function formatNumber(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

// Returns a measured value with its unit and a readable number of digits. Degrees of latitude and
// longitude are rounded to about a centimetre.
export function formatValue(value: number, unit: string): string {
  const tail = unit === "" ? "" : unit === "°" ? unit : ` ${unit}`;
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return `${value < 0 ? "−" : ""}∞${tail}`;
  const size = Math.abs(value);
  if (Number.isInteger(value) && unit === "") return `${value}`;
  if (size > 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(3) + tail;
  return formatNumber(value, unit === "°" ? 7 : size >= 1000 ? 1 : 3) + tail;
}

// Returns "12,345 messages" for 12345 and "message".
export function count(number: number, one: string, many = `${one}s`): string {
  return `${number.toLocaleString("en")} ${number === 1 ? one : many}`;
}

// Returns "1.5 MB" for 1_500_000.
export function formatSize(bytes: number): string {
  if (bytes < 1e6) return `${Math.round(bytes / 1e3)} kB`;
  return bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
}

// Returns "2026-01-31T23:59:59Z" in the user's local format; empty if the text is no date.
export function formatDate(text: string): string {
  const date = new Date(text);
  if (Number.isNaN(date.getTime())) return "";
  return date.toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
}
