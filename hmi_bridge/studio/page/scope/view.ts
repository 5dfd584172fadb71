// Which part of the time is shown, and the two cursors on it. Times are nanoseconds of the run.

export interface Span { from: number; to: number }
export type Cursor = "A" | "B";

const kShortest = 1e4;        // [ns]
const kShortestLive = 1e7;
const kLongest = 3.6e12;

export class View {
  span = 1e10;                // length of a live picture
  isLive = true;
  isSweeping = false;         // live, the pen goes over a picture that stands
  readonly cursors: Record<Cursor, number | null> = { A: null, B: null };
  active: Cursor = "A";       // that keys move
  private still: Span = { from: 0, to: 1e10 };
  private earlier: Span[] = [];
  private later: Span[] = [];
  private changed: () => void = () => undefined;

  onChange(call: () => void): void { this.changed = call; }

  /// @param latest time of the newest row
  window(latest: number): Span {
    return this.isLive ? { from: latest - this.span, to: latest } : this.still;
  }

  setLive(isLive: boolean, latest: number): void {
    if (isLive === this.isLive) return;
    this.still = this.window(latest);
    if (!isLive) this.span = this.still.to - this.still.from;
    this.isLive = isLive;
    this.changed();
  }

  setSweeping(isSweeping: boolean): void { this.isSweeping = isSweeping; this.changed(); }

  /// Length of the picture: of a live one as it goes on, else around its middle.
  setLength(length: number, latest: number): void {
    if (this.isLive) { this.span = Math.min(Math.max(length, kShortestLive), kLongest); return this.changed(); }
    const { from, to } = this.still;
    this.show((from + to - length) / 2, (from + to + length) / 2, latest);
  }

  /// Shows a stretch, which stops the picture; `back` returns to the one before.
  show(from: number, to: number, latest: number): void {
    const length = Math.min(Math.max(to - from, kShortest), kLongest);
    const middle = (from + to) / 2;
    this.earlier.push(this.window(latest));
    this.later = [];
    this.setLive(false, latest);
    this.still = { from: middle - length / 2, to: middle + length / 2 };
    this.changed();
  }

  /// Makes the stretch shorter or longer around a time; a live picture goes on.
  zoom(factor: number, around: number, latest: number): void {
    if (this.isLive) return this.setLength(this.span * factor, latest);
    const { from, to } = this.still;
    this.show(around - (around - from) * factor, around + (to - around) * factor, latest);
  }

  move(share: number, latest: number): void {
    const { from, to } = this.window(latest);
    const by = (to - from) * share;
    this.show(from + by, to + by, latest);
  }

  back(): void { this.step(this.earlier, this.later); }
  forward(): void { this.step(this.later, this.earlier); }
  private step(takes: Span[], gives: Span[]): void {
    const span = takes.pop();
    if (!span) return;
    gives.push(this.still);
    this.isLive = false;
    this.still = span;
    this.changed();
  }

  place(cursor: Cursor, t: number | null): void {
    this.cursors[cursor] = t;
    if (t !== null) this.active = cursor;
    this.changed();
  }
}
