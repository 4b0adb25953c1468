// What the server complained of: sensors that cannot be read, messages that cannot be decoded.
const MOST_COMPLAINTS = 50;

// With the sentence as the newest one, once.
export function withComplaint(complaints: readonly string[], sentence: string): readonly string[] {
  return [...complaints.filter((each) => each !== sentence), sentence].slice(-MOST_COMPLAINTS);
}
