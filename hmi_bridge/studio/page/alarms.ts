// Alarms that stand, with cause and remedy, and what has happened before.

import { button, html } from "./dom";
import { Event } from "./bars";
import { seconds } from "./scale";

function amount(value: { name: string; value: number; unit: string } | undefined): string {
  return value ? `${value.name} ${value.value} ${value.unit}`.trim() : "";
}

export class Alarms {
  private readonly pending = html("div", { role: "status", "aria-live": "polite" });
  private readonly past = html("ol", { class: "events" });
  readonly element = html("section", { class: "alarms", "aria-label": "Alarms and events" },
    html("h2", {}, "Alarms"), this.pending, html("h2", {}, "Events"), this.past);

  /// @param show brings a moment into the picture
  constructor(private readonly show: (t: number) => void) {}

  set(pending: Event[], events: Event[]): void {
    this.pending.replaceChildren(...(pending.length ? pending.map((alarm) => this.card(alarm)) : [html("p", {}, "No alarm is pending.")]));
    this.past.replaceChildren(...events.slice(-100).reverse().map((event) => html("li", { "data-kind": event.kind },
      button(seconds(event.t, 1e6) + " s", "Show this moment", () => this.show(event.t)),
      html("span", {}, `${event.source || "the run"}: ${event.kind}${event.number ? " " + event.number : ""}${event.text ? ", " + event.text : ""}`))));
  }

  private card(alarm: Event): HTMLElement {
    const rows: [string, string][] = [
      ["Reaction", alarm.reaction ?? ""], ["Measured", amount(alarm.value)], ["Permitted", amount(alarm.limit)],
      ["Concerns", alarm.address ?? ""], ["Cause", alarm.cause ?? ""], ["Remedy", alarm.remedy ?? ""],
    ];
    return html("article", { class: "alarm" },
      html("h3", {}, `${alarm.source}: alarm ${alarm.number}`),
      html("p", {}, alarm.text),
      html("dl", {}, ...rows.filter(([, text]) => text).flatMap(([name, text]) => [html("dt", {}, name), html("dd", {}, text)])),
      button("Show at " + seconds(alarm.t, 1e6) + " s", "Show the moment of this alarm", () => this.show(alarm.t)));
  }
}
