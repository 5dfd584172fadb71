// The whole trace as a strip, with the window that is shown; dragging moves the window or frames another.

import { html } from "../base/dom";
import { kLeft, kRight } from "./diagram";
import { Raster, TimeMap, pixel } from "./raster";
import { Line } from "./layout";
import { Source } from "./source";
import { Span, View } from "./view";

const kRefresh = 500;  // of a live picture [ms]

export class Overview {
  private readonly canvas = html("canvas", { class: "strip" });
  private readonly window = html("div", { class: "strip-window" });
  private readonly track = html("div", { class: "strip-track" }, this.canvas, this.window);
  readonly element = html("div", { class: "overview", tabindex: 0, role: "slider", "aria-label": "Window within the whole trace; arrow keys move it", "aria-valuemin": 0, "aria-valuemax": 100, "aria-valuenow": 100 }, this.track);
  private drawnAt = 0;
  private key = "";
  private whole: Span = { from: 0, to: 1 };

  constructor(private readonly view: View, private readonly latest: () => number) {
    this.track.addEventListener("pointerdown", (event) => this.down(event));
    this.element.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
      event.preventDefault();
      event.stopPropagation();
      this.view.move(event.key === "ArrowLeft" ? -0.5 : 0.5, this.latest());
    });
  }

  private down(down: PointerEvent): void {
    const box = this.track.getBoundingClientRect();
    const timeAt = (x: number): number => this.whole.from + ((x - box.left) / box.width) * (this.whole.to - this.whole.from);
    const begin = timeAt(down.clientX);
    const shown = this.view.window(this.latest());
    const isInside = begin >= shown.from && begin <= shown.to && shown.to - shown.from < 0.95 * (this.whole.to - this.whole.from);
    this.track.setPointerCapture(down.pointerId);
    let last: Span | null = null;
    const move = (event: PointerEvent): void => {
      const t = timeAt(event.clientX);
      last = isInside ? { from: shown.from + t - begin, to: shown.to + t - begin } : { from: Math.min(begin, t), to: Math.max(begin, t) };
      if (Math.abs(event.clientX - down.clientX) < 3) last = null;
      if (last) this.place(last);
    };
    const end = (up: PointerEvent): void => {
      for (const kind of ["pointermove", "pointerup", "pointercancel"] as const) this.track.removeEventListener(kind, kind === "pointermove" ? move : end);
      if (up.type === "pointercancel") return this.place(this.view.window(this.latest()));
      move(up);  // where one lets go counts, also if the path there was too quick to be seen
      const length = shown.to - shown.from;
      if (last) this.view.show(last.from, last.to, this.latest());
      else if (!isInside) this.view.show(begin - length / 2, begin + length / 2, this.latest());
    };
    this.track.addEventListener("pointermove", move);
    this.track.addEventListener("pointerup", end);
    this.track.addEventListener("pointercancel", end);
  }

  private place(span: Span): void {
    const length = this.whole.to - this.whole.from;
    const left = Math.min(Math.max((span.from - this.whole.from) / length, 0), 1);
    const right = Math.min(Math.max((span.to - this.whole.from) / length, 0), 1);
    this.window.style.left = left * 100 + "%";
    this.window.style.width = Math.max((right - left) * 100, 0.2) + "%";
    this.element.setAttribute("aria-valuenow", String(Math.round(right * 100)));
    this.element.setAttribute("aria-valuetext", `${(span.from / 1e9).toFixed(2)} to ${(span.to / 1e9).toFixed(2)} seconds`);
  }

  draw(source: Source | undefined, lines: Line[], colour: (line: Line) => string, span: Span, wrap: (path: string) => number): void {
    const now = performance.now();
    if (!source || !(source.end > source.begin)) return;
    this.whole = { from: source.begin, to: source.end };
    this.place(span);
    const width = Math.max(Math.floor(this.element.clientWidth - kLeft - kRight), 1);
    const height = Math.max(this.element.clientHeight - 2, 1);
    const key = [source.id, width, lines.map((line) => line.path + colour(line)).join(), source.isLive ? 0 : source.record.columns.length].join();
    if (key === this.key && (now - this.drawnAt < kRefresh || !source.isLive)) return;
    this.key = key;
    this.drawnAt = now;
    this.canvas.width = width;
    this.canvas.height = height;
    const raster = new Raster(width, height);
    const map = new TimeMap(this.whole, width);
    const { record } = source;
    for (const line of lines) {
      const column = record.column(line.path);
      if (!column) continue;
      let [low, high] = [Infinity, -Infinity];
      for (let row = 0; row < record.size; ++row) {
        low = Math.min(low, (column.low ?? column.value)[row]);
        high = Math.max(high, (column.high ?? column.value)[row]);
      }
      if (!(low <= high)) [low, high] = this.extremes(column.value, record.size);
      if (high === low) { low -= 1; high += 1; }
      raster.line(record, column, 0, record.size, map, { low, high }, { colour: pixel(colour(line)), thickness: 1, dash: 0 }, wrap(line.path), source.shift);
    }
    const context = this.canvas.getContext("2d");
    if (context) raster.show(context);
  }

  /// Where some rows have no number.
  private extremes(values: Float64Array, size: number): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (let row = 0; row < size; ++row) {
      if (values[row] < low) low = values[row];
      if (values[row] > high) high = values[row];
    }
    return low <= high ? [low, high] : [0, 1];
  }
}
