// What the two cursors say: values of each signal at both, their differences, and statistics between.

import { html } from "./dom";
import { Recording } from "./record";
import { duration, seconds, short } from "./scale";
import { View } from "./view";

interface Statistics { signal: string; n: number; minimum?: number; maximum?: number; mean?: number; deviation?: number; rms?: number }

const kHeads = ["Signal", "A", "B", "B − A", "per s", "minimum", "maximum", "mean", "deviation", "rms"];

export class Measure {
  private readonly times = html("p", { class: "times", role: "status" });
  private readonly body = html("tbody");
  readonly element = html("section", { class: "measure", "aria-label": "Cursors", hidden: true }, this.times,
    html("table", {}, html("thead", {}, html("tr", {}, ...kHeads.map((head) => html("th", { scope: "col" }, head)))), this.body));
  private statistics = new Map<string, Statistics>();
  private statisticsOf = "";

  /// @param ask gives the statistics of all that is shown, between two times
  constructor(private readonly ask: (from: number, to: number) => Promise<Statistics[]>) {}

  draw(record: Recording, view: View): void {
    const { A, B } = view.cursors;
    this.element.hidden = A === null && B === null;
    if (this.element.hidden) return;
    const span = A !== null && B !== null ? B - A : NaN;
    const parts = [A !== null ? `A ${seconds(A, 1e5)} s` : "", B !== null ? `B ${seconds(B, 1e5)} s` : ""];
    if (span === span) parts.push(`B − A ${duration(span)}`, `1 / (B − A) ${span === 0 ? "–" : short(1e9 / Math.abs(span)) + " Hz"}`);
    this.times.textContent = parts.filter(Boolean).join("    ");
    const rowA = A === null ? -1 : record.nearest(A);
    const rowB = B === null ? -1 : record.nearest(B);
    this.fetch(A, B, record);
    this.body.replaceChildren(...record.columns.map(({ path, unit, value }) => {
      const a = rowA < 0 ? NaN : value[rowA];
      const b = rowB < 0 ? NaN : value[rowB];
      const known = this.statistics.get(path);
      const cells = [a, b, b - a, ((b - a) / span) * 1e9, known?.minimum, known?.maximum, known?.mean, known?.deviation, known?.rms];
      return html("tr", { "data-path": path }, html("th", { scope: "row" }, unit ? `${path} [${unit}]` : path),
        ...cells.map((cell) => html("td", {}, cell === undefined || cell !== cell ? "–" : typeof cell === "number" ? short(cell, 9) : String(cell))));
    }));
  }

  private fetch(A: number | null, B: number | null, record: Recording): void {
    const key = A === null || B === null ? "" : [A, B, record.columns.length].join();
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
