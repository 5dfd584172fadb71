// Layouts by name, in this browser.

import { button, html } from "../base/dom";
import { Layout, keepLayouts, keptLayouts } from "./layout";

export interface LayoutsNotes { project(): string; layout(): Layout; use(layout: Layout): void }

export class Layouts {
  private readonly name = html("input", { "aria-label": "Name of the layout", placeholder: "name", spellcheck: "false" });
  private readonly list = html("ul", { class: "layouts", "aria-label": "Layouts" });
  readonly element = html("section", { class: "layouts-panel", "aria-label": "Layouts" }, html("p", { class: "row" }, this.name, button("Keep", "Keep this layout in the browser", () => this.keep())),
    this.list);

  constructor(private readonly notes: LayoutsNotes) {
    this.name.addEventListener("keydown", (event) => { if (event.key === "Enter") this.keep(); });
  }

  private own(): [string, Layout][] { return Object.entries(keptLayouts(this.notes.project())).filter(([name]) => name !== ""); }

  draw(): void {
    const own = this.own().map(([name, layout]) => this.item(name, layout, () => {
      const { [name]: _, ...rest } = keptLayouts(this.notes.project());
      keepLayouts(this.notes.project(), rest);
      this.draw();
    }));
    this.list.replaceChildren(...own);
    if (!this.list.childElementCount) this.list.append(html("li", { class: "faint" }, "No layout is kept yet. What you leave is there again when you come back."));
  }

  private item(name: string, layout: Layout, remove: () => void): HTMLElement {
    return html("li", { class: "row" }, html("button", { type: "button", "data-layout": name, click: () => this.notes.use(structuredClone(layout)) }, name),
      button("×", `Forget ${name}`, remove));
  }

  private keep(): void {
    const name = this.name.value.trim();
    if (!name) return this.name.focus();
    keepLayouts(this.notes.project(), { ...keptLayouts(this.notes.project()), [name]: structuredClone(this.notes.layout()) });
    this.draw();
  }
}
