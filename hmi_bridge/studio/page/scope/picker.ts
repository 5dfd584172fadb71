// The search for signals: by words, as one types; and all that there is as a tree. A click puts one into the chosen diagram.

import { html } from "../base/dom";
import { dragSignal } from "./gestures";

export interface Found { path: string; type: string; unit: string; text: string; writable?: boolean; why_not_writable?: string }

export interface PickerNotes {
  search(text: string, limit: number): Promise<{ signals: Found[]; found?: number }>;
  /// takes a signal into a diagram, a new one if `isNew`
  choose(path: string, isNew: boolean): void;
  drop(path: string, target: Element | null): void;
}

interface Branch { name: string; path: string; leaf: Found | null; children: Map<string, Branch> }

/// Paths by their parts, as a tree.
export function treeOf(signals: Found[]): Branch {
  const root: Branch = { name: "", path: "", leaf: null, children: new Map() };
  for (const signal of signals) {
    let branch = root;
    for (const name of signal.path.split(/\.(?![^[]*\])/)) {
      let next = branch.children.get(name);
      if (!next) branch.children.set(name, next = { name, path: branch.path ? `${branch.path}.${name}` : name, leaf: null, children: new Map() });
      branch = next;
    }
    branch.leaf = signal;
  }
  return root;
}

export class Picker {
  readonly input = html("input", { type: "search", placeholder: "Search, or =expression (/)", "aria-label": "Search signals",
    autocomplete: "off", spellcheck: "false" });
  private readonly list = html("ul", { class: "found", "aria-label": "Signals found" });
  private readonly tree = html("div", { class: "tree", "aria-label": "All signals" });
  private readonly count = html("p", { class: "faint", role: "status" });
  readonly element = html("section", { class: "picker", "aria-label": "Signals" }, this.input, this.count, this.list, this.tree);
  private asked = 0;

  constructor(private readonly notes: PickerNotes) {
    this.input.addEventListener("input", () => void this.look());
    this.input.addEventListener("keydown", (event) => {
      const first = this.list.querySelector("button");
      if (event.key === "Enter" && this.input.value.trim().startsWith("=")) notes.choose(this.input.value.trim(), event.shiftKey);
      else if (event.key === "Enter" && first) notes.choose(first.dataset.path!, event.shiftKey);
      if (event.key === "ArrowDown") this.element.querySelector<HTMLElement>(".found button, .tree summary")?.focus();
      if (event.key === "Escape") this.input.blur();
    });
    this.element.addEventListener("keydown", (event) => this.walk(event));
  }

  /// Builds the tree anew: tags and objects at first, what they have when they are opened.
  setTree(names: { name: string; kind: string; text: string }[]): void {
    const groups = new Map<string, HTMLElement[]>();
    for (const one of names) groups.set(one.kind, [...(groups.get(one.kind) ?? []), one.kind === "Tags" ? this.leaf(one.name, { path: one.name, type: "", unit: "", text: one.text }) : this.lazy(one.name, one.text)]);
    this.tree.replaceChildren(...[...groups].map(([kind, items]) => html("details", {}, html("summary", {}, kind, html("span", { class: "unit" }, String(items.length))), html("ul", {}, ...items))));
  }

  private lazy(name: string, text: string): HTMLElement {
    const list = html("ul");
    const details = html("details", {}, html("summary", {}, name, html("span", { class: "unit" }, text)), list);
    details.addEventListener("toggle", () => {
      if (!details.open || list.childElementCount) return;
      void this.notes.search(name + ".", 10_000).then(({ signals }) => {
        const own = treeOf(signals.filter(({ path }) => path.startsWith(name + "."))).children.get(name);
        if (own) list.replaceChildren(...this.branches(own));
      });
    });
    return html("li", {}, details);
  }

  private branches(branch: Branch): HTMLElement[] {
    return [...branch.children.values()].flatMap((child) => [
      ...(child.leaf ? [this.leaf(child.name, child.leaf)] : []),
      ...(child.children.size ? [this.folder(child)] : [])]);
  }

  private folder(branch: Branch): HTMLElement {
    const list = html("ul");
    const details = html("details", {}, html("summary", {}, branch.name, html("span", { class: "unit" }, branch.leaf ? "bits" : "")), list);
    details.addEventListener("toggle", () => { if (details.open && !list.childElementCount) list.replaceChildren(...this.branches(branch)); });
    return html("li", {}, details);
  }

  private leaf(name: string, signal: Found): HTMLElement {
    const one = html("button", { type: "button", "data-path": signal.path, title: signal.text || signal.path,
      click: ((event: MouseEvent) => this.notes.choose(signal.path, event.shiftKey)) as EventListener },
      html("span", { class: "path" }, name), html("span", { class: "unit" }, [signal.type, signal.unit].filter(Boolean).join(" · ")),
      html("span", { class: "about" }, signal.text));
    one.addEventListener("pointerdown", (event) => dragSignal(signal.path, event, (target) => this.notes.drop(signal.path, target)));
    return html("li", {}, one);
  }

  async look(): Promise<void> {
    const turn = ++this.asked;
    const text = this.input.value.trim();
    const isExpression = text.startsWith("=");
    this.tree.hidden = text !== "";
    this.list.hidden = text === "";
    if (!text || isExpression) {
      this.list.replaceChildren();
      this.count.textContent = isExpression ? "Enter draws this expression, such as =Knife.Position - Knife.ActualPosition, =derivative(…), =integral(…), =mean(…, 100ms)" : "";
      return;
    }
    const { signals, found } = await this.notes.search(text, 60);
    if (turn !== this.asked) return;  // one has typed on
    this.count.textContent = signals.length ? (found && found > signals.length ? `the first ${signals.length} of ${found}` : "") : "nothing has all of these words";
    this.list.replaceChildren(...signals.map((signal) => this.leaf(signal.path, signal)));
  }

  private walk(event: KeyboardEvent): void {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp" || event.target === this.input) return;
    event.preventDefault();
    event.stopPropagation();
    const all = [...this.element.querySelectorAll<HTMLElement>(".found button, .tree summary, .tree button")].filter((one) => one.offsetParent);
    const next = all.indexOf(document.activeElement as HTMLElement) + (event.key === "ArrowDown" ? 1 : -1);
    if (next < 0) this.input.focus();
    else all[next]?.focus();
  }
}
