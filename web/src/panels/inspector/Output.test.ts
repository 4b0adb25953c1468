// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import { robotStatus, simulationStatus } from "../../page/testApp";
import { testPorts } from "../contract/testPorts";
import { createOutput } from "./Output";

function message(sec: number, msg: string) {
  return { stamp: { sec, nsec: 0 }, level: 40, name: "a", msg };
}

test("lines that were already requested are not repeated, and a reset starts again", async () => {
  const { ports, store, topics } = testPorts(
    { selection: "a", time: 60, health: { robots: [] } as never, status: simulationStatus("running", { robots: [robotStatus("a")] }) },
    { output: vi.fn(async () => [{ time: 60, level: 20, text: "last" }]) },
  );
  const lines = () => [...createdLines.querySelectorAll(".output-lines div")].map((line) => line.textContent);
  const createdLines = createOutput(ports);
  await vi.waitFor(() => expect(topics.read).toEqual(["/gsv/output"]));
  topics.send("/gsv/output", message(60, "last"));
  topics.send("/gsv/output", message(61, "next"));
  expect(lines()).toEqual(["last", "next"]);
  store.set({ time: 4.9 });
  topics.send("/gsv/output", message(5, "wrong"));
  expect(lines()).toEqual(["last", "next", "wrong"]);
});
