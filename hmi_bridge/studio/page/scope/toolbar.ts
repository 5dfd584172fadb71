// What stands above the diagrams: live or stopped, how long a stretch, zoom, cursors, files.

import { button, html } from "../base/dom";
import { duration } from "../base/scale";
import type { Scope } from "./scope";

const kLengths = [1e7, 2e7, 5e7, 1e8, 2e8, 5e8, 1e9, 2e9, 5e9, 1e10, 2e10, 3e10, 6e10];  // [ns]

const kFormats: [string, "csv" | "lcm" | "html" | "svg" | "png" | "json", string][] = [
  ["CSV", "csv", "Save the values of what is shown"], ["LCM", "lcm", "Save the values as a log of LCM"], ["SVG", "svg", "Save the picture as SVG"], ["PNG", "png", "Save the picture as PNG"],
  ["HTML", "html", "Save one page with the values, which opens without a server"], ["Studio file", "json", "Save the layout with its values; opens again as it is"],
];

export class Toolbar {
  private readonly live: HTMLButtonElement;
  private readonly mode: HTMLSelectElement = html("select", { "aria-label": "How a live picture moves", change: () => this.scope.view.setSweeping(this.mode.value === "sweep") },
    html("option", { value: "roll" }, "roll"), html("option", { value: "sweep" }, "sweep"));
  private readonly length: HTMLSelectElement;
  private readonly menu: HTMLDetailsElement;
  private readonly source = html("span", { class: "source" });
  readonly element: HTMLElement;

  constructor(private readonly scope: Scope) {
    this.live = button("❚❚ Stop", "Stop the picture, or go on live (Space)", () => scope.toggleLive());
    this.live.classList.add("primary", "live");
    this.length = html("select", { "aria-label": "Length of the picture", change: () => { if (Number(this.length.value)) scope.setLength(Number(this.length.value)); } });
    this.menu = html("details", { class: "menu" }, html("summary", {}, "Save"), html("div", { class: "menu-list", role: "group", "aria-label": "Save" },
      ...kFormats.map(([label, format, title]) => button(label, title, () => { this.menu.open = false; void scope.export_(format); }))));
    this.menu.addEventListener("keydown", (event) => { if (event.key === "Escape") { this.menu.open = false; event.stopPropagation(); this.menu.querySelector("summary")?.focus(); } });
    document.addEventListener("pointerdown", (event) => { if (!this.menu.contains(event.target as Node)) this.menu.open = false; });
    const named = (sign: string, title: string, click: () => void): HTMLElement => { const one = button(sign, title, click); one.setAttribute("aria-label", title); return one; };
    const group = (...children: HTMLElement[]): HTMLElement => html("span", { class: "group" }, ...children);
    this.element = html("div", { class: "toolbar", role: "toolbar", "aria-label": "Oscilloscope" }, this.live, group(this.length, this.mode),
      group(named("−", "A longer stretch (−)", () => scope.zoom(1.6)), named("+", "A shorter stretch (+)", () => scope.zoom(0.625)), button("All", "All that is kept (Home)", () => scope.fit()),
        named("↶", "The stretch before (Backspace)", () => scope.view.back()), named("↷", "The stretch after (Shift+Backspace)", () => scope.view.forward()), named("↕", "All values again (V)", () => scope.zoomValues(null))),
      group(button("A", "Cursor A", () => scope.cursor("A")), button("B", "Cursor B", () => scope.cursor("B")), button("C", "Value cursor C", () => scope.valueCursor("C")), button("D", "Value cursor D", () => scope.valueCursor("D"))),
      group(named("‹▼", "The event before (P)", () => scope.jump(-1)), named("▼›", "The next event (N)", () => scope.jump(1))),
      group(button("+ Diagram", "A further diagram (I)", () => scope.newDiagram())), this.menu, this.source);
    this.update();
  }

  update(): void {
    const { view, isLive } = this.scope;
    this.live.textContent = isLive ? "❚❚ Stop" : "▶ Live";
    this.live.setAttribute("aria-pressed", String(!isLive));
    this.mode.value = view.isSweeping ? "sweep" : "roll";
    const { from, to } = view.window(this.scope.latest);
    const length = view.isLive ? view.span : to - from;
    const known = kLengths.find((one) => Math.abs(one - length) < 1e-6 * one);
    const options = [...(known ? [] : [length]), ...kLengths];
    this.length.replaceChildren(...options.map((one) => html("option", { value: one, selected: one === (known ?? length) }, duration(Number(one.toPrecision(3))))));
    this.source.textContent = this.source.title = this.scope.sourceName;
  }
}
