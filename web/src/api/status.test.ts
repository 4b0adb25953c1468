import { expect, test } from "vitest";
import { parseStatus, parseSummaries, statusFromMessage } from "./status";

const AS_JSON = {
  name: "house",
  phase: "paused",
  mode: "lockstep",
  step: 250,
  time_s: 2.5,
  step_size_s: 0.01,
  target_factor: 1,
  real_time_factor: 3.5,
  late_steps: 4,
  waiting_for: "robbie (wander) since 2.1 s",
  failure: "",
  robots: [
    {
      name: "robbie",
      model: "b21r",
      behaviour: "wander",
      is_avatar: false,
      agent_phase: "waiting",
      detail: "",
      distance_m: 1.25,
      collisions: 2,
    },
  ],
};

test("the status is parsed equally from the API and from the live stream", () => {
  const fromMessage = statusFromMessage({
    stamp: { sec: 2, nsec: 500_000_000 },
    step: 250n,
    state: "paused",
    mode: "lockstep",
    real_time_factor: 3.5,
    target_factor: 1,
    late_steps: 4n,
    waiting_for: "robbie (wander) since 2.1 s",
    robots: [
      {
        name: "robbie",
        model: "b21r",
        behaviour: "wander",
        agent_state: "waiting",
        detail: "",
        distance_m: 1.25,
        collisions: 2n,
      },
    ],
  });
  expect(fromMessage).toEqual(parseStatus(AS_JSON));
});

test("an unknown phase is rejected", () => {
  expect(() => parseStatus({ ...AS_JSON, phase: "asleep" })).toThrow(/found asleep/);
});

test("the list of simulations has names and phases", () => {
  expect(parseSummaries([{ name: "a", phase: "running", robots: 5 }])).toEqual([
    { name: "a", phase: "running", robots: 5 },
  ]);
  expect(() => parseSummaries({ error: "no" })).toThrow("simulations: expected a list, found an object");
});
