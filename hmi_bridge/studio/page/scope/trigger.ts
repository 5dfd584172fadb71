// The trigger of this page, which the server judges on every row, whether the page is looked at or not.

import { button, html } from "../base/dom";
import { Message } from "../base/link";
import { numberOf, seconds, short } from "../base/scale";

const kKinds: [string, string][] = [
  ["rising", "rises above"], ["falling", "falls below"], ["above", "is above"], ["below", "is below"], ["change", "changes"],
  ["outside", "is outside"], ["bits", "has these bits"], ["alarm", "an alarm is raised"], ["job", "a job begins"],
];

/// Digits of a whole number, which may be written as 16#FF, 0xFF or 2#101 and exceed 2^53.
function digitsOf(text: string): string {
  try { return BigInt(text.trim().replace(/_/g, "").replace(/^16#/, "0x").replace(/^8#/, "0o").replace(/^2#/, "0b")).toString(); } catch { return text; }
}

export interface Shot { id: string; reason: string; t: number }

export interface TriggerNotes {
  ask(message: Message): Promise<Message>;
  /// the level has been set otherwise
  changed(): void;
}

export class Trigger {
  readonly path = html("input", { "aria-label": "Signal of the trigger", placeholder: "signal", list: "trigger-paths", spellcheck: "false", change: () => this.notes.changed() });
  private readonly paths = html("datalist", { id: "trigger-paths" });
  private readonly kind = html("select", { "aria-label": "Kind of the trigger", change: () => { this.showFields(); this.notes.changed(); } },
    ...kKinds.map(([value, text]) => html("option", { value }, text)));
  readonly level = this.number("Level", "0");
  private readonly upper = this.number("Upper level", "1");
  private readonly hysteresis = this.number("Hysteresis", "0");
  private readonly mask = this.number("Mask", "1");
  private readonly bits = this.number("Value of the bits", "1");
  private readonly andPath = html("input", { "aria-label": "Signal of the second condition", placeholder: "and … (signal)", list: "trigger-paths", spellcheck: "false", change: () => this.showFields() });
  private readonly andKind = html("select", { "aria-label": "Kind of the second condition" }, ...[["above", "is above"], ["below", "is below"]].map(([value, text]) => html("option", { value }, text)));
  private readonly andLevel = this.number("Level of the second condition", "0");
  private readonly before = this.number("Before [ms]", "200");
  private readonly after = this.number("After [ms]", "200");
  private readonly mode = html("select", { "aria-label": "Mode of the trigger", change: () => this.showFields() },
    ...[["single", "once"], ["normal", "again and again"], ["auto", "by itself after a time"]].map(([value, text]) => html("option", { value }, text)));
  private readonly auto = this.number("By itself after [ms]", "1000");
  private readonly state = html("output", { class: "trigger-state", role: "status" }, "not armed");
  readonly element = html("section", { class: "trigger", "aria-label": "Trigger" },
    this.path, this.paths, this.kind, this.labelled("level", this.level), this.labelled("to", this.upper), this.labelled("hysteresis", this.hysteresis),
    this.labelled("mask", this.mask), this.labelled("= value", this.bits),
    this.andPath, html("p", { class: "row" }, this.andKind, this.andLevel),
    html("p", { class: "row" }, this.labelled("before [ms]", this.before), this.labelled("after [ms]", this.after)), this.mode, this.labelled("after [ms]", this.auto),
    html("p", { class: "row" }, button("Arm", "Wait for this", () => void this.tell("arm")), button("Disarm", "Wait no more", () => void this.tell("disarm")),
      button("Force", "Catch what is now", () => void this.tell("force"))), this.state);

  constructor(private readonly notes: TriggerNotes) { this.showFields(); }

  private number(label: string, value: string): HTMLInputElement {
    return html("input", { "aria-label": label, inputmode: "decimal", value, change: () => this.notes.changed() });
  }
  private labelled(label: string, field: HTMLInputElement): HTMLLabelElement {
    return html("label", { class: "field" }, html("span", {}, label), field);
  }

  setPaths(paths: string[]): void {
    if (this.paths.childElementCount !== paths.length || [...this.paths.children].some((option, i) => (option as HTMLOptionElement).value !== paths[i]))
      this.paths.replaceChildren(...paths.map((value) => html("option", { value })));
  }

  /// The level as it stands in the diagrams; null: there is none.
  get shown(): { path: string; value: number } | null {
    const value = numberOf(this.level.value);
    return this.path.value && !this.level.parentElement!.hidden && isFinite(value) ? { path: this.path.value.trim(), value } : null;
  }
  setLevel(value: number): void { this.level.value = short(value, 5); this.notes.changed(); }
  setPath(path: string, value: number): void { this.path.value = path; if (isFinite(value)) this.level.value = short(value, 4); this.notes.changed(); this.path.focus(); }

  private showFields(): void {
    const kind = this.kind.value;
    const isEvent = kind === "alarm" || kind === "job";
    const visible: [HTMLElement, boolean][] = [
      [this.level, !isEvent && kind !== "change" && kind !== "bits"], [this.upper, kind === "outside"], [this.hysteresis, kind === "rising" || kind === "falling"],
      [this.mask, kind === "bits"], [this.bits, kind === "bits"], [this.auto, this.mode.value === "auto"],
    ];
    for (const [field, isShown] of visible) field.parentElement!.hidden = !isShown;
    this.path.hidden = this.andPath.hidden = isEvent;
    this.andKind.parentElement!.hidden = isEvent || !this.andPath.value.trim();
  }

  private condition(): Message {
    const ms = (field: HTMLInputElement): number => Math.round(numberOf(field.value) * 1e6);
    const isBits = this.kind.value === "bits";
    const and = this.andPath.hidden || !this.andPath.value.trim() ? {} : { and: { path: this.andPath.value.trim(), kind: this.andKind.value, level: numberOf(this.andLevel.value) } };
    return { type: "trigger", action: "arm", kind: this.kind.value, path: this.path.value.trim(), level: numberOf(this.level.value), upper: numberOf(this.upper.value),
      hysteresis: numberOf(this.hysteresis.value), ...(isBits ? { mask: digitsOf(this.mask.value), value: digitsOf(this.bits.value) } : {}), ...and,
      before: ms(this.before), after: ms(this.after), mode: this.mode.value, ...(this.mode.value === "auto" ? { auto: ms(this.auto) } : {}) };
  }

  private async tell(action: string): Promise<void> {
    try {
      const answer = await this.notes.ask(action === "arm" ? this.condition() : { type: "trigger", action });
      this.state.textContent = answer.state;
      this.state.classList.remove("lost");
    } catch (error) {
      this.state.textContent = (error as Error).message;
      this.state.classList.add("lost");
    }
  }

  caught(shot: Shot): void { this.state.textContent = `${this.mode.value === "single" ? "caught" : "armed; caught"} at ${seconds(shot.t, 1e6)} s`; }
}
