// One diagram: signals on a canvas, and on top of it axes, gaps and cursors as SVG.

import { button, html, svg } from "./dom";
import { Raster, pixel } from "./raster";
import { Column, Recording } from "./record";
import { seconds, short, ticks, widened } from "./scale";
import { Cursor, Span, View } from "./view";

export const kLeft = 84;   // of the plot within the page's column [px], the same for all that share the time
export const kRight = 12;
const kLane = 14;          // of a BOOL [px]

/// What a picture shows, for tests.
export interface Drawn { from: number; to: number; low: number; high: number; signals: { path: string; rows: number; colour: string }[] }

export interface DiagramNotes {
  remove(path: string): void;
  chosen(): void;
}

export class Diagram {
  readonly element: HTMLElement;
  readonly plot: HTMLElement;
  readonly canvas = html("canvas");
  fixed: [number, number] | null = null;  // range of values that was chosen
  private readonly layer = svg("svg", { class: "layer", "aria-hidden": "true" });
  private readonly grid = svg("g");
  private readonly gaps = svg("g");
  private readonly marks = svg("g");
  private readonly legend = html("ul", { class: "legend" });
  private raster: Raster | null = null;
  private values = new Map<string, HTMLElement>();
  private gridOf = "";
  private width = 0;
  private height = 0;
  range: [number, number] = [0, 1];

  constructor(public paths: string[], private readonly notes: DiagramNotes) {
    this.layer.append(this.gaps, this.grid, this.marks);
    this.plot = html("div", { class: "plot", tabindex: 0, role: "img" }, this.canvas, this.layer);
    this.element = html("section", { class: "diagram" }, this.legend, this.plot);
    this.element.addEventListener("pointerdown", () => this.notes.chosen());
    this.element.addEventListener("focusin", () => this.notes.chosen());
    new ResizeObserver(() => this.resize()).observe(this.plot);
  }

  private resize(): void {
    const ratio = window.devicePixelRatio || 1;
    this.width = Math.max(Math.floor(this.plot.clientWidth - kLeft - kRight), 1);
    this.height = Math.max(this.plot.clientHeight, 1);
    this.canvas.width = Math.max(Math.floor(this.width * ratio), 1);
    this.canvas.height = Math.max(Math.floor(this.height * ratio), 1);
    this.raster = new Raster(this.canvas.width, this.canvas.height, Math.max(Math.round(1.5 * ratio), 1));
    this.gridOf = "";
  }

  setLegend(colour: (path: string) => string, unit: (path: string) => string): void {
    this.values.clear();
    this.legend.replaceChildren(...this.paths.map((path) => {
      const value = html("output", { class: "value" }, "–");
      this.values.set(path, value);
      const swatch = svg("svg", { class: "swatch", viewBox: "0 0 16 4" }, svg("rect", { width: 16, height: 4, fill: colour(path) }));
      return html("li", {}, swatch, html("span", { class: "path" }, path), value, html("span", { class: "unit" }, unit(path)),
        button("×", "Remove " + path, () => this.notes.remove(path)));
    }));
    this.plot.setAttribute("aria-label", "Diagram of " + (this.paths.join(", ") || "nothing"));
  }

  showValues(record: Recording, row: number): void {
    for (const [path, element] of this.values) {
      const column = record.column(path);
      const text = !column || row < 0 ? "–" : column.type === "BOOL" ? (column.value[row] ? "TRUE" : "FALSE") : short(column.value[row]);
      if (element.textContent !== text) element.textContent = text;
    }
  }

  /// @param wrap by which a signal may jump
  draw(record: Recording, view: View, span: Span, colour: (path: string) => string, wrap: (path: string) => number): Drawn {
    const columns = this.paths.map((path) => record.column(path)).filter((column): column is Column => !!column);
    const lines = columns.filter((column) => column.type !== "BOOL");
    const lanes = columns.filter((column) => column.type === "BOOL");
    this.range = this.fixed ?? widened(...this.extremes(record, lines, span));
    const [low, high] = this.range;
    const drawn: Drawn = { from: span.from, to: span.to, low, high, signals: [] };
    const context = this.canvas.getContext("2d");
    if (!this.raster || !context) return drawn;
    this.raster.clear();
    const ratio = this.canvas.height / this.height;
    const share = Math.max(this.canvas.height - lanes.length * kLane * ratio, this.canvas.height * 0.3) / this.canvas.height;
    // Lanes lie below the lines, which get a range that leaves them free.
    const bottom = high - (high - low) / (lines.length ? share : 1);
    const frame = { width: this.canvas.width, height: this.canvas.height, span, low: lanes.length ? bottom : low, high };
    for (const column of lines)
      drawn.signals.push({ path: column.path, colour: colour(column.path),
        rows: this.raster.line(record, column, frame, pixel(colour(column.path)), wrap(column.path)) });
    lanes.forEach((column, i) => {
      const top = Math.round(this.canvas.height - (lanes.length - i) * kLane * ratio);
      drawn.signals.push({ path: column.path, colour: colour(column.path),
        rows: this.raster!.lane(record, column, span, top, Math.round((kLane - 4) * ratio), pixel(colour(column.path))) });
    });
    this.raster.show(context);
    this.drawGrid(span, frame.low, high, lines.length > 0);
    this.drawGaps(record, span);
    this.drawCursors(view, span);
    (this.canvas as any).drawn = drawn;
    return drawn;
  }

  private extremes(record: Recording, columns: Column[], span: Span): [number, number] {
    let low = Infinity;
    let high = -Infinity;
    const from = record.rowAt(span.from);
    const to = record.rowAt(span.to + 1);
    for (const column of columns) {
      const lows = column.low ?? column.value;
      const highs = column.high ?? column.value;
      for (let row = from; row < to; ++row) {
        if (lows[row] < low && lows[row] > -Infinity) low = lows[row];
        if (highs[row] > high && highs[row] < Infinity) high = highs[row];
      }
    }
    return [low, high];
  }

  private x(t: number, span: Span): number { return kLeft + ((t - span.from) / (span.to - span.from)) * this.width; }

  private drawGrid(span: Span, low: number, high: number, hasValues: boolean): void {
    const times = ticks(span.from, span.to, this.width / 110);
    const values = hasValues ? ticks(low, high, this.height / 40) : [];
    // Lines of time move with each live picture; texts only when they change.
    const key = [this.width, this.height, low, high, values.length].join();
    if (key !== this.gridOf) {
      this.gridOf = key;
      this.grid.replaceChildren(...values.flatMap((value) => {
        const y = ((high - value) / (high - low)) * this.height;
        return [svg("line", { class: "grid", x1: kLeft, x2: kLeft + this.width, y1: y, y2: y }),
          svg("text", { class: "tick", x: kLeft - 6, y: Math.min(Math.max(y + 4, 10), this.height - 2), "text-anchor": "end" }, short(value))];
      }));
      this.grid.append(svg("path", { class: "grid" }));
    }
    const path = times.map((t) => `M${this.x(t, span).toFixed(1)} 0V${this.height}`).join("");
    this.grid.lastElementChild?.setAttribute("d", path);
  }

  private drawGaps(record: Recording, span: Span): void {
    const marks: SVGElement[] = [];
    for (let row = record.rowAt(span.from), to = Math.min(record.rowAt(span.to) + 1, record.size); row < to; ++row) {
      if (!record.breaks[row] || row === 0) continue;
      const from = this.x(record.t[row - 1], span);
      marks.push(svg("rect", { class: "gap", x: from, y: 0, width: Math.max(this.x(record.t[row], span) - from, 2), height: this.height }));
    }
    if (marks.length || this.gaps.childElementCount) this.gaps.replaceChildren(...marks);
  }

  private drawCursors(view: View, span: Span): void {
    const marks: SVGElement[] = [];
    for (const name of ["A", "B"] as Cursor[]) {
      const t = view.cursors[name];
      if (t === null || t < span.from || t > span.to) continue;
      const x = this.x(t, span);
      marks.push(svg("line", { class: "cursor" + (view.active === name ? " active" : ""), x1: x, x2: x, y1: 0, y2: this.height }),
        svg("text", { class: "cursor-name", x: x + 3, y: 11 }, name));
    }
    if (marks.length || this.marks.childElementCount) this.marks.replaceChildren(...marks);
  }
}

/// The axis of time below all diagrams.
export class TimeAxis {
  readonly element = svg("svg", { class: "time", "aria-label": "Time in seconds", role: "img" });

  draw(span: Span): void {
    const width = this.element.clientWidth - kLeft - kRight;
    const times = ticks(span.from, span.to, width / 110);
    const step = times.length > 1 ? times[1] - times[0] : span.to - span.from;
    this.element.replaceChildren(...times.map((t) => svg("text",
      { class: "tick", x: kLeft + ((t - span.from) / (span.to - span.from)) * width, y: 14, "text-anchor": "middle" },
      seconds(t, step) + " s")));
  }
}
