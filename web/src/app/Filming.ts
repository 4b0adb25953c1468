// Records a video of the view as WebM. A press starts the video. The next press ends it, or it ends
// at its maximum size.
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { download, fileName } from "../ui/files";
import { notify } from "./notices";

const FORMATS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
const PIECE_MS = 1000;
export const LARGEST_BYTES = 300_000_000;

export class Filming {
  private recorder: MediaRecorder | null = null;
  private pieces: Blob[] = [];
  private bytes = 0;

  constructor(
    private readonly store: Store<State>,
    private readonly video: () => MediaStream | null, // null if there is no view
    private readonly save: (name: string, content: Blob) => void = download,
  ) {}

  toggle(): void {
    if (this.recorder) this.recorder.stop();
    else this.start();
  }

  private start(): void {
    const type = FORMATS.find((each) => globalThis.MediaRecorder?.isTypeSupported(each));
    if (!type) return notify(this.store, "error", "This browser cannot record video.");
    const { simulation, time } = this.store.get();
    const stream = this.video();
    if (!stream) return;
    const recorder = new MediaRecorder(stream, { mimeType: type });
    this.recorder = recorder;
    recorder.ondataavailable = ({ data }) => this.take(recorder, data);
    recorder.onerror = () => notify(this.store, "error", "The recording of the video stopped because of an error.");
    recorder.onstop = () => {
      for (const track of stream.getTracks()) track.stop();
      this.finish(fileName(simulation, time, "video", "webm"));
    };
    recorder.start(PIECE_MS);
    this.store.set({ filming: true });
  }

  private take(recorder: MediaRecorder, piece: Blob): void {
    this.pieces.push(piece);
    this.bytes += piece.size;
    if (this.bytes < LARGEST_BYTES || recorder.state !== "recording") return;
    notify(this.store, "note", "The recording of the video stopped because the video has reached its maximum size.");
    recorder.stop();
  }

  private finish(name: string): void {
    const video = new Blob(this.pieces, { type: "video/webm" });
    this.pieces = [];
    this.bytes = 0;
    this.recorder = null;
    this.store.set({ filming: false });
    if (video.size > 0) this.save(name, video);
  }
}
