// Two signals over each other, the spectrum of one, and the rows as a table: of the stretch between the cursors, or of what is shown.

import { chart, chartAxis } from "../base/chart";
import { html, svg } from "../base/dom";
import { decode } from "../base/frames";
import { Link } from "../base/link";
import { seconds, short, valueText } from "../base/scale";
import { Source } from "./source";
import { Span, View } from "./view";

export interface AnalysisScene { source: Source; others: Source[]; view: View; span: Span; paths: string[]; wrap(path: string): number }

/// Between A and B, or else the window.
export function stretch({ view, span }: { view: View; span: Span }): Span {
  const { A, B } = view.cursors;
  return A !== null && B !== null && A !== B ? { from: Math.min(A, B), to: Math.max(A, B) } : span;
}

function choices(select: HTMLSelectElement, options: [string, string][]): void {
  const key = options.map(([value]) => value).join("\n");
  if (select.dataset.options === key) return;
  const before = select.value;
  select.dataset.options = key;
  select.replaceChildren(...options.map(([value, text]) => html("option", { value }, text)));
  if (options.some(([value]) => value === before)) select.value = before;
}

/// Lets something be done so often at most; what comes too early is made up for, so that the last of it is never lost.
class Pace {
  private last = 0;
  private timer = 0;
  /// @param again called when it is time
  constructor(private readonly pause: number, private readonly again: () => void) {}
  isDue(): boolean {
    const left = this.last + this.pause - performance.now();
    if (left > 0) { this.timer ||= window.setTimeout(() => { this.timer = 0; this.again(); }, left); return false; }
    this.last = performance.now();
    return true;
  }
}

const unitLabel = (path: string, unit: string): string => (unit ? `${path} [${unit}]` : path);

export class XyPlot {
  private readonly renew = (): void => { this.key = ""; this.changed(); };
  private readonly x = html("select", { "aria-label": "Signal to the right", change: this.renew });
  private readonly y = html("select", { "aria-label": "Signal upwards", change: this.renew });
  private readonly other = html("select", { "aria-label": "Trace of the signal upwards", change: this.renew });
  private readonly picture = svg("svg", { class: "chart", role: "img", "aria-label": "XY" });
  readonly element = html("section", { class: "analysis", "aria-label": "XY", hidden: true },
    html("p", { class: "row" }, html("label", {}, "right ", this.x), html("label", {}, "up ", this.y), html("label", {}, "of ", this.other)), this.picture);
  private key = "";
  private readonly pace = new Pace(150, () => this.changed());

  /// @param changed it has to be drawn again, though nothing moves
  constructor(private readonly changed: () => void) {}

  choose(path: string): void { this.y.value = path; this.renew(); }

  draw(scene: AnalysisScene): void {
    if (this.element.hidden) return;
    const { source } = scene;
    const options = source.record.columns.map(({ path }): [string, string] => [path, path]);
    const isFirst = !this.x.dataset.options;
    choices(this.x, options);
    choices(this.y, options);
    if (isFirst && options.length > 1) this.y.value = options[1][0];
    choices(this.other, [source, ...scene.others].map((one): [string, string] => [one.id, one.name]));
    const part = stretch(scene);
    const { A, B } = scene.view.cursors;
    const width = this.picture.clientWidth;
    const height = this.picture.clientHeight;
    const key = [this.x.value, this.y.value, this.other.value, width, height, part.from, part.to, A, B].join();
    if (key === this.key || !this.pace.isDue()) return;
    this.key = key;
    this.show(scene, part, width, height);
  }

  private show(scene: AnalysisScene, part: Span, width: number, height: number): void {
    const { source } = scene;
    const with_ = scene.others.find(({ id }) => id === this.other.value) ?? source;
    const recordX = source.recordFor(part, this.renew);
    const recordY = with_ === source ? recordX : with_.recordFor(part, this.renew);
    const [columnX, columnY] = [recordX.column(this.x.value), recordY.column(this.y.value)];
    if (!columnX || !columnY) return this.picture.replaceChildren();
    const first = recordX.rowAt(part.from - source.shift);
    const behind = recordX.rowAt(part.to - source.shift + 1);
    const rowY = (row: number): number => (recordX === recordY ? row : recordY.nearest(recordX.t[row] + source.shift - with_.shift));
    const xs = new Float64Array(Math.max(behind - first, 0));
    const ys = new Float64Array(xs.length);
    for (let i = 0; i < xs.length; ++i) {
      xs[i] = columnX.value[first + i];
      const row = rowY(first + i);
      ys[i] = row < 0 ? NaN : columnY.value[row];
    }
    const marks = (["A", "B"] as const).flatMap((name) => {
      const t = scene.view.cursors[name];
      const row = t === null ? -1 : recordX.nearest(t - source.shift);
      return row < 0 ? [] : [{ x: columnX.value[row], y: columnY.value[rowY(row)], name }];
    });
    const [wrapX, wrapY] = [scene.wrap(columnX.path), scene.wrap(columnY.path)];
    const breaks = (i: number): boolean => i > 0 && (!!recordX.breaks[first + i] || Math.abs(xs[i] - xs[i - 1]) > wrapX || Math.abs(ys[i] - ys[i - 1]) > wrapY);
    this.picture.replaceChildren(...chart(width, height, xs, ys, chartAxis(unitLabel(columnX.path, columnX.unit), xs), chartAxis(unitLabel(columnY.path, columnY.unit), ys), marks, breaks));
    this.picture.setAttribute("aria-label", `${columnY.path} over ${columnX.path}, ${xs.length} rows`);
    this.picture.dataset.points = String(xs.length);
  }
}

interface SpectrumAnswer {
  signal: string; unit: string; n: number; step: number; axis: string; amplitude: number[]; peaks: { at: number; amplitude: number }[];
}

export class Spectrum {
  private readonly signal = html("select", { "aria-label": "Signal of the spectrum" });
  private readonly window_ = html("select", { "aria-label": "Window of the spectrum" }, ...[["hann", "Hann"], ["rectangle", "rectangle"], ["flattop", "flat top"]].map(([value, text]) => html("option", { value }, text)));
  private readonly order = html("select", { "aria-label": "Axis of the orders" });
  private readonly isDecibel = html("input", { type: "checkbox", "aria-label": "Decibel", change: () => this.show() });
  private readonly picture = svg("svg", { class: "chart", role: "img", "aria-label": "Spectrum" });
  private readonly peaks = html("tbody");
  private readonly state = html("p", { class: "faint", role: "status" });
  readonly element = html("section", { class: "analysis", "aria-label": "Spectrum", hidden: true },
    html("p", { class: "row" }, html("label", {}, "of ", this.signal), html("label", {}, "window ", this.window_), html("label", {}, "by ", this.order), html("label", {}, this.isDecibel, " dB"),
      html("button", { type: "button", class: "primary", click: () => void this.ask() }, "Compute"), this.state),
    html("div", { class: "beside" }, this.picture, html("table", { class: "numbers" }, html("caption", {}, "Peaks"),
      html("thead", {}, html("tr", {}, html("th", { scope: "col" }, "at"), html("th", { scope: "col" }, "amplitude"))), this.peaks)));
  private answer: SpectrumAnswer | null = null;
  private scene: AnalysisScene | null = null;

  constructor(private readonly link: Link) {}

  choose(path: string): void { this.signal.value = path; void this.ask(); }

  draw(scene: AnalysisScene): void {
    this.scene = scene;
    const options = scene.source.record.columns.filter(({ type }) => type !== "BOOL").map(({ path }): [string, string] => [path, path]);
    choices(this.signal, options);
    choices(this.order, [["", "frequency"], ...options.filter(([path]) => /Position$/.test(path)).map(([path]): [string, string] => [path, "orders of " + path])]);
  }

  private async ask(): Promise<void> {
    if (!this.scene || !this.signal.value) return;
    const part = stretch(this.scene);
    const { source } = this.scene;
    const order = this.order.value ? "&order=" + encodeURIComponent(this.order.value) : "";
    this.state.textContent = "…";
    try {
      this.answer = await this.link.json(`api/traces/${source.id}/spectrum?signal=${encodeURIComponent(this.signal.value)}&window=${this.window_.value}${order}` +
        `&from=${Math.round(part.from - source.shift)}&to=${Math.round(part.to - source.shift)}`);
      this.state.textContent = `${this.answer!.n} rows, ${short((part.to - part.from) / 1e9, 4)} s`;
    } catch (error) {
      this.answer = null;
      this.state.textContent = (error as Error).message;
    }
    this.show();
  }

  private show(): void {
    if (!this.answer) { this.picture.replaceChildren(); this.peaks.replaceChildren(); return; }
    const { answer } = this;
    const level = (amplitude: number): number => (this.isDecibel.checked ? 20 * Math.log10(Math.max(amplitude, 1e-12)) : amplitude);
    const unit = this.isDecibel.checked ? `dB (1 ${answer.unit})` : answer.unit;
    const xs = answer.amplitude.map((_, i) => i * answer.step);
    const ys = answer.amplitude.map(level);
    const axis = answer.axis === "Hz" ? "frequency [Hz]" : "order";
    const marks = answer.peaks.slice(0, 5).map(({ at, amplitude }) => ({ x: at, y: level(amplitude), name: short(at, 4) }));
    this.picture.replaceChildren(...chart(this.picture.clientWidth, this.picture.clientHeight, xs, ys,
      { label: axis, low: 0, high: xs[xs.length - 1] || 1 }, chartAxis(unitLabel(answer.signal, unit), ys), marks));
    this.peaks.replaceChildren(...answer.peaks.map(({ at, amplitude }) => html("tr", {}, html("td", {}, `${short(at, 6)} ${answer.axis === "Hz" ? "Hz" : ""}`), html("td", {}, `${short(level(amplitude), 5)} ${unit}`))));
  }
}

const kRows = 200;

/// What a picture shows, for who does not see it: rows as a table.
export class ValueTable {
  private readonly head = html("tr");
  private readonly body = html("tbody");
  readonly element = html("section", { class: "values", "aria-label": "Values as a table", hidden: true },
    html("table", { class: "numbers" }, html("caption", {}, "Rows of what is shown, every so many, 200 at most"), html("thead", {}, this.head), this.body));
  private key = "";
  private readonly pace = new Pace(500, () => this.changed());

  /// @param changed it has to be drawn again, though nothing moves
  constructor(private readonly changed: () => void) {}

  draw({ source, span }: AnalysisScene): void {
    if (this.element.hidden) return;
    const record = source.recordFor(span, () => { this.key = ""; this.changed(); });
    const key = [span.from, span.to, record.size, record.columns.length, source.id].join();
    if (key === this.key || !this.pace.isDue()) return;
    this.key = key;
    const from = record.rowAt(span.from - source.shift);
    const to = record.rowAt(span.to - source.shift + 1);
    const step = Math.max(Math.ceil((to - from) / kRows), 1);
    this.head.replaceChildren(html("th", { scope: "col" }, "t [s]"), ...record.columns.map(({ path, unit }) => html("th", { scope: "col" }, unitLabel(path, unit))));
    const rows: HTMLElement[] = [];
    for (let row = from; row < to; row += step)
      rows.push(html("tr", {}, html("th", { scope: "row" }, seconds(record.t[row] + source.shift, 1e5)), ...record.columns.map((column) =>
        html("td", {}, column.type === "BOOL" ? valueText(column.value[row] === 1) : valueText(column.value[row])))));
    this.body.replaceChildren(...rows);
  }
}

/// Two signals of a frame of kind 3, as /api/traces/ID/xy has it.
export function xyOf(buffer: ArrayBuffer): { t: Float64Array; x: ArrayLike<number>; y: ArrayLike<number> } {
  const { t, columns } = decode(buffer);
  return { t, x: columns[0].arrays[0], y: columns[1].arrays[0] };
}
