// Who of those who watch may act.
import type { People, Person } from "../api/ViewersApi";

export const NO_PEOPLE: People = { viewers: [], you: 0, holder: 0, asking: [], passesIn: 0 };

// While nobody holds control, all may. The server has the last word.
export function mayAct({ holder, you }: People): boolean {
  return holder === 0 || holder === you;
}

export function personOf({ viewers }: People, number: number): Person | null {
  return viewers.find((viewer) => viewer.number === number) ?? null;
}

// Whose question you have to answer, if there is one.
export function asker(people: People): Person | null {
  const [first] = people.asking;
  return people.holder === people.you && first !== undefined ? personOf(people, first) : null;
}
