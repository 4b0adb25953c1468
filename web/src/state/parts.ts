// A part of the world that the user has selected: an object, or a link, joint or sensor of any body.
import type { State } from "./State";

export interface WorldPart {
  body: string;
  kind: "body" | "link" | "joint" | "sensor";
  name: string; // that of the body itself for the kind "body"
}

export function bodyPart(body: string): WorldPart {
  return { body, kind: "body", name: body };
}

// The part that inspectors and the tree show: the selected part, or else the edited object or the selected robot.
export function shownPart({ part, editing, selection }: Pick<State, "part" | "editing" | "selection">): WorldPart | null {
  if (part) return part;
  const body = editing?.chosen ?? selection;
  return body === null ? null : bodyPart(body);
}

// The object that the view marks: the edited one, or the one that the inspector shows.
export function markedObject({ part, editing, selection }: State): string | null {
  if (editing) return editing.chosen;
  return part === null || part.body === selection ? null : part.body;
}
