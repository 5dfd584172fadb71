// Signals as pixels. Each column of pixels gets what all its rows span, so that no peak is lost, at a cost that hardly
// grows with the rows. A live picture is moved by whole columns, and only what has come is drawn.

import { Column, Recording } from "./record";
import { Span } from "./view";

/// Which column of pixels a time has. Columns are counted from time 0, so that a picture that rolls moves by whole ones.
export class TimeMap {
  readonly perTime: number;  // columns for a nanosecond
  readonly origin: number;   // the column at the left edge

  /// @param isSweeping the picture stands, and new rows write over the oldest
  constructor(readonly span: Span, readonly width: number, readonly isSweeping = false) {
    this.perTime = width / (span.to - span.from);
    this.origin = Math.round(span.to * this.perTime) - width;
  }

  column(t: number): number { return Math.floor(t * this.perTime); }
  x(t: number): number {
    const column = this.column(t);
    return this.isSweeping ? ((column % this.width) + this.width) % this.width : column - this.origin;
  }
  /// where a time lies within the width, not by whole pixels
  share(t: number): number {
    const column = t * this.perTime;
    const at = this.isSweeping ? ((column % this.width) + this.width) % this.width : column - this.origin;
    return at / this.width;
  }
  time(share: number): number {
    if (!this.isSweeping) return (this.origin + share * this.width) / this.perTime;
    const pen = ((this.column(this.span.to) % this.width) + this.width) % this.width;
    const behind = (((pen - share * this.width) % this.width) + this.width) % this.width;
    return this.span.to - behind / this.perTime;
  }
}

/// Values at the upper and the lower edge.
export interface Range { low: number; high: number }
export interface Stroke { colour: number; thickness: number; dash: number }  // dash: columns that are drawn and left out; 0 all

export class Raster {
  private image: ImageData;
  readonly pixels: Uint32Array;

  constructor(readonly width: number, readonly height: number) {
    this.image = new ImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
  }

  clear(): void { this.pixels.fill(0); }
  show(context: CanvasRenderingContext2D): void { context.putImageData(this.image, 0, 0); }

  /// Moves all to the left, which leaves `columns` at the right empty.
  roll(columns: number): void {
    if (columns <= 0) return;
    this.pixels.copyWithin(0, columns);
    this.clearColumns(this.width - columns, this.width);
  }

  clearColumns(from: number, to: number): void {
    for (let y = 0, row = 0; y < this.height; ++y, row += this.width) this.pixels.fill(0, row + from, row + to);
  }

  /// Pixels of a column from one height to another, in any order.
  private fill(x: number, a: number, b: number, stroke: Stroke): void {
    if (x < 0 || x >= this.width) return;
    const top = Math.max(Math.round(Math.min(a, b)), 0);
    const bottom = Math.min(Math.round(Math.max(a, b)) + stroke.thickness, this.height);
    for (let y = top, at = top * this.width + x; y < bottom; ++y, at += this.width) this.pixels[at] = stroke.colour;
  }

  /// A line from top to bottom below all signals.
  grid(x: number, colour: number): void {
    if (x < 0 || x >= this.width) return;
    for (let y = 0, at = x; y < this.height; ++y, at += this.width) if (this.pixels[at] === 0) this.pixels[at] = colour;
  }

  box(x: number, toX: number, top: number, bottom: number, colour: number): void {
    const from = Math.max(x, 0);
    const to = Math.min(toX, this.width);
    if (to <= from) return;
    for (let y = Math.max(top, 0); y < Math.min(bottom, this.height); ++y) this.pixels.fill(colour, y * this.width + from, y * this.width + to);
  }

  /// From the middle of one column to that of a later one.
  private join(x: number, y: number, toX: number, toY: number, stroke: Stroke, phase: number): void {
    const slope = (toY - y) / (toX - x);
    const first = Math.max(x, 0);
    const last = Math.min(toX, this.width - 1);
    for (let column = first; column <= last; ++column) {
      if (stroke.dash && Math.floor((column + phase) / stroke.dash) & 1) continue;
      this.fill(column, y + slope * (Math.max(column - 0.5, x) - x), y + slope * (Math.min(column + 0.5, toX) - x), stroke);
    }
  }

  /// A signal as a line, of the rows from one to before another. It is broken where rows are missing, where there is no
  /// number, and where it jumps by more than `wrap`, as positions with a modulo do; within a point, too.
  /// @param shift by which the trace lies later than it was [ns]
  line(record: Recording, column: Column, from: number, to: number, map: TimeMap, range: Range, stroke: Stroke, wrap: number, shift = 0): void {
    const perValue = (this.height - stroke.thickness) / (range.high - range.low);
    const high = range.high;
    const phase = map.isSweeping ? 0 : map.origin;
    const { value: values, low: lows, high: highs } = column;
    let lastX = NaN;
    let lastY = NaN;
    let lastValue = NaN;
    for (let row = from; row < to; ++row) {
      const value = values[row];
      const x = map.x(record.t[row] + shift);
      const y = (high - value) * perValue;
      if (value === value) {
        if (lows && highs && highs[row] - lows[row] <= wrap) this.fill(x, (high - highs[row]) * perValue, (high - lows[row]) * perValue, stroke);
        const isJoined = !record.breaks[row] && x >= lastX && Math.abs(value - lastValue) <= wrap;
        if (!isJoined) this.fill(x, y, y, stroke);
        else if (x === lastX) this.fill(x, lastY, y, stroke);
        else this.join(lastX, lastY, x, y, stroke, phase);
      }
      lastX = x;
      lastY = y;
      lastValue = value;
    }
  }

  /// A BOOL as a lane that is filled while it is TRUE, and a line while it is FALSE; other values as bands, two shades in turns.
  lane(record: Recording, column: Column, from: number, to: number, map: TimeMap, top: number, height: number, colours: (value: number) => number, shift = 0): void {
    for (let row = from; row < to; ++row) {
      const isLast = row + 1 >= record.size || record.breaks[row + 1];
      const x = map.x(record.t[row] + shift);
      const end = isLast ? x : map.x(record.t[row + 1] + shift);
      const value = column.type === "BOOL" && column.high ? column.high[row] : column.value[row];
      if (value !== value) continue;
      const isLow = column.type === "BOOL" && value === 0;
      this.box(x, Math.max(end < x ? this.width : end, x + 1), isLow ? top + height - 1 : top, top + height, colours(value));
    }
  }
}

/// A colour of the style, as `#rrggbb`, as a pixel. @param alpha 0 … 255
export function pixel(colour: string, alpha = 255): number {
  const digits = parseInt(colour.trim().slice(1), 16);
  return ((alpha << 24) | ((digits & 0xff) << 16) | (digits & 0xff00) | (digits >> 16)) >>> 0;
}
