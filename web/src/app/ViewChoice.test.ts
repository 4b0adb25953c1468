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
  return { choice, store, drawer: () => store.get().drawnBy, use, sentences };
}

function tell(choice: ViewChoice, framesPerSecond: number, seconds: number): void {
  for (let i = 0; i < seconds; i++) choice.frameRate(framesPerSecond);
}

test("without WebGL the server draws, and there is no choice", () => {
  const { choice, store, drawer, use, sentences } = started({ canDraw: false });
  expect(drawer()).toBe("server");
  expect(use).toHaveBeenCalledWith("server");
  expect(store.get().whyNotBrowser).toContain("no WebGL");
  expect(choice.serverFailed()).toBe(false);
  expect(sentences).toEqual([expect.stringContaining("no WebGL")]);
});

test("after a refusal, the server is asked again if the user wants", () => {
  const { choice, drawer, use } = started({ canDraw: false });
  choice.serverFailed();
  choice.askServerAgain();
  expect(drawer()).toBe("server");
  expect(use).toHaveBeenCalledTimes(2);
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

test("if the browser loses WebGL and does not get it back, the server draws until WebGL is there again", () => {
  vi.useFakeTimers();
  const { choice, drawer, store, sentences } = started({ inSoftware: false, chosen: "browser" });
  choice.graphics(false);
  vi.advanceTimersByTime(2500);
  choice.graphics(true); // a short loss changes nothing
  vi.advanceTimersByTime(10_000);
  expect(drawer()).toBe("browser");
  expect(sentences).toEqual([]);
  choice.graphics(false);
  vi.advanceTimersByTime(3000);
  expect(drawer()).toBe("server");
  expect(store.get().whyNotBrowser).toContain("lost the graphics card");
  expect(sentences).toEqual([expect.stringContaining("so the server draws the view now")]);
  choice.graphics(true);
  expect(drawer()).toBe("browser");
  expect(store.get().whyNotBrowser).toBe("");
  expect(sentences[1]).toContain("the browser draws the view again");
  // The user's own choice of the server stays.
  choice.choose("server");
  choice.graphics(false);
  vi.advanceTimersByTime(10_000);
  choice.graphics(true);
  expect(drawer()).toBe("server");
  expect(sentences).toHaveLength(2);
  vi.useRealTimers();
});

test("if the server cannot draw either, a lost view stays lost", () => {
  vi.useFakeTimers();
  const { choice, drawer } = started();
  choice.graphics(false);
  vi.advanceTimersByTime(3000);
  expect(choice.serverFailed()).toBe(true);
  vi.advanceTimersByTime(10_000);
  expect(drawer()).toBe("browser");
  vi.useRealTimers();
});

test("the browser draws again, and continues to, if the server cannot draw", () => {
  const { choice, drawer } = started();
  tell(choice, 4, 5);
  expect(choice.serverFailed()).toBe(true);
  tell(choice, 4, 20);
  expect(drawer()).toBe("browser");
});
