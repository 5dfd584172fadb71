// Signals as pixels. Each column of pixels gets what all its rows span, so that no peak is lost, at a cost
// that hardly grows with the rows.

import { Column, Recording } from "./record";
import { Span } from "./view";

/// Where values lie in a picture of `width` by `height` pixels.
export interface Frame2D { width: number; height: number; span: Span; low: number; high: number }

export class Raster {
  private image: ImageData;
  private pixels: Uint32Array;

  constructor(readonly width: number, readonly height: number, private readonly thickness: number) {
    this.image = new ImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
  }

  clear(): void { this.pixels.fill(0); }
  show(context: CanvasRenderingContext2D): void { context.putImageData(this.image, 0, 0); }

  /// Pixels of a column from one height to another, in any order.
  private fill(x: number, a: number, b: number, colour: number): void {
    if (x < 0 || x >= this.width) return;
    const top = Math.max(Math.round(Math.min(a, b)), 0);
    const bottom = Math.min(Math.round(Math.max(a, b)) + this.thickness, this.height);
    for (let y = top, at = top * this.width + x; y < bottom; ++y, at += this.width) this.pixels[at] = colour;
  }

  /// From the middle of one column to that of a later one.
  private join(x: number, y: number, toX: number, toY: number, colour: number): void {
    const slope = (toY - y) / (toX - x);
    const first = Math.max(x, 0);
    const last = Math.min(toX, this.width - 1);
    for (let column = first; column <= last; ++column) {
      const left = y + slope * (Math.max(column - 0.5, x) - x);
      const right = y + slope * (Math.min(column + 0.5, toX) - x);
      this.fill(column, left, right, colour);
    }
  }

  /// A signal as a line. It is broken where rows are missing, where there is no number, and where it jumps by
  /// more than `wrap`, as positions with a modulo do. @return rows drawn
  line(record: Recording, column: Column, frame: Frame2D, colour: number, wrap: number): number {
    const { span, low, high } = frame;
    const perTime = this.width / (span.to - span.from);
    const perValue = (this.height - this.thickness) / (high - low);
    const from = Math.max(record.rowAt(span.from) - 1, 0);
    const to = Math.min(record.rowAt(span.to) + 1, record.size);
    let lastX = NaN;
    let lastY = NaN;
    let lastValue = NaN;
    for (let row = from; row < to; ++row) {
      const value = column.value[row];
      const x = Math.floor((record.t[row] - span.from) * perTime);
      const y = (high - value) * perValue;
      if (value === value) {
        if (column.low && column.high)
          this.fill(x, (high - column.high[row]) * perValue, (high - column.low[row]) * perValue, colour);
        const isJoined = !record.breaks[row] && Math.abs(value - lastValue) <= wrap;
        if (!isJoined) this.fill(x, y, y, colour);
        else if (x === lastX) this.fill(x, lastY, y, colour);
        else this.join(lastX, lastY, x, y, colour);
      }
      lastX = x;
      lastY = y;
      lastValue = value;
    }
    return Math.max(to - from, 0);
  }

  /// A BOOL as a lane that is filled while it is TRUE.
  lane(record: Recording, column: Column, span: Span, top: number, height: number, colour: number): number {
    const perTime = this.width / (span.to - span.from);
    const from = Math.max(record.rowAt(span.from) - 1, 0);
    const to = Math.min(record.rowAt(span.to) + 1, record.size);
    for (let row = from; row < to; ++row) {
      const until = row + 1 < record.size && !record.breaks[row + 1] ? record.t[row + 1] : record.t[row];
      const x = Math.max(Math.floor((record.t[row] - span.from) * perTime), 0);
      const end = Math.min(Math.floor((until - span.from) * perTime), this.width - 1);
      const isTrue = (column.high ? column.high[row] : column.value[row]) > 0;
      for (let at = x; at <= end; ++at) this.fill(at, isTrue ? top : top + height - 1, top + height - 1, colour);
    }
    return Math.max(to - from, 0);
  }
}

/// A colour of the style, as `#rrggbb`, as a pixel.
export function pixel(colour: string): number {
  const digits = parseInt(colour.trim().slice(1), 16);
  return 0xff000000 | ((digits & 0xff) << 16) | (digits & 0xff00) | (digits >> 16);
}
