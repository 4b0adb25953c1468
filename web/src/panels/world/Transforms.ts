// The newest transforms of /tf and /tf_static: each frame with its parent and its time.
import type { TopicSource } from "../../protocol/SharedTopics";
import type { TransformsMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import { anglesOf } from "../../live/values";

// A frame and its transform relative to the parent frame.
export interface Frame {
  child: string;
  parent: string;
  time: number; // s, simulated
  isStatic: boolean; // a static transform never changes, so it has no age
  position: [number, number, number]; // m
  angles: { roll: number; pitch: number; yaw: number }; // rad
}

const MAX_FRAMES = 5000;

export class Transforms {
  private readonly frames = new Map<string, Frame>();

  // Listens until the returned function is called. `onChange` is called after each message.
  open(topics: TopicSource, onChange: () => void): () => void {
    const listen = (topic: string, isStatic: boolean) =>
      topics.subscribe<TransformsMessage>(
        topic,
        ({ transforms }) => {
          for (const { header, child_frame_id: child, transform: { translation: t, rotation } } of transforms) {
            if (!this.frames.has(child) && this.frames.size >= MAX_FRAMES) continue;
            this.frames.set(child, {
              child,
              parent: header.frame_id,
              time: seconds(header.stamp),
              isStatic,
              position: [t.x, t.y, t.z],
              angles: anglesOf(rotation),
            });
          }
          onChange();
        },
        { newestOnly: true },
      );
    const ends = [listen("/tf", false), listen("/tf_static", true)];
    return () => {
      ends.forEach((end) => end());
      this.frames.clear();
    };
  }

  get(child: string): Frame | null {
    return this.frames.get(child) ?? null;
  }

  // The frames, sorted by parent and name.
  list(): Frame[] {
    return [...this.frames.values()].sort((a, b) => a.parent.localeCompare(b.parent) || a.child.localeCompare(b.child));
  }
}

// "0.2 s", or "static".
export function ageText({ isStatic, time }: Frame, now: number): string {
  return isStatic ? "static" : `${Math.max(0, now - time).toFixed(2)} s`;
}
