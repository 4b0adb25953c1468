// The pages other than the viewer.
export interface Page {
  name: string;
  href: string;
}

export const JOIN: Page = { name: "Join", href: "join.html" };
export const RECORDINGS: Page = { name: "Recordings", href: "recordings.html" };
export const BROKER: Page = { name: "Broker", href: "broker.html" };
