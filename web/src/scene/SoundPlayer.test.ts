import { expect, test, vi } from "vitest";
import type { Sound } from "../live/devices";
import { SoundPlayer } from "./SoundPlayer";

const TONE: Sound = { name: "tone", frequency: 440, volume: 0.5, elapsed: 0 };

// A fake of the part of Web Audio that is used, because Node has none.
function audio() {
  const started: { type: string; frequency: number; stop: ReturnType<typeof vi.fn> }[] = [];
  const parameter = () => ({
    setValueAtTime: vi.fn(),
    linearRampToValueAtTime: vi.fn(),
    exponentialRampToValueAtTime: vi.fn(),
    setTargetAtTime: vi.fn(),
  });
  const context = {
    state: "running",
    currentTime: 0,
    sampleRate: 8000,
    destination: {},
    createGain: () => ({ gain: parameter(), connect: (next: unknown) => next }),
    createOscillator: () => {
      const frequency = parameter();
      const node = { type: "", frequency, connect: (next: unknown) => next, start: vi.fn(), stop: vi.fn() };
      node.start.mockImplementation(() =>
        started.push({
          type: node.type,
          frequency: frequency.setValueAtTime.mock.calls[0]![0] as number,
          stop: node.stop,
        }),
      );
      return node;
    },
  };
  return { player: new SoundPlayer(() => context as unknown as AudioContext), started };
}

test("a tone starts once, continues with later messages, and ends with the sound", () => {
  const { player, started } = audio();
  player.play(new Map([["/a/speaker", TONE]]));
  player.play(new Map([["/a/speaker", { ...TONE, elapsed: 0.1 }]]));
  expect(started).toHaveLength(1);
  expect(started[0]).toMatchObject({ type: "sine", frequency: 440 });
  expect(started[0]!.stop).not.toHaveBeenCalled();
  player.play(new Map());
  expect(started[0]!.stop).toHaveBeenCalledOnce();
  expect(player.playing).toBe(0);
});

test("a new sound starts, and a sound that the robot plays again starts again", () => {
  const { player, started } = audio();
  player.play(new Map([["/a/speaker", { ...TONE, elapsed: 0.5 }]]));
  player.play(new Map([["/a/speaker", TONE]]));
  player.play(new Map([["/a/speaker", { ...TONE, name: "buzz", elapsed: 0.1 }]]));
  expect(started.map(({ type }) => type)).toEqual(["sine", "sine", "square"]);
  expect(player.playing).toBe(1);
});

test("at most 8 of many simultaneous sounds are played", () => {
  const { player, started } = audio();
  player.play(new Map(Array.from({ length: 50 }, (_, i) => [`/${i}/speaker`, TONE])));
  expect(started).toHaveLength(8);
});

test("no audio is opened before a sound is played", () => {
  const open = vi.fn();
  new SoundPlayer(open).play(new Map());
  expect(open).not.toHaveBeenCalled();
});
