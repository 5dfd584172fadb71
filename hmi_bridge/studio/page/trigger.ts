// The trigger of this page, which the server judges on every row, and what has been caught.

import { button, html } from "./dom";
import { Message } from "./link";
import { seconds } from "./scale";

const kKinds: [string, string][] = [
  ["rising", "rises above"], ["falling", "falls below"], ["above", "is above"], ["below", "is below"], ["change", "changes"],
  ["outside", "is outside"], ["alarm", "an alarm is raised"], ["job", "a job begins"],
];

export interface Shot { id: string; reason: string; t: number }

export interface TriggerServer {
  ask(message: Message): Promise<Message>;
  show(shot: Shot): void;
}

export class Trigger {
  readonly path = html("input", { "aria-label": "Signal of the trigger", placeholder: "signal", list: "trigger-paths", spellcheck: "false" });
  private readonly paths = html("datalist", { id: "trigger-paths" });
  private readonly kind = html("select", { "aria-label": "Kind of the trigger", change: () => this.showFields() },
    ...kKinds.map(([value, text]) => html("option", { value }, text)));
  private readonly level = this.number("Level", "0");
  private readonly upper = this.number("Upper level", "1");
  private readonly hysteresis = this.number("Hysteresis", "0");
  private readonly before = this.number("Before [ms]", "200");
  private readonly after = this.number("After [ms]", "200");
  private readonly repeated = html("input", { type: "checkbox", "aria-label": "Again and again" });
  private readonly state = html("output", { class: "trigger-state", role: "status" }, "not armed");
  private readonly shots = html("ul", { class: "shots", "aria-label": "Shots" });
  readonly element = html("section", { class: "trigger", "aria-label": "Trigger" }, html("h2", {}, "Trigger"),
    this.path, this.paths, this.kind, this.labelled("level", this.level), this.labelled("to", this.upper), this.labelled("hysteresis", this.hysteresis),
    this.labelled("before [ms]", this.before), this.labelled("after [ms]", this.after), html("label", {}, this.repeated, " again and again"),
    html("p", { class: "row" }, button("Arm", "Wait for this", () => void this.tell("arm")), button("Disarm", "Wait no more", () => void this.tell("disarm")),
      button("Force", "Catch what is now", () => void this.tell("force"))), this.state, this.shots);

  constructor(private readonly server: TriggerServer) { this.showFields(); }

  private number(label: string, value: string): HTMLInputElement {
    return html("input", { "aria-label": label, inputmode: "decimal", value });
  }
  private labelled(label: string, field: HTMLInputElement): HTMLLabelElement {
    return html("label", { class: "field" }, html("span", {}, label), field);
  }

  setPaths(paths: string[]): void { this.paths.replaceChildren(...paths.map((value) => html("option", { value }))); }

  private showFields(): void {
    const kind = this.kind.value;
    const isEvent = kind === "alarm" || kind === "job";
    const visible: [HTMLInputElement, boolean][] = [
      [this.level, !isEvent && kind !== "change"], [this.upper, kind === "outside"], [this.hysteresis, kind === "rising" || kind === "falling"],
    ];
    for (const [field, isShown] of visible) field.parentElement!.hidden = !isShown;
    this.path.hidden = isEvent;
  }

  private async tell(action: string): Promise<void> {
    const value = (field: HTMLInputElement): number => Number(field.value.trim().replace(",", "."));
    const message: Message = { type: "trigger", action };
    if (action === "arm")
      Object.assign(message, { kind: this.kind.value, path: this.path.value.trim(), level: value(this.level), upper: value(this.upper),
        hysteresis: value(this.hysteresis), before: Math.round(value(this.before) * 1e6), after: Math.round(value(this.after) * 1e6),
        mode: this.repeated.checked ? "normal" : "single" });
    try {
      const answer = await this.server.ask(message);
      this.state.textContent = answer.state;
      this.state.classList.remove("lost");
    } catch (error) {
      this.state.textContent = (error as Error).message;
      this.state.classList.add("lost");
    }
  }

  caught(shot: Shot): void {
    if (!this.repeated.checked) this.state.textContent = "caught";
    this.add(shot);
  }

  set(shots: Shot[]): void {
    this.shots.replaceChildren();
    for (const shot of shots) this.add(shot);
  }

  private add(shot: Shot): void {
    this.shots.prepend(html("li", {}, html("button", { type: "button", "data-shot": shot.id, click: () => this.server.show(shot) },
      `${seconds(shot.t, 1e6)} s ${shot.reason}`)));
    while (this.shots.childElementCount > 50) this.shots.lastElementChild?.remove();
  }
}
