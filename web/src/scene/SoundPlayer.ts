// Plays the sounds of the robots' speakers, at the same volume for all distances.
import type { Sound } from "../live/devices";

const LOUDNESS = 0.08; // amplitude at full volume, as a fraction of full scale
const MOST_SOUNDS = 8;
const FADE = 0.01; // s: fade of a tone's start and end, which avoids clicks
const CHIRP_SPAN = 2; // octaves per second
const WAVES: Record<string, OscillatorType> = { tone: "sine", chirp: "sine", buzz: "square" };

interface Voice {
  sound: Sound;
  source: AudioScheduledSourceNode;
  gain: GainNode;
}

export class SoundPlayer {
  private readonly voices = new Map<string, Voice>(); // by topic
  private context: AudioContext | null = null;

  constructor(private readonly makeContext: () => AudioContext = () => new AudioContext()) {}

  get playing(): number {
    return this.voices.size;
  }

  // Sets the sounds to play, by topic. Plays at most MOST_SOUNDS of them.
  play(sounds: ReadonlyMap<string, Sound>): void {
    if (sounds.size === 0 && this.voices.size === 0) return;
    for (const [topic, { sound }] of [...this.voices]) {
      const now = sounds.get(topic);
      if (!now || !isSame(now, sound)) this.end(topic);
    }
    for (const [topic, sound] of [...sounds].slice(0, MOST_SOUNDS)) {
      const voice = this.voices.get(topic);
      if (voice) voice.sound = sound;
      else this.begin(topic, sound);
    }
  }

  private begin(topic: string, sound: Sound): void {
    this.context ??= this.makeContext();
    // Browsers suspend audio until the user has interacted with the page.
    if (this.context.state === "suspended") void this.context.resume();
    const source = sourceOf(this.context, sound);
    const gain = this.context.createGain();
    const now = this.context.currentTime;
    gain.gain.setValueAtTime(0, now);
    gain.gain.linearRampToValueAtTime(LOUDNESS * sound.volume, now + FADE);
    source.connect(gain).connect(this.context.destination);
    source.start();
    this.voices.set(topic, { sound, source, gain });
  }

  private end(topic: string): void {
    const { source, gain } = this.voices.get(topic)!;
    const now = this.context!.currentTime;
    gain.gain.setTargetAtTime(0, now, FADE / 3);
    source.stop(now + 2 * FADE);
    this.voices.delete(topic);
  }
}

// Returns whether a sound continues. If the elapsed time is shorter than before, the sound was
// started again.
function isSame(now: Sound, before: Sound): boolean {
  const { name, frequency, volume, elapsed } = before;
  return (
    now.name === name && now.frequency === frequency && now.volume === volume && now.elapsed >= elapsed
  );
}

function sourceOf(context: AudioContext, sound: Sound): AudioScheduledSourceNode {
  if (sound.name === "noise") return noise(context);
  const oscillator = context.createOscillator();
  oscillator.type = WAVES[sound.name] ?? "sine";
  const now = context.currentTime;
  oscillator.frequency.setValueAtTime(sound.frequency, now);
  if (sound.name === "chirp") {
    oscillator.frequency.exponentialRampToValueAtTime(sound.frequency * 2 ** CHIRP_SPAN, now + 1);
  }
  return oscillator;
}

function noise(context: AudioContext): AudioBufferSourceNode {
  const buffer = context.createBuffer(1, context.sampleRate, context.sampleRate);
  const samples = buffer.getChannelData(0);
  for (let i = 0; i < samples.length; i++) samples[i] = 2 * Math.random() - 1;
  const source = context.createBufferSource();
  source.buffer = buffer;
  source.loop = true;
  return source;
}
