// What stands above a diagram: its signals with their values, and what one can do to each.

import { button, html, svg } from "../base/dom";
import { numberOf } from "../base/scale";
import { AxisSetup, Line, kColours } from "./layout";

export interface LegendNotes {
  remove(path: string): void;
  /// a line or an axis has been set otherwise
  changed(): void;
  resized(): void;
  trigger(path: string): void;
  analyse(path: string, how: "spectrum" | "xy"): void;
  close(): void;
  fit(unit: string): void;
  drag(path: string, event: PointerEvent): void;
}

export class Legend {
  private readonly list = html("ul", { class: "legend" });
  private readonly settings = html("div", { class: "popover", role: "dialog", "aria-label": "Signal settings", hidden: true });
  readonly element: HTMLElement;
  private values = new Map<string, HTMLElement>();
  private openPath = "";

  constructor(private readonly notes: LegendNotes) {
    this.element = html("header", { class: "diagram-head" }, this.list,
      button("×", "Close this diagram", () => this.notes.close()), this.settings);
    this.settings.addEventListener("keydown", (event) => { if (event.key === "Escape") { event.stopPropagation(); this.hide(); } });
  }

  private hide(): void {
    this.settings.hidden = true;
    this.list.querySelector<HTMLButtonElement>(`[data-line="${CSS.escape(this.openPath)}"]`)?.focus();
    this.openPath = "";
  }

  set(lines: Line[], colour: (line: Line) => string, unit: (path: string) => string, axes: Record<string, AxisSetup>): void {
    this.values.clear();
    this.list.replaceChildren(...lines.map((line) => {
      const value = html("output", { class: "value" }, "–");
      this.values.set(line.path, value);
      const swatch = svg("svg", { class: "swatch", viewBox: "0 0 16 6" }, svg("line", { x1: 0, x2: 16, y1: 3, y2: 3, stroke: colour(line), "stroke-width": Math.max(line.width, 2),
        ...(line.dash ? { "stroke-dasharray": "4 3" } : {}) }));
      const name = html("button", { type: "button", class: "line", "data-line": line.path, title: line.path + ": colour, line, scale, offset; drag it to another diagram",
        click: () => this.open(line, unit(line.path), axes) }, swatch, html("span", { class: "path" }, line.path));
      name.addEventListener("pointerdown", (event) => this.notes.drag(line.path, event));
      const scaled = line.scale !== 1 || line.offset !== 0 ? html("span", { class: "unit" }, `×${line.scale}${line.offset ? (line.offset > 0 ? "+" : "") + line.offset : ""}`) : "";
      return html("li", { class: line.isVisible ? "" : "invisible" }, name, value, html("span", { class: "unit" }, unit(line.path)), scaled,
        button("×", "Remove " + line.path, () => this.notes.remove(line.path)));
    }));
    if (!lines.length) this.list.replaceChildren(html("li", { class: "faint" }, "empty: drag a signal here, or choose this diagram and click one"));
  }

  showValues(text: (path: string) => string): void {
    for (const [path, element] of this.values) {
      const now = text(path);
      if (element.textContent !== now) element.textContent = now;
    }
  }

  private open(line: Line, unit: string, axes: Record<string, AxisSetup>): void {
    if (this.openPath === line.path) return this.hide();
    this.openPath = line.path;
    const changed = (): void => this.notes.changed();
    const number = (label: string, value: number, set: (value: number) => void): HTMLElement => {
      const field = html("input", { "aria-label": label, inputmode: "decimal", value: String(value), change: () => {
        const given = numberOf(field.value);
        field.setAttribute("aria-invalid", String(!isFinite(given)));
        if (isFinite(given)) { set(given); changed(); }
      } });
      return html("label", { class: "field" }, html("span", {}, label), field);
    };
    const choice = (label: string, options: [string, string][], value: string, set: (value: string) => void): HTMLElement => {
      const field = html("select", { "aria-label": label, change: () => { set(field.value); changed(); } }, ...options.map(([key, text]) => html("option", { value: key, selected: key === value }, text)));
      return html("label", { class: "field" }, html("span", {}, label), field);
    };
    const visible = html("input", { type: "checkbox", "aria-label": "Visible", checked: line.isVisible, change: () => { line.isVisible = visible.checked; changed(); } });
    const axis: AxisSetup = axes[unit] ?? { mode: "auto", range: null };
    const ends = (): void => { axes[unit] = axis; };
    this.settings.replaceChildren(html("h3", {}, line.path),
      html("div", { class: "colours", role: "group", "aria-label": "Colour" }, ...Array.from({ length: kColours }, (_, i) => html("button", { type: "button", class: `colour colour-${i}`,
        title: `Colour ${i + 1}`, "aria-label": `Colour ${i + 1}`, "aria-pressed": String(line.colour === i), click: () => { line.colour = i; changed(); } }))),
      number("Width", line.width, (value) => { line.width = Math.min(Math.max(value, 1), 5); }),
      choice("Line", [["0", "solid"], ["6", "dashed"], ["2", "dotted"]], String(line.dash), (value) => { line.dash = Number(value); }),
      choice("Drawn as", [["auto", "what fits"], ["line", "line"], ["bands", "bands"]], line.shape, (value) => { line.shape = value as Line["shape"]; }),
      number("Scale", line.scale, (value) => { line.scale = value || 1; }), number("Offset", line.offset, (value) => { line.offset = value; }),
      html("label", { class: "check" }, visible, " visible"),
      choice(`Axis [${unit || "1"}]`, [["auto", "automatic"], ["fixed", "fixed"], ["common", "common to the unit"]], axis.mode, (value) => {
        axis.mode = value as AxisSetup["mode"];
        ends();
        if (value === "fixed" && !axis.range) this.notes.fit(unit);
      }),
      number("Lower end", axis.range?.low ?? 0, (value) => { axis.mode = "fixed"; axis.range = { low: value, high: Math.max(axis.range?.high ?? value + 1, value + 1e-9) }; ends(); }),
      number("Upper end", axis.range?.high ?? 1, (value) => { axis.mode = "fixed"; axis.range = { low: Math.min(axis.range?.low ?? value - 1, value - 1e-9), high: value }; ends(); }),
      html("p", { class: "row" }, button("Trigger on it", "Take it as the signal of the trigger", () => { this.hide(); this.notes.trigger(line.path); }),
        button("Spectrum", "Its spectrum between the cursors, or in the window", () => { this.hide(); this.notes.analyse(line.path, "spectrum"); }),
        button("XY", "Over another signal", () => { this.hide(); this.notes.analyse(line.path, "xy"); }), button("Close", "Close (Esc)", () => this.hide())));
    this.settings.hidden = false;
    const { left, bottom } = this.element.getBoundingClientRect();
    this.settings.style.left = Math.max(Math.min(left + 80, window.innerWidth - this.settings.offsetWidth - 8), 4) + "px";
    this.settings.style.top = Math.max(Math.min(bottom, window.innerHeight - this.settings.offsetHeight - 8), 4) + "px";
    this.settings.querySelector<HTMLElement>("button, input")?.focus();
  }
}
