import { expect, test, vi } from "vitest";
import { initialState } from "../state/State";
import type { State } from "../state/State";
import { Store } from "../state/Store";
import type { ChoiceOptions } from "./ViewChoice";
import { ViewChoice } from "./ViewChoice";

function started(options: Partial<ChoiceOptions> = {}) {
  const store = new Store<State>(initialState);
  const use = vi.fn();
  const sentences: string[] = [];
  const choice = new ViewChoice(store, { canDraw: true, inSoftware: true, chosen: null, ...options }, use, (sentence) =>
    sentences.push(sentence),
  );
  choice.start();
  return { choice, drawer: () => store.get().drawnBy, use, sentences };
}

function tell(choice: ViewChoice, framesPerSecond: number, seconds: number): void {
  for (let i = 0; i < seconds; i++) choice.frameRate(framesPerSecond);
}

test("without WebGL the server draws, and there is no choice", () => {
  const { choice, drawer, use, sentences } = started({ canDraw: false });
  expect(drawer()).toBe("server");
  expect(use).toHaveBeenCalledWith("server");
  expect(choice.other).toBeNull();
  expect(choice.serverFailed()).toBe(false);
  expect(sentences).toEqual([expect.stringContaining("no WebGL")]);
});

test("without a graphics card, the server draws after five slow seconds in a row", () => {
  const { choice, drawer, sentences } = started();
  tell(choice, 4, 4);
  tell(choice, 15, 1);
  tell(choice, 4, 4);
  expect(drawer()).toBe("browser");
  expect(sentences).toEqual([]);
  tell(choice, 4, 20);
  expect(drawer()).toBe("server");
  expect(sentences).toEqual([expect.stringContaining("fewer than 10 images per second")]);
});

test("with a graphics card, the browser continues to draw, however slowly", () => {
  const { choice, drawer } = started({ inSoftware: false });
  tell(choice, 4, 20);
  expect(drawer()).toBe("browser");
});

test("a choice by the user is kept", () => {
  const { choice, drawer, sentences } = started();
  choice.choose("server");
  expect(drawer()).toBe("server");
  choice.choose("browser");
  tell(choice, 2, 20);
  expect(drawer()).toBe("browser");
  expect(sentences).toEqual([]);
  const server = started({ chosen: "server" });
  expect(server.drawer()).toBe("server");
  expect(server.sentences).toEqual([]);
  const kept = started({ chosen: "browser" });
  tell(kept.choice, 2, 20);
  expect(kept.drawer()).toBe("browser");
});

test("the browser draws again, and continues to, if the server cannot draw", () => {
  const { choice, drawer } = started();
  tell(choice, 4, 5);
  expect(choice.serverFailed()).toBe(true);
  tell(choice, 4, 20);
  expect(drawer()).toBe("browser");
});
