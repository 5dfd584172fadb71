// What the page keeps of a trace: rows by columns, the newest of them.

import { Frame } from "../base/frames";

export interface Signal { path: string; type: string; unit: string; names?: Record<string, string> }

/// Values of a signal. Where a row stands for several, `low` and `high` are their extremes.
export interface Column extends Signal {
  value: Float64Array;
  low: Float64Array | null;
  high: Float64Array | null;
}

/// Rows that are missing, between the last one before and the first one after.
export interface Gap { from: number; to: number; rows: number }

const kFirst = 4096;          // rows that there is space for at the beginning
export const kRows = 1 << 17; // … at the end

export class Recording {
  t: Float64Array = new Float64Array(kFirst);     // [ns]
  breaks: Uint8Array = new Uint8Array(kFirst);  // 1: rows are missing before this one
  size = 0;
  removed = 0;                      // rows that were kept once
  gaps: Gap[] = [];
  missing = 0;                      // rows, in all gaps
  readonly columns: Column[];
  private dropped = 0;
  private byPath = new Map<string, Column>();

  constructor(signals: Signal[]) {
    this.columns = signals.map((signal) => ({ ...signal, value: new Float64Array(kFirst), low: null, high: null }));
    for (const column of this.columns) this.byPath.set(column.path, column);
  }

  get begin(): number { return this.size ? this.t[0] : 0; }
  get end(): number { return this.size ? this.t[this.size - 1] : 0; }

  column(path: string): Column | undefined { return this.byPath.get(path); }

  /// The first row that is not before a time; size: there is none.
  rowAt(t: number): number {
    let low = 0;
    let high = this.size;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.t[middle] < t) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /// The row that is next to a time; -1: there is none.
  nearest(t: number): number {
    const row = this.rowAt(t);
    if (row === 0) return this.size ? 0 : -1;
    return row < this.size && this.t[row] - t < t - this.t[row - 1] ? row : row - 1;
  }

  /// Rows that are older than those that are there are left out, and those at the beginning that have nothing.
  append(frame: Frame): void {
    const from = frame.t.findIndex((t, row) => this.size ? t > this.end : frame.columns.some(({ arrays }) => arrays[0][row] === arrays[0][row]));
    if (from < 0 || frame.t.length === 0) return;
    const rows = frame.t.length - from;
    this.reserve(rows);
    this.t.set(frame.t.subarray(from), this.size);
    this.breaks.fill(0, this.size, this.size + rows);
    if (frame.dropped > this.dropped) {
      this.breakBefore(this.size, frame.dropped - this.dropped);
      this.dropped = frame.dropped;
    }
    this.columns.forEach((column, i) => this.take(column, frame.columns[i].arrays, from, rows));
    this.size += rows;
  }

  /// Rows are missing before this one.
  breakBefore(row: number, rows: number): void {
    this.breaks[row] = 1;
    this.missing += rows;
    if (row > 0) this.gaps.push({ from: this.t[row - 1], to: this.t[row], rows });
  }

  private take(column: Column, arrays: ArrayLike<number>[], from: number, rows: number): void {
    const scale = column.type === "TIME" ? 1e-9 : 1;
    const [first, minimum, maximum, last] = arrays;
    if (minimum && !column.low) {
      column.low = column.value.slice();
      column.high = column.value.slice();
    }
    for (let i = 0; i < rows; ++i) {
      column.value[this.size + i] = scale * (last ?? first)[from + i];
      if (!column.low || !column.high) continue;
      column.low[this.size + i] = scale * (minimum ?? first)[from + i];
      column.high[this.size + i] = scale * (maximum ?? first)[from + i];
    }
  }

  /// Space for more rows; a quarter of the oldest goes where there is none any more.
  private reserve(rows: number): void {
    if (this.size + rows <= this.t.length) return;
    const kept = this.t.length >= kRows ? Math.min(this.size, Math.floor(kRows * 0.75)) : this.size;
    let capacity = this.t.length;
    while (kept + rows > capacity) capacity *= 2;
    const moved = (old: Float64Array): Float64Array => {
      const grown = new Float64Array(capacity);
      grown.set(old.subarray(this.size - kept, this.size));
      return grown;
    };
    const breaks = new Uint8Array(capacity);
    breaks.set(this.breaks.subarray(this.size - kept, this.size));
    this.t = moved(this.t);
    this.breaks = breaks;
    for (const column of this.columns) {
      column.value = moved(column.value);
      column.low = column.low && moved(column.low);
      column.high = column.high && moved(column.high);
    }
    this.removed += this.size - kept;
    this.size = kept;
    this.gaps = this.gaps.filter(({ to }) => to >= this.begin);
  }
}
