// Sends requests one at a time. If several requests are made while another is pending, only the
// last one is sent.
export class NewestOnly<Wish> {
  private isSending = false;
  private unsent: { wish: Wish } | null = null;

  // `send` may fail; `onProblem` gets the error sentence.
  constructor(
    private readonly send: (wish: Wish) => Promise<void>,
    private readonly onProblem: (sentence: string) => void,
  ) {}

  push(wish: Wish): void {
    this.unsent = { wish };
    if (!this.isSending) void this.sendAll();
  }

  private async sendAll(): Promise<void> {
    this.isSending = true;
    while (this.unsent) {
      const { wish } = this.unsent;
      this.unsent = null;
      await this.send(wish).catch((error: Error) => this.onProblem(error.message));
    }
    this.isSending = false;
  }
}
