// The views that the server draws and pushes over the live stream ("Views" in
// docs/formats/live.md).

const HEADER_BYTES = 20; // bytes of sequence (4), number (8) and seen time (8)

// An image that the server has pushed.
export interface PushedImage {
  // The number that the reader has passed to show() together with the camera of this image.
  sequence: number;
  // Number of the world's state that the image shows; a later state has a larger number.
  number: number;
  stamp: number; // s, simulated
  seenMs: number; // when the server first saw this state, in ms since 1970
  jpeg: Uint8Array<ArrayBuffer>;
}

// The callbacks for a view.
export interface ViewReader {
  // Called when the stream is open, for the first time or again. If `isOffered`, the server pushes
  // images, and show() has an effect from now on.
  onReady(isOffered: boolean): void;
  onImage(image: PushedImage): void;
  // Called when the server has ended the view, with the reason. show() begins it again.
  onEnd(sentence: string): void;
}

// A view that the server draws until end() is called.
export interface LiveView {
  // `camera`: a text like the query of /view.mjpeg.
  show(camera: string, sequence: number): void;
  // Reports that this image is on the screen, or was left out. The server then sends the next
  // image.
  shown(image: PushedImage): void;
  end(): void;
}

export interface LiveViewSource {
  openView(reader: ViewReader): LiveView;
}

// The views of one connection, which may be lost and opened again.
export class ConnectedViews implements LiveViewSource {
  private readonly readers = new Map<number, ViewReader>();
  private isOffered: boolean | null = null; // null: the server has not reported it yet

  constructor(
    private readonly send: (message: object) => void,
    private readonly newId: () => number,
  ) {}

  openView(reader: ViewReader): LiveView {
    const id = this.newId();
    this.readers.set(id, reader);
    const { isOffered } = this;
    if (isOffered !== null) queueMicrotask(() => this.readers.has(id) && reader.onReady(isOffered));
    return {
      show: (camera, sequence) => this.send({ op: "gsvSubscribeView", id, camera, sequence }),
      shown: ({ number }) => this.send({ op: "gsvViewShown", id, image: number }),
      end: () => {
        if (this.readers.delete(id) && this.isOffered) this.send({ op: "gsvUnsubscribeView", id });
      },
    };
  }

  connected(isOffered: boolean): void {
    this.isOffered = isOffered;
    for (const reader of [...this.readers.values()]) reader.onReady(isOffered);
  }

  lost(): void {
    this.isOffered = null;
  }

  // Takes a binary message on this subscription. Returns whether it belongs to a view.
  takeMessage(id: number, nanoseconds: bigint, payload: DataView): boolean {
    const reader = this.readers.get(id);
    if (!reader) return false;
    if (payload.byteLength <= HEADER_BYTES) throw new Error("an image of a view is cut off");
    reader.onImage({
      sequence: payload.getUint32(0, true),
      number: Number(payload.getBigUint64(4, true)),
      stamp: Number(nanoseconds) * 1e-9,
      seenMs: Number(payload.getBigUint64(12, true)) / 1000,
      jpeg: new Uint8Array(payload.buffer as ArrayBuffer, payload.byteOffset + HEADER_BYTES, payload.byteLength - HEADER_BYTES),
    });
    return true;
  }

  takeFailure({ id, message }: Record<string, unknown>): void {
    this.readers.get(Number(id))?.onEnd(String(message));
  }
}

// Views that continue to exist if the source changes, for example if the page shows another
// simulation.
export class SharedViews implements LiveViewSource {
  private source: LiveViewSource | null = null;
  private readonly opened = new Map<ViewReader, LiveView | null>(); // null: there is no source

  // Sets the source of all views; null: none.
  attach(source: LiveViewSource | null): void {
    for (const view of this.opened.values()) view?.end();
    this.source = source;
    for (const reader of this.opened.keys()) this.opened.set(reader, source?.openView(reader) ?? null);
  }

  openView(reader: ViewReader): LiveView {
    this.opened.set(reader, this.source?.openView(reader) ?? null);
    return {
      show: (camera, sequence) => this.opened.get(reader)?.show(camera, sequence),
      shown: (image) => this.opened.get(reader)?.shown(image),
      end: () => {
        this.opened.get(reader)?.end();
        this.opened.delete(reader);
      },
    };
  }
}
