// Alarms that stand, with cause and remedy, and what has happened before.

import { button, html, renew } from "../base/dom";
import { seconds } from "../base/scale";
import { Event } from "../scope/bars";

function amount(value: { name: string; value: number; unit: string } | undefined): string {
  return value ? `${value.name} ${value.value} ${value.unit}`.trim() : "";
}

const kSigns: [RegExp, string][] = [[/^alarm$/, "▼"], [/failed/, "!"], [/aborted/, "✕"], [/done/, "✓"], [/started/, "▷"], [/overrun|missed/, "◆"], [/written/, "✎"], [/refused/, "⊘"], [/command/, "☞"]];

/// Overruns that follow each other are told as one, the newest.
function runsOf(events: Event[]): { event: Event; count: number }[] {
  const runs: { event: Event; count: number }[] = [];
  for (const event of events) {
    const last = runs[runs.length - 1];
    if (last && /overrun|missed/.test(event.kind) && last.event.kind === event.kind) runs[runs.length - 1] = { event, count: last.count + 1 };
    else runs.push({ event, count: 1 });
  }
  return runs;
}

export interface AlarmsNotes {
  /// brings a moment into the picture
  show(t: number): void;
  /// null: this page may not
  acknowledge: ((source: string) => void) | null;
}

export class Alarms {
  private readonly pending = html("div", { role: "status", "aria-live": "polite" });
  private readonly past = html("ol", { class: "events" });
  private readonly filter = html("select", { "aria-label": "Which events", change: () => this.draw() },
    ...[["", "all"], ["alarm", "alarms"], ["job", "jobs"], ["command|writ", "commands and writes"], ["overrun|missed", "overruns"]].map(([value, text]) => html("option", { value }, text)));
  private events: Event[] = [];
  private standing: Event[] = [];
  readonly element = html("aside", { class: "alarms", "aria-label": "Alarms and events" },
    html("h2", {}, "Alarms"), this.pending, html("h2", { class: "row" }, "Events ", this.filter), this.past);

  constructor(readonly notes: AlarmsNotes) {}

  get count(): number { return this.standing.length; }

  set(pending: Event[], events: Event[]): void {
    this.standing = pending;
    this.events = events;
    this.draw();
  }

  draw(): void {
    const { acknowledge } = this.notes;
    renew(this.pending, [...(this.standing.length ? this.standing.map((alarm) => this.card(alarm)) : [html("p", { class: "calm" }, "✓ No alarm is pending.")]),
      ...(acknowledge && this.standing.length > 1 ? [button("Acknowledge all", "Reset each axis that takes commands", () => { for (const { source } of this.standing) acknowledge(source); })] : [])]);
    const wanted = new RegExp(this.filter.value);
    renew(this.past, runsOf(this.events.filter(({ kind }) => wanted.test(kind))).slice(-100).reverse().map(({ event, count }) => html("li", { "data-kind": event.kind },
      button(seconds(event.t, 1e6) + " s", "Show this moment", () => this.notes.show(event.t)),
      html("span", {}, html("span", { class: "sign", "aria-hidden": "true" }, kSigns.find(([kind]) => kind.test(event.kind))?.[1] ?? "·"),
        `${event.source || "the run"}: ${event.kind}${event.number ? " " + event.number : ""}${event.text ? ", " + event.text : ""}${event.address ? ` (${event.address})` : ""}${count > 1 ? ` × ${count}` : ""}`))));
  }

  private card(alarm: Event): HTMLElement {
    const rows: [string, string][] = [
      ["Reaction", alarm.reaction ?? ""], ["Measured", amount(alarm.value)], ["Permitted", amount(alarm.limit)],
      ["Concerns", alarm.address ?? ""], ["Cause", alarm.cause ?? ""], ["Remedy", alarm.remedy ?? ""],
    ];
    const { acknowledge } = this.notes;
    return html("article", { class: "alarm" },
      html("h3", {}, `${alarm.source}: alarm ${alarm.number}`),
      html("p", {}, alarm.text),
      html("dl", {}, ...rows.filter(([, text]) => text).flatMap(([name, text]) => [html("dt", {}, name), html("dd", {}, text)])),
      html("p", { class: "row" }, button("Show at " + seconds(alarm.t, 1e6) + " s", "Show the moment of this alarm", () => this.notes.show(alarm.t)),
        ...(acknowledge ? [button("Acknowledge", `Reset ${alarm.source}`, () => acknowledge(alarm.source))] : [])));
  }
}
