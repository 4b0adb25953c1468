// Formats numbers for people.

// 75.25 → "1:15.25"; from one hour on "1:01:15.25". The last digit is never rounded up.
export function formatTime(seconds: number): string {
  const hundredths = Math.max(0, Math.floor(seconds * 100 + 1e-6));
  const two = (value: number) => String(value).padStart(2, "0");
  const s = Math.floor(hundredths / 100);
  const tail = `${two(s % 60)}.${two(hundredths % 100)}`;
  const minutes = Math.floor(s / 60);
  if (minutes < 60) return `${minutes}:${tail}`;
  return `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${tail}`;
}

// The inverse for typed texts: "75.25", "1:15.25", "1:01:15"; null if it is not a time.
export function parseTime(text: string): number | null {
  const parts = text.trim().split(":");
  const isTime = parts.length <= 3 && parts.every((part) => /^\d+(\.\d*)?$/.test(part));
  return isTime ? parts.reduce((sum, part) => 60 * sum + Number(part), 0) : null;
}

// 0.9871 → "0.99×", 12.34 → "12.3×", 250.2 → "250×".
export function formatFactor(factor: number): string {
  const digits = factor < 10 ? 2 : factor < 100 ? 1 : 0;
  return `${factor.toFixed(digits)}×`;
}

// 0.123 → "0.12 m", 1234.5 → "1.23 km".
export function formatDistance(metres: number): string {
  if (metres >= 1000) return `${(metres / 1000).toFixed(2)} km`;
  return `${metres.toFixed(metres < 100 ? 2 : 1)} m`;
}

// Writes "0" and never "-0".
export function formatNumber(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

// A measured value with its unit: a readable number of digits, degrees of latitude and longitude to
// about a centimetre.
export function formatValue(value: number, unit: string): string {
  const tail = unit === "" ? "" : unit === "°" ? unit : ` ${unit}`;
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return `${value < 0 ? "−" : ""}∞${tail}`;
  const size = Math.abs(value);
  if (Number.isInteger(value) && unit === "") return `${value}`;
  if (size > 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(3) + tail;
  return formatNumber(value, unit === "°" ? 7 : size >= 1000 ? 1 : 3) + tail;
}

// 12345, "message" → "12,345 messages".
export function count(number: number, one: string, many = `${one}s`): string {
  return `${number.toLocaleString("en")} ${number === 1 ? one : many}`;
}

// 1_500_000 → "1.5 MB".
export function formatSize(bytes: number): string {
  if (bytes < 1e6) return `${Math.round(bytes / 1e3)} kB`;
  return bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
}

// "2026-01-31T23:59:59Z" in the user's local format; empty: the text is not a date.
export function formatDate(text: string): string {
  const date = new Date(text);
  if (Number.isNaN(date.getTime())) return "";
  return date.toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
}
