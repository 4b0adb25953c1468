// Warnings of the server, such as sensors that cannot be read and messages that cannot be decoded.
const MAX_WARNINGS = 50;

// Returns the warnings with the sentence as the newest warning. Each sentence occurs only once.
export function withServerWarning(warnings: readonly string[], sentence: string): readonly string[] {
  return [...warnings.filter((each) => each !== sentence), sentence].slice(-MAX_WARNINGS);
}
