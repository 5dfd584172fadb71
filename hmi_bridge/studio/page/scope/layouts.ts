// Layouts by name, in this browser and beside the project.

import { button, html } from "../base/dom";
import { Link, RequestError } from "../base/link";
import { Layout, keepLayouts, keptLayouts, readLayout } from "./layout";

export interface LayoutsNotes { link: Link; project(): string; layout(): Layout; use(layout: Layout): void }

export class Layouts {
  private readonly name = html("input", { "aria-label": "Name of the layout", placeholder: "name", spellcheck: "false" });
  private readonly list = html("ul", { class: "layouts", "aria-label": "Layouts" });
  private readonly state = html("p", { class: "faint", role: "status" });
  readonly element = html("section", { class: "layouts-panel", "aria-label": "Layouts" }, html("p", { class: "row" }, this.name, button("Keep", "Keep this layout in the browser", () => this.keep()),
    button("Share", "Keep it beside the project, in studio.json", () => void this.share())), this.list, this.state);
  private shared: Record<string, unknown> = {};
  private etag = "";

  constructor(private readonly notes: LayoutsNotes) {
    this.name.addEventListener("keydown", (event) => { if (event.key === "Enter") this.keep(); });
  }

  async refresh(): Promise<void> {
    try {
      const response = await this.notes.link.optional("api/layouts");
      this.etag = response.headers.get("ETag") ?? "";
      this.shared = (await response.json()).layouts ?? {};
    } catch {
      this.shared = {};  // a studio without them
    }
    this.draw();
  }

  private own(): [string, Layout][] { return Object.entries(keptLayouts(this.notes.project())).filter(([name]) => name !== ""); }

  private draw(): void {
    const own = this.own().map(([name, layout]) => this.item(name, layout, "browser", () => {
      const { [name]: _, ...rest } = keptLayouts(this.notes.project());
      keepLayouts(this.notes.project(), rest);
      this.draw();
    }));
    const shared = Object.entries(this.shared).flatMap(([name, kept]) => {
      const layout = readLayout(kept);
      return layout ? [this.item(name, layout, "project", null)] : [];
    });
    this.list.replaceChildren(...own, ...shared);
    if (!this.list.childElementCount) this.list.append(html("li", { class: "faint" }, "No layout is kept yet. What you leave is there again when you come back."));
  }

  private item(name: string, layout: Layout, where: string, remove: (() => void) | null): HTMLElement {
    return html("li", { class: "row" }, html("button", { type: "button", "data-layout": name, click: () => this.notes.use(structuredClone(layout)) }, name, html("span", { class: "unit" }, where)),
      ...(remove ? [button("×", `Forget ${name}`, remove)] : []));
  }

  private keep(): void {
    const name = this.name.value.trim();
    if (!name) return this.name.focus();
    keepLayouts(this.notes.project(), { ...keptLayouts(this.notes.project()), [name]: structuredClone(this.notes.layout()) });
    this.draw();
  }

  private async share(): Promise<void> {
    const name = this.name.value.trim();
    if (!name) return this.name.focus();
    try {
      await this.refresh();
      this.etag = await this.notes.link.put("api/layouts", { layouts: { ...this.shared, [name]: this.notes.layout() } }, this.etag);
      this.state.textContent = "";
      await this.refresh();
    } catch (error) {
      this.state.textContent = error instanceof RequestError && error.status === 404 ? "This studio keeps no layouts; use Keep." : (error as Error).message;
    }
  }
}
