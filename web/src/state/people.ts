// Determines whether this viewer may act on the simulation that the page shows.
import type { People, Person } from "../api/ViewersApi";

export const NO_PEOPLE: People = { viewers: [], you: 0 };

export function youOf({ viewers, you }: People): Person | null {
  return viewers.find(({ number }) => number === you) ?? null;
}

// The viewers of the same simulation.
export function together(people: People): Person[] {
  const simulation = youOf(people)?.simulation ?? "";
  return simulation === "" ? [] : people.viewers.filter((person) => person.simulation === simulation);
}

export function holderOf(people: People): Person | null {
  return together(people).find(({ holds }) => holds) ?? null;
}

// While no viewer has control, all viewers may act. The server makes the final decision.
export function mayAct(people: People): boolean {
  const holder = holderOf(people);
  return holder === null || holder.number === people.you;
}

// Returns the reason why this viewer must take control before driving a body: another viewer has
// control, or other viewers could drive the body at the same time. Empty if it may drive now.
export function needsControl(people: People): string {
  const holder = holderOf(people);
  if (holder !== null) return holder.number === people.you ? "" : `${holder.name} has control.`;
  return together(people).length > 1 ? "Others are watching this simulation. Take control first." : "";
}

// Returns the viewer whose request for control you must answer, if there is one.
export function asker(people: People): Person | null {
  if (!youOf(people)?.holds) return null;
  return together(people).find(({ asks }) => asks === 1) ?? null;
}
