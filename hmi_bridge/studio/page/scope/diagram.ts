// One diagram: signals on a canvas, and on top of it axes, gaps and cursors as SVG. A live picture is moved, and only the
// rows that have come are drawn; all is drawn anew where a range, a size or a signal changes.

import { svg, html } from "../base/dom";
import { Range, rounded, seconds, short, stepOf, tickText, ticks } from "../base/scale";
import { AxisSetup, DiagramSetup, Line } from "./layout";
import { Legend, LegendNotes } from "./legend";
import { Raster, Stroke, TimeMap, pixel } from "./raster";
import { Column, Recording } from "./record";
import { Source } from "./source";
import { Cursor, Span, View } from "./view";

export const kLeft = 72;   // of the plot within the page's column [px], the same for all that share the time
export const kRight = 60;
const kLane = 18;          // of a BOOL or of bands [px]
const kLanePause = 4;
const kRefresh = 250;      // extremes of a live picture are looked for again [ms]

/// What all diagrams draw: the first trace is measured, others are laid over it.
export interface Scene {
  sources: Source[];
  view: View;
  span: Span;
  isMoving: boolean;                                  // live
  colour(line: Line): string;
  faint(): string;                                    // lines of the grid
  wrap(path: string): number;
  common(unit: string): Range | null;
  level: { path: string; value: number } | null;      // of the trigger
  changed(): void;                                    // rows have come that were asked for
}

/// What a picture shows, for tests.
export interface Drawn {
  from: number; to: number; low: number; high: number; whole: number; moved: number;
  signals: { path: string; rows: number; colour: string; overlays: number }[]; ranges: Record<string, Range>; gaps: number;
}

/// A signal of a source in this diagram.
interface Curve { line: Line; column: Column; record: Recording; shift: number; order: number }

const isBand = (line: Line, column: Column): boolean => line.shape === "bands" || (line.shape === "auto" && (column.type === "BOOL" ||
  (/^(U?[SLD]?INT|BYTE|D?WORD)$/.test(column.type) && (!!column.names || /(State|Mode|Sensor|Reaction)$/.test(column.path)))));

export class Diagram {
  readonly element: HTMLElement;
  readonly plot: HTMLElement;
  readonly canvas = html("canvas");
  readonly values: { C: number | null; D: number | null } = { C: null, D: null };  // cursors on the first axis
  private readonly layer = svg("svg", { class: "layer", "aria-hidden": "true" });
  private readonly grid = svg("g");
  private readonly gaps = svg("g");
  private readonly bands = svg("g");
  private readonly marks = svg("g");
  private readonly legend: Legend;
  private raster: Raster | null = null;
  private map: TimeMap | null = null;
  private drawnKey = "";
  private drawnRows = 0;       // of all that the record has ever had
  private extremesAt = 0;
  private ranges = new Map<string, Range>();
  private gridOf = "";
  private drawn: Drawn = { from: 0, to: 0, low: 0, high: 1, whole: 0, moved: 0, signals: [], ranges: {}, gaps: 0 };
  private size = { width: 1, height: 1 };
  private faint = 0;           // of the grid
  private lanes = 0;
  lines: Line[];
  axes: Record<string, AxisSetup>;

  constructor(setup: DiagramSetup, notes: LegendNotes & { chosen(): void }) {
    this.lines = setup.lines;
    this.axes = setup.axes;
    this.layer.append(this.grid, this.gaps, this.bands, this.marks);
    this.legend = new Legend(notes);
    this.plot = html("div", { class: "plot", tabindex: 0, role: "img" }, this.canvas, this.layer);
    this.element = html("section", { class: "diagram" }, this.legend.element, this.plot);
    this.element.addEventListener("pointerdown", () => notes.chosen());
    this.element.addEventListener("focusin", () => notes.chosen());
    new ResizeObserver(() => { this.resize(); notes.resized(); }).observe(this.plot);
  }

  get setup(): DiagramSetup { return { lines: this.lines, axes: this.axes }; }
  get paths(): string[] { return this.lines.map(({ path }) => path); }
  /// Units of what is drawn as lines, in order; the first has the axis at the left, the second that at the right.
  units(record: Recording): string[] {
    return [...new Set(this.lines.filter((line) => line.isVisible).flatMap((line) => {
      const column = record.column(line.path);
      return column && !isBand(line, column) ? [column.unit] : [];
    }))];
  }
  rangeOf(unit: string): Range { return this.ranges.get(unit) ?? { low: 0, high: 1 }; }

  private resize(): void {
    const ratio = window.devicePixelRatio || 1;
    this.size = { width: Math.max(Math.floor(this.plot.clientWidth - kLeft - kRight), 1), height: Math.max(this.plot.clientHeight, 1) };
    this.canvas.width = Math.max(Math.floor(this.size.width * ratio), 1);
    this.canvas.height = Math.max(Math.floor(this.size.height * ratio), 1);
    this.raster = new Raster(this.canvas.width, this.canvas.height);
    this.gridOf = this.drawnKey = "";
  }

  relabel(scene: Scene): void {
    this.drawnKey = "";
    const record = scene.sources[0]?.record;
    this.legend.set(this.lines, scene.colour, (path) => record?.column(path)?.unit ?? "", this.axes);
    this.plot.setAttribute("aria-label", "Diagram of " + (this.paths.join(", ") || "nothing"));
  }

  showValues(record: Recording, row: number): void {
    this.legend.showValues((path) => {
      const column = record.column(path);
      if (!column || row < 0) return "–";
      const value = column.value[row];
      if (column.type === "BOOL") return value !== value ? "–" : value ? "TRUE" : "FALSE";
      return column.names?.[value] ?? short(value);
    });
  }

  /// Extremes of the curves of a unit, as they are drawn.
  extremes(unit: string, scene: Scene): [number, number] {
    let low = Infinity;
    let high = -Infinity;
    for (const { line, column, record, shift } of this.curves(scene)) {
      if (isBand(line, column) || column.unit !== unit) continue;
      const lows = column.low ?? column.value;
      const highs = column.high ?? column.value;
      let [own, top] = [Infinity, -Infinity];
      for (let row = record.rowAt(scene.span.from - shift), to = record.rowAt(scene.span.to - shift + 1); row < to; ++row) {
        if (lows[row] < own && lows[row] > -Infinity) own = lows[row];
        if (highs[row] > top && highs[row] < Infinity) top = highs[row];
      }
      if (!(own <= top)) continue;
      const ends = [own * line.scale + line.offset, top * line.scale + line.offset];
      low = Math.min(low, ...ends);
      high = Math.max(high, ...ends);
    }
    if (scene.level && this.lines.some(({ path }) => path === scene.level!.path) && low <= high) {
      const column = scene.sources[0].record.column(scene.level.path);
      if (column?.unit === unit) { low = Math.min(low, scene.level.value); high = Math.max(high, scene.level.value); }
    }
    return [low, high];
  }

  private curves(scene: Scene): Curve[] {
    return scene.sources.flatMap((source, order) => {
      const record = source.recordFor(scene.span, scene.changed);
      return this.lines.filter((line) => line.isVisible).flatMap((line) => {
        const column = record.column(line.path);
        return column ? [{ line, column, record, shift: source.shift, order }] : [];
      });
    });
  }

  /// Ranges of the axes; of a live picture from time to time only.
  private updateRanges(scene: Scene, units: string[], isForced: boolean): void {
    const now = performance.now();
    if (!isForced && scene.isMoving && now - this.extremesAt < kRefresh) return;
    this.extremesAt = now;
    const ranges = new Map<string, Range>();
    for (const unit of units) {
      const axis = this.axes[unit];
      const before = scene.isMoving ? this.ranges.get(unit) ?? null : null;
      if (axis?.mode === "fixed" && axis.range) ranges.set(unit, axis.range);
      else ranges.set(unit, (axis?.mode === "common" && scene.common(unit)) || rounded(...this.extremes(unit, scene), before));
    }
    this.ranges = ranges;
  }

  draw(scene: Scene): Drawn {
    const context = this.canvas.getContext("2d");
    if (!this.raster || !context) return this.drawn;
    const curves = this.curves(scene);
    const units = [...new Set(curves.filter(({ line, column }) => !isBand(line, column)).map(({ column }) => column.unit))];
    const structure = curves.map(({ line, column, order, shift }) => [line.path, line.colour, line.width, line.dash, line.scale, line.offset, line.shape, order, shift, !!column.low].join()).join(";");
    this.updateRanges(scene, units, !this.drawnKey.startsWith(structure));
    const map = new TimeMap(scene.span, this.canvas.width, scene.view.isSweeping && scene.isMoving);
    const ranges = units.map((unit) => `${this.rangeOf(unit).low}:${this.rangeOf(unit).high}`).join();
    const record = scene.sources[0]?.record;
    const key = [structure, ranges, map.perTime, map.isSweeping, scene.faint(), curves.map(({ line }) => scene.colour(line)).join("")].join("|");
    const before = this.map;
    const steps = before ? map.column(map.span.to) - before.column(before.span.to) : 0;
    const canMove = key === this.drawnKey && scene.isMoving && scene.sources.length === 1 && before !== null && steps >= 0 && steps < map.width / 2 && record && this.drawnRows >= record.removed;
    if (canMove && steps === 0 && this.drawnRows === record.removed + record.size) { /* as it is */ }
    else if (canMove) this.drawMore(scene, curves, map, steps);
    else this.drawWhole(scene, curves, map);
    this.drawnKey = key;
    this.map = map;
    this.drawnRows = record ? record.removed + record.size : 0;
    this.raster.show(context);
    const first = this.rangeOf(units[0] ?? "");
    Object.assign(this.drawn, { from: scene.span.from, to: scene.span.to, low: first.low, high: first.high, ranges: Object.fromEntries(this.ranges),
      signals: curves.filter(({ order }) => order === 0).map(({ line, record: one, shift }) => ({ path: line.path, colour: scene.colour(line),
        rows: Math.max(one.rowAt(scene.span.to - shift) - one.rowAt(scene.span.from - shift), 0),
        overlays: curves.filter((other) => other.order > 0 && other.line.path === line.path).length })) });
    this.drawGrid(units, scene);
    this.drawGaps(scene, map);
    this.drawMarks(scene, map, units);
    this.drawBandNames(scene, curves, map);
    (this.canvas as any).drawn = this.drawn;
    return this.drawn;
  }

  private drawWhole(scene: Scene, curves: Curve[], map: TimeMap): void {
    this.drawn.whole += 1;
    this.raster!.clear();
    const begin = map.isSweeping ? scene.span.to - (scene.span.to - scene.span.from) * 0.98 : scene.span.from;
    this.drawCurves(scene, curves, map, (one) => Math.max(one.record.rowAt(begin - one.shift) - (map.isSweeping ? 0 : 1), 0),
      (one) => Math.min(one.record.rowAt(scene.span.to - one.shift) + 1, one.record.size));
    this.drawTimes(map, 0, map.width);
  }

  private drawMore(scene: Scene, curves: Curve[], map: TimeMap, steps: number): void {
    this.drawn.moved += 1;
    const raster = this.raster!;
    if (map.isSweeping) {
      const pen = map.x(scene.span.to);
      const ahead = Math.max(Math.floor(map.width * 0.02), 2) + steps;
      for (const [from, to] of [[pen - steps + 1, pen + ahead], [pen - steps + 1 - map.width, pen + ahead - map.width], [pen - steps + 1 + map.width, pen + ahead + map.width]])
        if (to > 0 && from < map.width) raster.clearColumns(Math.max(from, 0), Math.min(to, map.width));
    } else raster.roll(steps);
    const first = Math.max(this.drawnRows - 1, 0);
    this.drawCurves(scene, curves, map, (one) => Math.max(first - one.record.removed, 0), (one) => one.record.size);
    if (map.isSweeping) this.drawTimes(map, 0, map.width);
    else this.drawTimes(map, map.width - steps, map.width);
  }

  private drawCurves(scene: Scene, curves: Curve[], map: TimeMap, from: (one: Curve) => number, to: (one: Curve) => number): void {
    const raster = this.raster!;
    const ratio = this.canvas.height / this.size.height;
    const lanes = this.laneOrder(curves);
    const lower = lanes.length * kLane * ratio;
    const share = Math.max(this.canvas.height - lower, this.canvas.height * 0.3) / this.canvas.height;
    for (const one of [...curves].reverse()) {
      const { line, column, record, shift, order } = one;
      const colour = pixel(scene.colour(line), order ? 150 : 255);
      const lane = lanes.indexOf(line.path);
      if (lane >= 0) {
        if (order) continue;
        const top = Math.round(this.canvas.height - (lanes.length - lane) * kLane * ratio);
        const shades = [colour, pixel(scene.colour(line), 120)];
        raster.lane(record, column, from(one), to(one), map, top, Math.round((kLane - kLanePause) * ratio),
          column.type === "BOOL" ? () => colour : (value) => shades[Math.abs(Math.round(value)) % 2], shift);
        continue;
      }
      const range = this.rangeOf(column.unit);
      const low = range.high - (range.high - range.low) / share;  // lanes lie below the lines
      const stroke: Stroke = { colour, thickness: Math.max(Math.round((order ? 1 : line.width) * ratio * 0.75), 1), dash: order ? 3 : line.dash };
      raster.line(record, column, from(one), to(one), map, { low: (low - line.offset) / line.scale, high: (range.high - line.offset) / line.scale }, stroke,
        scene.wrap(line.path), shift);
    }
    this.faint = pixel(scene.faint());
  }

  private laneOrder(curves: Curve[]): string[] {
    return [...new Set(curves.filter(({ line, column }) => isBand(line, column)).map(({ line }) => line.path))];
  }

  private drawTimes(map: TimeMap, from: number, to: number): void {
    const count = this.size.width / 110;
    if (map.isSweeping) {
      const length = map.span.to - map.span.from;
      for (const t of ticks(0, length, count)) this.raster!.grid(Math.floor((t / length) * map.width), this.faint);
      return;
    }
    const step = stepOf(map.span.to - map.span.from, count);
    if (!step) return;
    for (let i = Math.ceil(map.time((from - 1) / map.width) / step); i * step <= map.time(to / map.width); ++i) {
      const x = map.x(i * step);
      if (x >= from && x < to) this.raster!.grid(x, this.faint);
    }
  }

  private x(t: number, map: TimeMap): number { return kLeft + map.share(t) * this.size.width; }

  /// Height of a value of the first axis [px].
  y(value: number, unit: string): number {
    const { low, high } = this.rangeOf(unit);
    return ((high - value) / (high - low)) * this.lineHeight();
  }
  valueAt(y: number, unit: string): number {
    const { low, high } = this.rangeOf(unit);
    return high - (y / this.lineHeight()) * (high - low);
  }
  private lineHeight(): number {
    const { height } = this.size;
    return Math.max(height - this.lanes * kLane, height * 0.3);
  }

  private drawGrid(units: string[], scene: Scene): void {
    this.lanes = this.laneOrder(this.curves(scene)).length;
    const { width, height } = this.size;
    const key = [width, height, this.lanes, ...units.flatMap((unit) => [unit, this.rangeOf(unit).low, this.rangeOf(unit).high])].join();
    if (key === this.gridOf) return;
    this.gridOf = key;
    // Lanes need their height, whatever else there is space for.
    this.plot.style.minHeight = this.lanes ? `${this.lanes * kLane + (units.length ? 40 : 4)}px` : "";
    const inner = this.lineHeight();
    const shapes: SVGElement[] = [];
    units.slice(0, 2).forEach((unit, side) => {
      const { low, high } = this.rangeOf(unit);
      const count = Math.max(inner / 26, 2);
      const step = stepOf(high - low, count);
      for (const value of ticks(low, high, count)) {
        const y = this.y(value, unit);
        if (side === 0) shapes.push(svg("line", { class: "grid", x1: kLeft, x2: kLeft + width, y1: y, y2: y }));
        const at = Math.min(Math.max(y + 4, 10), inner - 1);
        shapes.push(svg("text", side === 0 ? { class: "tick", x: kLeft - 6, y: at, "text-anchor": "end" } : { class: "tick", x: kLeft + width + 6, y: at }, tickText(value, step)));
      }
      if (unit) shapes.push(side === 0 ? svg("text", { class: "axis-unit", x: 4, y: inner / 2, transform: `rotate(-90 12 ${inner / 2})`, "text-anchor": "middle" }, unit)
        : svg("text", { class: "axis-unit", x: kLeft + width + kRight - 8, y: inner / 2, transform: `rotate(-90 ${kLeft + width + kRight - 8} ${inner / 2})`, "text-anchor": "middle" }, unit));
    });
    this.grid.replaceChildren(...shapes);
  }

  private drawGaps(scene: Scene, map: TimeMap): void {
    const marks: SVGElement[] = [];
    let rows = 0;
    for (const source of scene.sources)
      for (const gap of source.recordFor(scene.span, scene.changed).gaps) {
        if (gap.to + source.shift < scene.span.from || gap.from + source.shift > scene.span.to) continue;
        rows += gap.rows;
        const from = Math.max(this.x(gap.from + source.shift, map), kLeft);
        const width = Math.max(Math.min(this.x(gap.to + source.shift, map), kLeft + this.size.width) - from, 2);
        marks.push(svg("g", { class: "gap" }, svg("title", {}, `${gap.rows} rows are missing`), svg("rect", { x: from, y: 0, width, height: this.size.height, fill: "url(#hatch)" }),
          svg("text", { x: from + 3, y: this.size.height - 5 }, width > 60 ? `${gap.rows} rows missing` : "")));
      }
    this.drawn.gaps = rows;
    if (marks.length || this.gaps.childElementCount) this.gaps.replaceChildren(...marks);
  }

  private drawMarks(scene: Scene, map: TimeMap, units: string[]): void {
    const { view, span } = scene;
    const marks: SVGElement[] = [];
    const { width, height } = this.size;
    for (const name of ["A", "B"] as Cursor[]) {
      const t = view.cursors[name];
      if (t === null || t < span.from || t > span.to) continue;
      const x = this.x(t, map);
      marks.push(svg("line", { class: "cursor" + (view.active === name ? " active" : ""), "data-cursor": name, x1: x, x2: x, y1: 0, y2: height }),
        svg("rect", { class: "cursor-flag", x, y: 0, width: 14, height: 14 }), svg("text", { class: "cursor-name", x: x + 4, y: 11 }, name));
    }
    for (const name of ["C", "D"] as const) {
      const value = this.values[name];
      if (value === null) continue;
      const y = this.y(value, units[0] ?? "");
      marks.push(svg("line", { class: "cursor value", "data-cursor": name, x1: kLeft, x2: kLeft + width, y1: y, y2: y }),
        svg("rect", { class: "cursor-flag", x: kLeft + width - 14, y: y - 14, width: 14, height: 14 }), svg("text", { class: "cursor-name", x: kLeft + width - 11, y: y - 3 }, name));
    }
    const level = scene.level;
    const column = level && this.paths.includes(level.path) ? scene.sources[0]?.record.column(level.path) : undefined;
    if (level && column && units.includes(column.unit)) {
      const y = this.y(level.value, column.unit);
      marks.push(svg("line", { class: "level", x1: kLeft, x2: kLeft + width, y1: y, y2: y }),
        svg("path", { class: "level-flag", d: `M${kLeft} ${y}l-9 -7h-9v14h9z` }), svg("text", { class: "level-name", x: kLeft - 15, y: y + 4 }, "T"));
    }
    if (marks.length || this.marks.childElementCount) this.marks.replaceChildren(...marks);
  }

  private drawBandNames(scene: Scene, curves: Curve[], map: TimeMap): void {
    const lanes = this.laneOrder(curves);
    const shapes: SVGElement[] = [];
    lanes.forEach((path, lane) => {
      const one = curves.find(({ line, order }) => order === 0 && line.path === path);
      if (!one) return;
      const y = this.size.height - (lanes.length - lane) * kLane + kLane - kLanePause - 3;
      shapes.push(svg("text", { class: "tick", x: kLeft - 6, y, "text-anchor": "end" }, path.length > 11 ? "…" + path.slice(-8) : path));
      if (one.column.type === "BOOL" || map.isSweeping) return;
      const { record, column } = one;
      let begin = Math.max(record.rowAt(scene.span.from) - 1, 0);
      const behind = Math.min(record.rowAt(scene.span.to) + 1, record.size);
      for (let row = begin; row <= behind && shapes.length < 200; ++row) {
        if (row < behind && column.value[row] === column.value[begin]) continue;
        const from = Math.max(this.x(record.t[begin], map), kLeft);
        const to = Math.min(this.x(record.t[Math.min(row, record.size - 1)], map), kLeft + this.size.width);
        const text = column.names?.[column.value[begin]] ?? short(column.value[begin]);
        const fits = Math.floor((to - from - 6) / 7);
        if (fits >= Math.min(text.length, 4)) shapes.push(svg("text", { class: "band-name", x: from + 4, y }, svg("title", {}, text), text.length <= fits ? text : text.slice(0, fits - 1) + "…"));
        begin = row;
      }
    });
    if (shapes.length || this.bands.childElementCount) this.bands.replaceChildren(...shapes);
  }
}

/// The axis of time below all diagrams.
export class TimeAxis {
  private readonly labels = svg("g");
  readonly element = svg("svg", { class: "time", "aria-label": "Time in seconds", role: "img" }, this.labels);
  private labelsOf = "";
  private base = 0;

  draw(span: Span, isSweeping: boolean): void {
    const width = this.element.clientWidth - kLeft - kRight;
    if (width <= 0) return;
    const length = span.to - span.from;
    const step = stepOf(length, width / 110);
    const first = isSweeping ? 0 : Math.ceil(span.from / step);
    const last = isSweeping ? Math.floor(length / step) : Math.floor(span.to / step);
    const key = [width, length, first, last, isSweeping].join();
    const origin = isSweeping ? 0 : span.from;
    if (key !== this.labelsOf) {
      this.labelsOf = key;
      this.base = origin;
      const texts: SVGElement[] = [];
      for (let i = first; i <= last; ++i)
        texts.push(svg("text", { class: "tick", x: kLeft + ((i * step - origin) / length) * width, y: 14, "text-anchor": "middle" }, (isSweeping ? "+" : "") + seconds(i * step, step) + " s"));
      this.labels.replaceChildren(...texts);
    }
    this.labels.setAttribute("transform", `translate(${((this.base - origin) / length) * width} 0)`);
  }
}
