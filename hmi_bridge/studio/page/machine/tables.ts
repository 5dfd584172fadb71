// Values as they are, in the cells of a table: what is visible is read several times a second.

import { html } from "../base/dom";
import { Link, RequestError } from "../base/link";
import { numberOf, valueText } from "../base/scale";

const kPause = 300;     // between two readings [ms]
const kAtOnce = 400;

export interface Reading { t: string; values: { path: string; type: string; unit: string; value: unknown }[]; errors?: { path: string }[] }

function textOf(value: unknown): string { return value === true ? "● TRUE" : value === false ? "○ FALSE" : valueText(value); }

/// Reads what has been given to it, while it is seen.
export class LiveCells {
  private readonly cells = new Map<string, HTMLElement[]>();
  private timer = 0;
  private turn = 0;
  private rejected = new Set<string>();
  values = new Map<string, unknown>();

  constructor(private readonly link: Link, private readonly isSeen: () => boolean, private readonly changed: (path: string, value: unknown, t: number) => void = () => undefined) {}

  clear(): void { this.cells.clear(); this.values.clear(); this.rejected.clear(); ++this.turn; }

  cell(path: string): HTMLElement {
    // What does not change is told once: a cell that is made later begins with it.
    const element = html("output", { class: "value", "data-live": path }, this.values.has(path) ? textOf(this.values.get(path)) : "–");
    if (this.values.has(path)) element.dataset.value = String(this.values.get(path));
    this.cells.set(path, [...(this.cells.get(path) ?? []), element]);
    return element;
  }

  start(): void { clearTimeout(this.timer); void this.look(++this.turn); }

  private async look(turn: number): Promise<void> {
    if (turn !== this.turn || !this.isSeen()) return;
    const paths = [...this.cells].filter(([path, elements]) => !this.rejected.has(path) && elements.some((one) => one.offsetParent)).map(([path]) => path).slice(0, kAtOnce);
    if (paths.length) await this.read(paths);
    if (turn === this.turn) this.timer = window.setTimeout(() => void this.look(turn), kPause);
  }

  private async read(paths: string[]): Promise<void> {
    try {
      const read: Reading = await this.link.post("api/read", { paths, partial: true });
      // What is no signal (a text, an axis) is left out from then on.
      for (const one of read.errors ?? []) this.rejected.add(one.path);
      for (const { path, value } of read.values) this.set(path, value, Number(read.t));
    } catch (error) {
      if (error instanceof RequestError && error.status === 422) for (const one of error.errors) if (one.path) this.rejected.add(one.path);
    }
  }

  private set(path: string, value: unknown, t: number): void {
    const before = this.values.get(path);
    if (before === value) return;
    this.values.set(path, value);
    const text = textOf(value);
    for (const element of this.cells.get(path) ?? []) {
      element.textContent = text;
      element.dataset.value = String(value);
    }
    this.changed(path, value, t);
  }
}

/// A field that writes a value after it has been checked by the server. @param write throws RequestError
export function writer(path: string, type: string, write: (path: string, value: unknown) => Promise<void>): HTMLElement {
  const told = html("span", { class: "told", role: "status" });
  const send = async (value: unknown): Promise<void> => {
    told.textContent = "…";
    try {
      await write(path, value);
      told.textContent = "✓ written";
    } catch (error) {
      told.textContent = "✕ " + (error as Error).message;
    }
    told.title = told.textContent;
  };
  if (type === "BOOL") return html("span", { class: "writer" }, ...[true, false].map((value) => html("button", { type: "button", "aria-label": `Write ${value ? "TRUE" : "FALSE"} to ${path}`, click: () => void send(value) }, value ? "TRUE" : "FALSE")), told);
  const field = html("input", { "aria-label": `New value of ${path}`, spellcheck: "false", inputmode: type.startsWith("STRING") ? "text" : "decimal" });
  const go = (): void => {
    const text = field.value.trim();
    if (text === "") return;
    void send(valueOf(text, type));
  };
  field.addEventListener("keydown", (event) => { if (event.key === "Enter") go(); });
  return html("span", { class: "writer" }, field, html("button", { type: "button", "aria-label": `Write ${path}`, click: go }, "Write"), told);
}

/// What a text stands for in a request.
export function valueOf(text: string, type: string): unknown {
  if (type.startsWith("STRING") || type.startsWith("WSTRING") || /^(LINT|ULINT|LWORD|TIME)$/.test(type)) return text;
  if (type === "BOOL") return /^(true|1)$/i.test(text);
  const value = numberOf(text);
  return isFinite(value) ? value : text;
}
