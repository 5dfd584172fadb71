// Several panels of which one is seen, as WAI-ARIA has tabs: arrow keys go from one to the next.

import { html } from "./dom";

export class Tabs {
  private readonly list: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();
  readonly element: HTMLElement;
  chosen = "";

  /// @param panels name and content  @param changed called with the name, "" where none is seen
  constructor(label: string, private readonly panels: [string, HTMLElement][], private readonly changed: (name: string) => void = () => undefined, private readonly canClose = false) {
    for (const [name, panel] of panels) {
      panel.setAttribute("role", "tabpanel");
      panel.setAttribute("aria-label", name);
      this.buttons.set(name, html("button", { type: "button", role: "tab", "data-tab": name, click: () => this.choose(this.canClose && this.chosen === name ? "" : name) }, name));
    }
    this.list = html("div", { class: "tabs", role: "tablist", "aria-label": label }, ...this.buttons.values());
    this.list.addEventListener("keydown", (event) => this.walk(event));
    this.element = html("div", { class: "tabbed" }, this.list, ...panels.map(([, panel]) => panel));
  }

  choose(name: string): void {
    this.chosen = name;
    for (const [one, panel] of this.panels) {
      panel.hidden = one !== name;
      this.buttons.get(one)!.setAttribute("aria-selected", String(one === name));
    }
    this.element.classList.toggle("closed", name === "");
    this.changed(name);
  }

  private walk(event: KeyboardEvent): void {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.preventDefault();
    event.stopPropagation();
    const all = [...this.buttons.values()];
    const next = all[all.indexOf(document.activeElement as HTMLButtonElement) + (event.key === "ArrowLeft" ? -1 : 1)];
    next?.focus();
    if (next) this.choose(next.dataset.tab!);
  }
}
