// What the cursors say: values of each signal at A and B, their differences, slope, and statistics between; and values C and D.

import { button, html, renew } from "../base/dom";
import { duration, seconds, short } from "../base/scale";
import { Recording } from "./record";
import { View } from "./view";

export interface Statistics {
  signal: string; n: number; nans?: number; minimum?: number; maximum?: number; t_minimum?: string; t_maximum?: string; mean?: number; deviation?: number; rms?: number;
  peak_to_peak?: number; integral?: number;
}

const kHeads: [string, string][] = [
  ["A", "value at cursor A"], ["B", "value at cursor B"], ["B − A", "difference"], ["slope /s", "difference by time"], ["minimum", "between the cursors"], ["maximum", "between the cursors"],
  ["p-p", "peak to peak"], ["mean", "between the cursors"], ["σ", "standard deviation"], ["rms", "root of the mean square"], ["∫ dt", "integral over time [unit·s]"], ["n", "rows"], ["NaN", "rows without a number"],
];

export class Measure {
  private readonly times = html("p", { class: "times", role: "status" }, "Place A and B: a click and Shift+click in a diagram, or the keys A and B. C and D measure values.");
  private readonly body = html("tbody");
  readonly element = html("section", { class: "measure", "aria-label": "Cursors" }, this.times,
    html("table", { class: "numbers" }, html("caption", { class: "unseen" }, "Values at the cursors and statistics between them"),
      html("thead", {}, html("tr", {}, html("th", { scope: "col" }, "Signal"), ...kHeads.map(([head, title]) => html("th", { scope: "col", title }, head)))), this.body));
  private statistics = new Map<string, Statistics>();
  private statisticsOf = "";

  /// @param ask gives the statistics of all that is shown, between two times  @param show brings a moment into the picture
  constructor(private readonly ask: (from: number, to: number) => Promise<Statistics[]>, private readonly show: (t: number) => void) {}

  draw(record: Recording, view: View, shift: number, values: { C: number | null; D: number | null; unit: string }): void {
    const { A, B } = view.cursors;
    const span = A !== null && B !== null ? B - A : NaN;
    const parts = [A !== null ? `A ${seconds(A, 1e5)} s` : "", B !== null ? `B ${seconds(B, 1e5)} s` : ""];
    if (span === span) parts.push(`B − A ${duration(span)}`, `1 / (B − A) ${span === 0 ? "–" : short(1e9 / Math.abs(span)) + " Hz"}`);
    for (const name of ["C", "D"] as const) if (values[name] !== null) parts.push(`${name} ${short(values[name]!)} ${values.unit}`);
    if (values.C !== null && values.D !== null) parts.push(`D − C ${short(values.D - values.C)} ${values.unit}`);
    const text = parts.filter(Boolean).join("    ") || "Place A and B: a click and Shift+click in a diagram, or the keys A and B. C and D measure values.";
    if (this.times.textContent !== text) this.times.textContent = text;
    this.fetch(A, B, record);
    if (this.element.hidden) return;
    const rowA = A === null ? -1 : record.nearest(A - shift);
    const rowB = B === null ? -1 : record.nearest(B - shift);
    renew(this.body, A === null && B === null ? [] : record.columns.map((column) => this.row(column, rowA, rowB, span, shift)));
  }

  private row({ path, unit, value }: Recording["columns"][number], rowA: number, rowB: number, span: number, shift: number): HTMLElement {
    const a = rowA < 0 ? NaN : value[rowA];
    const b = rowB < 0 ? NaN : value[rowB];
    const known = this.statistics.get(path);
    const cells: [number | undefined, string?][] = [[a], [b], [b - a], [((b - a) / span) * 1e9], [known?.minimum, known?.t_minimum], [known?.maximum, known?.t_maximum],
      [known?.peak_to_peak], [known?.mean], [known?.deviation], [known?.rms], [known?.integral], [known?.n], [known?.nans]];
    return html("tr", { "data-path": path }, html("th", { scope: "row" }, unit ? `${path} [${unit}]` : path), ...cells.map(([cell, t]) => {
      const text = cell === undefined || cell !== cell ? "–" : typeof cell === "number" ? short(cell, 9) : String(cell);
      return html("td", {}, t === undefined ? text : button(text, `at ${seconds(Number(t) + shift, 1e5)} s; show it`, () => this.show(Number(t) + shift)));
    }));
  }

  private fetch(A: number | null, B: number | null, record: Recording): void {
    const key = A === null || B === null ? "" : [A, B, record.columns.map(({ path }) => path)].join();
    if (key === this.statisticsOf) return;
    this.statisticsOf = key;
    this.statistics.clear();
    if (A === null || B === null) return;
    setTimeout(async () => {
      if (key !== this.statisticsOf) return;  // a cursor has been moved on
      const all = await this.ask(Math.min(A, B), Math.max(A, B)).catch(() => []);
      if (key === this.statisticsOf) this.statistics = new Map(all.map((one) => [one.signal, one]));
    }, 150);
  }
}
