// The project: how its objects hang together, its programs, tags and data blocks with their values, what `check` says, how the run is.

import { button, html } from "../base/dom";
import { Link, RequestError } from "../base/link";
import { valueText } from "../base/scale";
import { Tabs } from "../base/tabs";
import { Cams } from "./cams";
import { Coupling, Couplings } from "./couplings";
import { Programs } from "./programs";
import { LiveCells, valueOf, writer } from "./tables";

export interface ProjectNotes {
  link: Link;
  show(path: string): void;
  trigger(path: string): void;
  canWrite(): boolean;
  whyNotWrite(): string;
}

interface TagRow { name: string; type: string; unit?: string; comment?: string; retain?: boolean; init?: unknown; writable?: boolean; why_not_writable?: string; modbus?: { table: string; address: number; type: string }[]; lower?: number; upper?: number }
interface VariableRow { choices?: { value: number; text: string }[]; count?: number; pointer?: string; project?: unknown; path: string; type: string; unit?: string; text?: string; effect?: string; default?: unknown; start?: unknown; different?: boolean; minimum?: unknown; maximum?: unknown; writable?: boolean; why_not_writable?: string; class?: string; wired?: string }

const kRows = 300;  // of a table at once
const isMissing = (error: unknown): boolean => error instanceof RequestError && error.status === 404;
const heads = (...names: string[]): HTMLElement => html("thead", {}, html("tr", {}, ...names.map((name) => html("th", { scope: "col" }, name))));

export class Project {
  private readonly couplings = new Couplings();
  private readonly cells: LiveCells;
  private readonly programs: Programs;
  private readonly tagFilter = html("input", { type: "search", placeholder: "Filter", "aria-label": "Filter tags", spellcheck: "false", input: () => this.showTags() });
  private readonly tagBody = html("tbody");
  private readonly batch = html("p", { class: "row" });
  private readonly tags = html("section", { "aria-label": "Tags" });
  private readonly choice = html("select", { "aria-label": "Object or instance", change: () => void this.showData() });
  private readonly dataFilter = html("input", { type: "search", placeholder: "Filter", "aria-label": "Filter variables", spellcheck: "false", input: () => this.filterData() });
  private readonly onlyDifferent = html("input", { type: "checkbox", "aria-label": "Only what differs from its default", change: () => this.filterData() });
  private readonly dataBody = html("tbody");
  private readonly dataNote = html("p", { class: "faint", role: "status" });
  private readonly data: HTMLElement;
  private readonly checks = html("section", { "aria-label": "Checks" });
  private readonly cams: Cams;
  private readonly health = html("section", { "aria-label": "Health" });
  private readonly tabs: Tabs;
  readonly element: HTMLElement;
  private tagRows: TagRow[] = [];
  private pending = new Map<string, unknown>();
  private variables: VariableRow[] = [];
  private objects: { name: string; type?: string }[] = [];
  private timer = 0;
  private turn = 0;  // of what is loaded: an answer to what was asked before does not replace what one types into

  constructor(private readonly notes: ProjectNotes) {
    this.cells = new LiveCells(notes.link, () => !this.element.hidden, (path, value) => this.couplings.told(path, value));
    this.programs = new Programs({ cells: this.cells, show: notes.show, pins: (instance) => this.pinsOf(instance) });
    this.cams = new Cams(notes.link);
    this.tags.append(html("p", { class: "row" }, this.tagFilter, this.batch), html("table", { class: "wide" }, html("caption", { class: "unseen" }, "Tags"), heads("tag", "value", "new value", "type", "start", "Modbus", "retain", "comment", ""), this.tagBody));
    this.data = html("section", { "aria-label": "Data blocks" }, html("p", { class: "row" }, html("label", {}, "of ", this.choice), this.dataFilter, html("label", {}, this.onlyDifferent, " only what differs"), this.dataNote),
      html("table", { class: "wide" }, html("caption", { class: "unseen" }, "Variables"), heads("variable", "value", "new value", "unit", "in the project", "default", "range", "effect", "meaning", ""), this.dataBody));
    this.tabs = new Tabs("Project", [["Overview", this.couplings.element], ["Programs", this.programs.element], ["Tags", this.tags], ["Data", this.data], ["Cams", this.cams.element], ["Checks", this.checks], ["Health", this.health]], (name) => void this.open(name));
    this.element = html("section", { class: "project-screen", "aria-label": "Project", hidden: true }, this.tabs.element);
  }

  set(project: any): void {
    this.objects = project.objects ?? [];
    this.tagRows = (project.tags ?? []).map((tag: any): TagRow => ({ ...tag, name: tag.name, type: tag.type ?? "" }));
    const group = (label: string, names: { name: string }[]): HTMLElement => html("optgroup", { label }, ...names.map(({ name }) => html("option", { value: name }, name)));
    this.choice.replaceChildren(group("Objects", this.objects), group("Instances", project.instances ?? []));
    if (!this.element.hidden) void this.open(this.tabs.chosen);
  }

  setVisible(isVisible: boolean): void {
    this.element.hidden = !isVisible;
    clearTimeout(this.timer);
    if (!isVisible) return;
    if (this.tabs.chosen) void this.open(this.tabs.chosen);
    else this.tabs.choose(this.objects.length ? "Overview" : "Cams");
  }

  showObject(name: string): void { this.choice.value = name; this.tabs.choose("Data"); }

  private async open(name: string): Promise<void> {
    clearTimeout(this.timer);
    if (!this.element || this.element.hidden) return;
    this.cells.clear();
    const screens: Record<string, () => Promise<void>> = { Overview: () => this.showOverview(), Programs: () => this.showPrograms(), Tags: () => this.loadTags(), Data: () => this.showData(), Cams: () => this.cams.load(), Checks: () => this.showChecks(), Health: () => this.showHealth() };
    await screens[name]?.().catch((error) => { this.dataNote.textContent = error.message; });
    this.cells.start();
  }

  private async json(path: string): Promise<any> { return (await this.notes.link.optional(path)).json(); }

  private async showOverview(): Promise<void> {
    const project = await this.notes.link.json("api/project");
    const couplings: Coupling[] = project.couplings ?? [];
    this.couplings.set(project.objects, couplings, this.cells, project.couplings !== undefined);
  }

  private async pinsOf(instance: string): Promise<string[]> {
    const { signals } = await this.notes.link.json(`api/signals?limit=200&q=${encodeURIComponent(instance + ".")}`).catch(() => ({ signals: [] }));
    this.cells.start();
    return signals.filter(({ path }: any) => path.startsWith(instance + ".")).map(({ path }: any) => path.slice(instance.length + 1));
  }

  private async showPrograms(): Promise<void> {
    try {
      this.programs.set((await this.json("api/programs")).programs);
    } catch (error) {
      if (!isMissing(error)) throw error;
      this.programs.element.replaceChildren(html("p", { class: "faint" }, "This studio does not tell programs."));
    }
  }

  // Tags.

  private async loadTags(): Promise<void> {
    const turn = ++this.turn;
    this.tagBody.replaceChildren();
    const rows = await this.json("api/tags").then(({ tags }): TagRow[] => tags, (error) => { if (isMissing(error)) return this.tagRows; throw error; });
    if (turn !== this.turn) return;
    this.tagRows = rows.flatMap(elementsOf);
    this.showTags();
  }

  private showTags(): void {
    const words = this.tagFilter.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    const rows = this.tagRows.filter(({ name, comment }) => words.every((word) => `${name} ${comment ?? ""}`.toLowerCase().includes(word)));
    this.tagBody.replaceChildren(...rows.slice(0, kRows).map((tag) => html("tr", { "data-tag": tag.name }, html("th", { scope: "row" }, tag.name), html("td", {}, this.cells.cell(tag.name)),
      html("td", {}, this.tagField(tag)), html("td", {}, tag.type), html("td", {}, valueText(tag.init)), html("td", {}, (tag.modbus ?? []).map(({ table, address, type }) => `${table.replaceAll("_", " ")} ${address} ${type}`).join(", ")), html("td", {}, tag.retain ? "yes" : ""), html("td", { class: "about" }, tag.comment ?? ""), this.tools(tag.name))));
    if (rows.length > kRows) this.tagBody.append(html("tr", {}, html("td", { colspan: 9 }, `${rows.length - kRows} more: filter`)));
    this.showBatch();
    this.cells.start();
  }

  private tools(path: string): HTMLElement {
    return html("td", {}, button("Scope", `${path} into the scope`, () => this.notes.show(path)), button("Trigger", `Trigger on ${path}`, () => this.notes.trigger(path)));
  }

  /// A new value waits until all are written, at one tick.
  private tagField(tag: TagRow): HTMLElement {
    if (!this.notes.canWrite()) return html("span", { class: "faint", title: this.notes.whyNotWrite() }, "–");
    if (tag.writable === false) return html("span", { class: "faint", title: tag.why_not_writable ?? "" }, "not writable");
    const field = html("input", { "aria-label": `New value of ${tag.name}`, spellcheck: "false", value: this.pending.has(tag.name) ? String(this.pending.get(tag.name)) : "", input: () => {
      if (field.value.trim() === "") this.pending.delete(tag.name);
      else this.pending.set(tag.name, valueOf(field.value.trim(), tag.type));
      this.showBatch();
    } });
    field.addEventListener("keydown", (event) => { if (event.key === "Enter") void this.writeAll(); });
    return field;
  }

  private readonly told = html("span", { class: "told", role: "status" });
  private showBatch(): void {
    const size = this.pending.size;
    const write = button(`Write ${size || ""}`.trim(), "Write all new values at one tick (Enter)", () => void this.writeAll());
    write.disabled = size === 0;
    this.batch.replaceChildren(...(this.notes.canWrite() ? [write, this.told] : [html("span", { class: "faint" }, this.notes.whyNotWrite() || "This studio only looks.")]));
  }

  private async writeAll(): Promise<void> {
    if (!this.pending.size) return;
    try {
      const answer = await this.notes.link.post("api/write", { writes: [...this.pending].map(([path, value]) => ({ path, value })) });
      this.pending.clear();
      this.showTags();
      this.told.textContent = `✓ written at tick ${answer.tick}`;
    } catch (error) {
      const { errors, message } = error as RequestError;
      this.told.textContent = "✕ " + (errors?.length ? errors.map((one) => one.message).join("; ") : message);
    }
  }

  private async write(path: string, value: unknown): Promise<void> { await this.notes.link.post("api/write", { writes: [{ path, value }] }); }

  // Data blocks.

  private async showData(): Promise<void> {
    const name = this.choice.value;
    if (!name) return;
    const turn = ++this.turn;
    this.cells.clear();
    this.dataBody.replaceChildren();
    const variables = await this.variablesOf(name);
    if (turn !== this.turn) return;
    this.variables = variables;
    this.filterData();
  }

  private async variablesOf(name: string): Promise<VariableRow[]> {
    const isObject = this.objects.some((one) => one.name === name);
    try {
      const answer = await this.json(`api/${isObject ? "objects" : "instances"}/${encodeURIComponent(name)}`);
      return answer.variables?.flatMap(configured) ?? answer.pins.map((pin: any): VariableRow => ({ ...pin, effect: pin.class, start: pin.pointer ? pin.text : "", text: pin.pointer ? "" : pin.text }));
    } catch (error) {
      if (!isMissing(error)) throw error;
      const { signals } = await this.notes.link.json(`api/signals?limit=2000&q=${encodeURIComponent(name + ".")}`);
      return signals.filter(({ path }: VariableRow) => path.startsWith(name + ".") && !/\.X\d+$/.test(path));
    }
  }

  private filterData(): void {
    const name = this.choice.value;
    const words = this.dataFilter.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    const rows = this.variables.filter(({ path, text, different }) => words.every((word) => `${path} ${text ?? ""}`.toLowerCase().includes(word)) && (!this.onlyDifferent.checked || different));
    this.cells.clear();
    this.dataBody.replaceChildren(...rows.slice(0, kRows).map((one) => {
      const range = one.minimum !== undefined || one.maximum !== undefined ? `${valueText(one.minimum)} … ${valueText(one.maximum)}` : "";
      const meaning = [one.text ?? "", ...(one.choices ?? []).map(({ value, text }) => `${value}: ${text}`)].filter(Boolean).join("; ");
      const canWrite = this.notes.canWrite() && one.writable === true;
      return html("tr", { class: one.different ? "different" : "", "data-path": one.path }, html("th", { scope: "row" }, ...(one.different ? [html("span", { class: "sign", title: "differs from its default" }, "≠ ")] : []), one.path.slice(name.length + 1)),
        html("td", {}, one.type === "TAG" ? html("span", { class: "faint", title: "It names a tag, in the project" }, "–") : this.cells.cell(one.path)), html("td", {}, canWrite ? writer(one.path, one.type, (path, value) => this.write(path, value)) : html("span", { class: "faint", title: one.why_not_writable ?? this.notes.whyNotWrite() }, "–")),
        html("td", {}, one.unit ?? ""), html("td", {}, one.start === undefined ? "" : valueText(one.start)), html("td", {}, one.default === undefined ? "" : valueText(one.default)), html("td", {}, range), html("td", {}, one.effect ?? ""), html("td", { class: "about" }, meaning), this.tools(one.path));
    }));
    this.dataNote.textContent = `${Math.min(rows.length, kRows)} of ${this.variables.length} variables`;
    this.cells.start();
  }

  // What `check` says, and how the run is.

  private async showChecks(): Promise<void> {
    try {
      const { problems, warnings } = await this.json("api/check");
      const list = (title: string, all: any[]): HTMLElement => html("section", {}, html("h2", {}, `${title}: ${all.length}`), html("ul", { class: "checks" }, ...all.map((one) => html("li", {}, html("code", {}, one.pointer ?? one.place ?? ""), " ", one.text))));
      this.checks.replaceChildren(list("Problems", problems ?? []), list("Warnings", warnings ?? []));
    } catch (error) {
      if (!isMissing(error)) throw error;
      this.checks.replaceChildren(html("p", { class: "faint" }, "This studio does not tell what lockstep check says."));
    }
  }

  private async showHealth(): Promise<void> {
    try {
      const health = await this.json("api/health");
      this.health.replaceChildren(...Object.entries<any>(health).map(([part, values]) => html("section", { class: "health" }, html("h2", {}, part.replaceAll("_", " ")),
        values === null ? html("p", { class: "faint" }, "is not part of this run") : Array.isArray(values) ? html("p", values.length ? { class: "lost" } : {}, values.join("; ") || "none") : typeof values === "object" ? html("dl", { class: "facts" }, ...facts(values)) : html("p", {}, String(values)))));
      this.timer = window.setTimeout(() => { if (this.tabs.chosen === "Health" && !this.element.hidden) void this.showHealth(); }, 1000);
    } catch (error) {
      if (!isMissing(error)) throw error;
      this.health.replaceChildren(html("p", { class: "faint" }, "This studio does not tell more than what stands at the top right."));
    }
  }
}

/// Elements of an array, each as a row; of a long one the first.
function elementsOf(tag: TagRow): TagRow[] {
  const { lower, upper } = tag;
  if (lower === undefined || upper === undefined) return [tag];
  return Array.from({ length: Math.min(upper - lower + 1, 64) }, (_, i) => ({ ...tag, lower: undefined, upper: undefined, name: `${tag.name}[${lower + i}]`, type: tag.type.replace(/^ARRAY.* OF /, "") }));
}

/// A variable with what the project says of it; the elements of an array each as a row.
function configured(one: VariableRow): VariableRow[] {
  const start = one.project ?? one.start;
  const row = { ...one, start, different: one.different ?? (start !== undefined && JSON.stringify(start) !== JSON.stringify(one.default)) };
  if (!one.path.includes("[]")) return [row];
  return Array.from({ length: Math.min(one.count ?? 0, 64) }, (_, i) => ({ ...row, path: one.path.replace("[]", `[${i + 1}]`) }));
}

/// Keys and values, those of inner objects with both keys.
function facts(values: Record<string, any>, before = ""): HTMLElement[] {
  return Object.entries(values).flatMap(([key, value]) => value !== null && typeof value === "object" && !Array.isArray(value) ? facts(value, before + key + " ")
    : [html("dt", {}, (before + key).replace(/_us$/, " [µs]").replaceAll("_", " ")), html("dd", {}, key.endsWith("_us") && typeof value === "number" ? value.toFixed(1) : Array.isArray(value) ? value.map((one) => (typeof one === "object" ? JSON.stringify(one) : String(one))).join(", ") || "–" : valueText(value))]);
}
