// Programs as they are written, in the order of calls, with what each pin has now.

import { html } from "../base/dom";
import { LiveCells } from "./tables";

export interface Call {
  kind: string; pointer: string; instance?: string; fb?: string; in?: { pin: string; text: string }[]; target?: string; text?: string; then?: Call[]; else?: Call[];
}
export interface Program { name: string; ob: string; cycle?: string; pointer: string; calls: Call[] }

const kOutputs = ["Done", "Busy", "StartSync", "InSync", "InGear", "Error", "ErrorID"];

export interface ProgramsNotes { cells: LiveCells; show(path: string): void; pins(instance: string): Promise<string[]> }

export class Programs {
  private readonly find = html("input", { type: "search", placeholder: "Find a name", "aria-label": "Find where a name is used", spellcheck: "false", input: () => this.mark() });
  private readonly found = html("span", { class: "faint", role: "status" });
  private readonly list = html("div", { class: "programs" });
  readonly element = html("section", { "aria-label": "Programs" }, html("p", { class: "row" }, this.find, this.found), this.list);

  constructor(private readonly notes: ProgramsNotes) {}

  set(programs: Program[]): void {
    this.list.replaceChildren(...programs.map((program) => html("section", { class: "program" }, html("h2", {}, program.name, html("span", { class: "unit" }, [program.ob, program.cycle].filter(Boolean).join(", "))),
      html("ol", { class: "calls" }, ...program.calls.map((call) => this.call(call))))));
  }

  private live(path: string): HTMLElement {
    return html("button", { type: "button", class: "pin-value", title: `${path} into the scope`, click: () => this.notes.show(path) }, this.notes.cells.cell(path));
  }

  private call(call: Call): HTMLElement {
    const { text = "" } = call;
    if (call.kind === "if") {
      return html("li", { class: "call", "data-text": text }, html("p", {}, html("b", {}, "if "), html("code", {}, text)), html("ol", {}, ...(call.then ?? []).map((one) => this.call(one))),
        ...(call.else?.length ? [html("p", {}, html("b", {}, "else")), html("ol", {}, ...call.else.map((one) => this.call(one)))] : []));
    }
    if (call.kind !== "fb") {
      const target = call.target ?? "";
      return html("li", { class: "call", "data-text": `${target} ${text}` }, html("p", {}, html("code", {}, `${target} := ${text}`), " ", target ? this.live(target) : ""));
    }
    const instance = call.instance ?? "";
    const rows = (call.in ?? []).map(({ pin, text: wired }) => html("tr", { class: pin === "Execute" || pin === "Enable" ? "edge-pin" : "" }, html("th", { scope: "row" }, pin), html("td", {}, html("code", {}, wired)), html("td", {}, this.live(`${instance}.${pin}`))));
    const outputs = html("p", { class: "outputs" });
    const item = html("li", { class: "call", "data-text": `${instance} ${call.fb ?? ""} ${(call.in ?? []).map((one) => one.text).join(" ")}` }, html("p", {}, html("b", {}, instance), html("span", { class: "unit" }, call.fb ?? "")),
      html("table", { class: "pins" }, html("tbody", {}, ...rows)), outputs);
    void this.notes.pins(instance).then((pins) => outputs.replaceChildren(...kOutputs.filter((pin) => pins.includes(pin)).map((pin) => html("span", { class: "output" }, pin + " ", this.live(`${instance}.${pin}`)))));
    return item;
  }

  private mark(): void {
    const words = this.find.value.trim().toLowerCase();
    let count = 0;
    for (const item of this.list.querySelectorAll<HTMLElement>(".call")) {
      const isFound = words !== "" && (item.dataset.text ?? "").toLowerCase().includes(words);
      item.classList.toggle("found-name", isFound);
      if (isFound && ++count === 1) item.scrollIntoView({ block: "nearest" });
    }
    this.found.textContent = words ? `${count} call${count === 1 ? "" : "s"}` : "";
  }
}
