// Layouts by name: in this browser, and at the desk beside the project, where everybody has them.

import { button, html } from "../base/dom";
import { Link, RequestError } from "../base/link";
import { Layout, keepLayouts, keptLayouts, readLayout } from "./layout";

export interface LayoutsNotes { link: Link; project(): string; layout(): Layout; use(layout: Layout): void }

const kFile = "api/files/studio.json";

/// What stands in studio.json. Its ETag says which of it is known, "": it is not there yet.
class Shared {
  private kept: Record<string, unknown> = {};
  private etag = "";

  constructor(private readonly link: Link) {}

  layouts(): [string, Layout][] {
    return Object.entries(this.kept).map(([name, kept]): [string, Layout | null] => [name, readLayout(kept)]).filter((one): one is [string, Layout] => one[1] !== null);
  }

  async read(): Promise<void> {
    try {
      const response = await this.link.get(kFile);
      const read = await response.json();
      if (read?.lockstep_studio !== 1 || typeof read.layouts !== "object") throw new Error("studio.json beside the project holds no layouts");
      this.kept = read.layouts;
      this.etag = response.headers.get("ETag") ?? "";
    } catch (error) {
      if (!(error instanceof RequestError) || error.status !== 404) throw error;
      this.kept = {};
      this.etag = "";
    }
  }

  /// Nothing of what others have kept meanwhile is lost.
  async change(name: string, layout: Layout | null): Promise<void> {
    await this.read();
    const { [name]: _, ...rest } = this.kept;
    const text = JSON.stringify({ lockstep_studio: 1, layouts: layout ? { ...rest, [name]: layout } : rest }, null, 1) + "\n";
    await this.link.put(kFile, text, this.etag);
    await this.read();
  }
}

export class Layouts {
  private readonly name = html("input", { "aria-label": "Name of the layout", placeholder: "name", spellcheck: "false" });
  private readonly list = html("ul", { class: "layouts", "aria-label": "Layouts" });
  private readonly shareButton = button("Keep beside the project", "Keep this layout in studio.json beside the project", () => this.share(this.name.value.trim(), structuredClone(this.notes.layout())));
  private readonly sharedList = html("ul", { class: "layouts", "aria-label": "Layouts beside the project" }, html("li", { class: "faint" }, "None yet."));  // so that what is below does not move when they are read
  private readonly told = html("p", { class: "faint", role: "status" });
  private readonly beside = html("section", { "aria-label": "Beside the project", hidden: true }, html("h3", {}, "Beside the project"), this.sharedList, html("p", { class: "row" }, this.shareButton), this.told);
  readonly element = html("section", { class: "layouts-panel", "aria-label": "Layouts" }, html("p", { class: "row" }, this.name, button("Keep", "Keep this layout in the browser", () => this.keep())),
    this.list, this.beside);
  private readonly shared: Shared;

  constructor(private readonly notes: LayoutsNotes) {
    this.shared = new Shared(notes.link);
    this.name.addEventListener("keydown", (event) => { if (event.key === "Enter") this.keep(); });
  }

  /// @param isDesk the studio has the files of the project
  setDesk(isDesk: boolean): void { this.beside.hidden = !isDesk; }

  private own(): [string, Layout][] { return Object.entries(keptLayouts(this.notes.project())).filter(([name]) => name !== ""); }

  draw(): void {
    const own = this.own().map(([name, layout]) => this.item(name, layout, () => {
      const { [name]: _, ...rest } = keptLayouts(this.notes.project());
      keepLayouts(this.notes.project(), rest);
      this.draw();
    }));
    this.list.replaceChildren(...own);
    if (!this.list.childElementCount) this.list.append(html("li", { class: "faint" }, "No layout is kept yet. What you leave is there again when you come back."));
    if (!this.beside.hidden) void this.shared.read().then(() => this.drawShared(), (error) => { this.told.textContent = error.message; });
  }

  private drawShared(): void {
    this.sharedList.replaceChildren(...this.shared.layouts().map(([name, layout]) => this.item(name, layout, () => this.share(name, null))));
    if (!this.sharedList.childElementCount) this.sharedList.append(html("li", { class: "faint" }, "None yet."));
  }

  private share(name: string, layout: Layout | null): void {
    if (!name) return this.name.focus();
    this.shared.change(name, layout).then(() => { this.told.textContent = ""; this.drawShared(); }, (error) => { this.told.textContent = error.message; });
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
