// Determines which part of the world is shown as selected in the inspectors, the tree and the view.
import type { State } from "./State";
import type { WorldPart } from "./worldPart";

export function bodyPart(body: string): WorldPart {
  return { body, kind: "body", name: body };
}

// The part that inspectors and the tree show. This is the selected part. If there is none, it is
// the edited object, or else the selected robot.
export function shownPart({ part, editing, selection }: Pick<State, "part" | "editing" | "selection">): WorldPart | null {
  if (part) return part;
  const body = editing?.chosen ?? selection;
  return body === null ? null : bodyPart(body);
}

// The object that the view marks. In edit mode, this is the edited object. Otherwise, it is the
// body of the selected part, unless this body is the selected robot. Null if there is none.
export function markedObject({ part, editing, selection }: State): string | null {
  if (editing) return editing.chosen;
  return part === null || part.body === selection ? null : part.body;
}
