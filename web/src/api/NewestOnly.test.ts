import { expect, test, vi } from "vitest";
import { NewestOnly } from "./NewestOnly";

test("of the requests during a call, only the last one is sent", async () => {
  const answers: (() => void)[] = [];
  const sent: number[] = [];
  const wishes = new NewestOnly<number>(
    (wish) => {
      sent.push(wish);
      return new Promise((resolve) => answers.push(resolve));
    },
    () => {},
  );
  for (const wish of [1, 2, 3]) wishes.push(wish);
  expect(sent).toEqual([1]);
  answers.shift()!();
  await vi.waitFor(() => expect(sent).toEqual([1, 3]));
  answers.shift()!();
});

test("a failure is reported, and the next request is sent", async () => {
  const problems: string[] = [];
  let calls = 0;
  const wishes = new NewestOnly<number>(
    async () => {
      if (++calls === 1) throw new Error("viewer 2 has control");
    },
    (sentence) => problems.push(sentence),
  );
  wishes.push(1);
  await vi.waitFor(() => expect(problems).toEqual(["viewer 2 has control"]));
  wishes.push(2);
  expect(calls).toBe(2);
});
