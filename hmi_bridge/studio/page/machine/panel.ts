// The control panel: what an axis is told by hand. A motion lasts while a pointer or a key holds it down, and the cycle ends
// it when this page falls silent; the page ends it when the pointer leaves, the window loses the focus or is hidden.

import { button, html } from "../base/dom";
import { Message } from "../base/link";
import { numberOf, short } from "../base/scale";

export interface AxisPanel {
  axis: string; type: string; status_word: string; alarm: number; enables: boolean; enabled_by?: string; has_position: boolean; position: number | string; velocity: number | string; speed: number;
  jog_velocity: number; velocity_unit: string; position_unit?: string; run: string; beat: number; held_by: string;
}

export interface PanelNotes {
  ask(message: Message): Promise<Message>;
  /// an axis is held or no longer
  held(isHeld: boolean): void;
}

const kBeat = 100;  // a motion is said again so often; 300 ms of silence end it [ms]
const kSilence = 300;
const kBits: [number, string][] = [[0, "enabled"], [1, "error"], [2, "restart"], [4, "panel"], [5, "homed"], [6, "done"], [7, "standstill"]];

let sequence = 0;

/// One axis. Commands are told with the run and the beat of what was last heard of it.
class Card {
  private readonly title: HTMLElement;
  private readonly state = html("p", { class: "panel-state", role: "status" });
  private readonly numbers = html("dl", { class: "panel-numbers" });
  private readonly refused = html("p", { class: "lost", role: "alert" });
  private readonly velocity = html("input", { inputmode: "decimal", "aria-label": "Velocity of jogging" });
  private readonly velocityUnit = html("span", { class: "unit" });
  private readonly position = html("input", { inputmode: "decimal", "aria-label": "Position after homing", value: "0" });
  private readonly override_ = html("input", { inputmode: "decimal", "aria-label": "Override [%]" });
  private readonly jogs: Record<"jog forward" | "jog backward", HTMLButtonElement>;
  private readonly enable = button("Enable", "The panel enables the axis", () => void this.tell("enable"));
  private readonly disable = button("Disable", "Enable no longer; always heard", () => void this.tell("disable"));
  private readonly reset = button("Reset", "Acknowledge alarms", () => void this.tell("reset"));
  private readonly homing = html("fieldset", {}, html("legend", {}, "Home"), html("label", {}, "position ", this.position), button("Home", "Set the position (MC_Home)", () => void this.tell("home", numberOf(this.position.value))));
  readonly element: HTMLElement;
  panel: AxisPanel;
  private timer = 0;
  private isDown = false;

  constructor(panel: AxisPanel, private readonly notes: PanelNotes) {
    this.panel = panel;
    this.jogs = { "jog backward": this.jogButton("jog backward", "◀ Jog −"), "jog forward": this.jogButton("jog forward", "Jog + ▶") };
    this.title = html("h2", {}, panel.axis, html("span", { class: "unit" }, panel.type));
    this.element = html("article", { class: "panel", "data-axis": panel.axis, "aria-label": `Panel of ${panel.axis}` }, this.title, this.state, this.numbers,
      html("p", { class: "row" }, this.enable, this.disable, this.reset, button("Stop", "Stop this axis; always heard. It is no emergency stop.", () => void this.tell("stop"))),
      html("fieldset", {}, html("legend", {}, "Jog: hold to move"), html("label", {}, "velocity ", this.velocity, this.velocityUnit), html("p", { class: "row" }, this.jogs["jog backward"], this.jogs["jog forward"])),
      this.homing, html("fieldset", {}, html("legend", {}, "Override"), html("label", {}, "% ", this.override_), button("Set", "Override of the velocity", () => void this.tell("override", numberOf(this.override_.value)))),
      this.refused);
    this.velocity.value = short(panel.jog_velocity / 4, 4);
    this.override_.value = short(panel.speed, 4);
    this.set(panel);
  }

  /// Held by the pointer or by Space: nothing else moves the axis, and no second click.
  private jogButton(action: "jog forward" | "jog backward", label: string): HTMLButtonElement {
    const one = html("button", { type: "button", class: "jog", "data-action": action, title: "Hold to move: the pointer, or Space", "aria-pressed": "false" }, label);
    one.addEventListener("pointerdown", (event) => { if (event.button === 0) { one.focus(); this.hold(action); } });
    for (const end of ["pointerup", "pointerleave", "pointercancel", "blur", "contextmenu", "lostpointercapture"]) one.addEventListener(end, () => this.release());
    one.addEventListener("keydown", (event) => {
      if (event.key !== " " && event.key !== "Escape") return;
      event.preventDefault();
      if (event.key === " " && !event.repeat) this.hold(action);
      if (event.key === "Escape") this.release();
    });
    one.addEventListener("keyup", (event) => { if (event.key === " ") { event.preventDefault(); this.release(); } });
    return one;
  }

  private hold(action: "jog forward" | "jog backward"): void {
    if (this.isDown || document.hidden || !document.hasFocus()) return;
    const velocity = numberOf(this.velocity.value);
    if (!(velocity > 0)) { this.refuse("the velocity has to be a number above 0"); return; }
    this.isDown = true;
    this.refused.textContent = "";
    this.jogs[action].setAttribute("aria-pressed", "true");
    this.notes.held(true);
    let said = performance.now();
    const say = async (): Promise<void> => {
      // The cycle has ended the motion of a page that was silent: it begins again only by a new press.
      if (performance.now() - said > kSilence) { this.release(); return; }
      said = performance.now();
      const answer = await this.tell(action, velocity);
      if (!answer) this.release();
    };
    void say();
    this.timer = window.setInterval(() => void say(), kBeat);
  }

  release(): void {
    if (!this.isDown) return;
    this.isDown = false;
    clearInterval(this.timer);
    for (const one of Object.values(this.jogs)) one.setAttribute("aria-pressed", "false");
    this.notes.held(false);
    void this.tell("stop");
  }

  private refuse(reason: string): void { this.refused.textContent = reason; }

  async tell(action: string, value = 0): Promise<boolean> {
    if (!isFinite(value)) { this.refuse("this is no number"); return false; }
    try {
      const answer = await this.notes.ask({ type: "command", axis: this.panel.axis, action, value, run: this.panel.run, beat: this.panel.beat, sequence: ++sequence });
      if (!answer.accepted) this.refuse(`${action}: ${answer.reason ?? "refused"}`);
      else if (!/^(jog|stop)/.test(action)) this.refuse("");
      return answer.accepted === true;
    } catch (error) {
      this.refuse(`${action}: ${(error as Error).message}`);
      return false;
    }
  }

  set(panel: AxisPanel): void {
    this.panel = panel;
    const word = BigInt(panel.status_word);
    const bits = kBits.filter(([bit]) => (word >> BigInt(bit)) & 1n).map(([, name]) => name);
    const held = panel.held_by === "me" ? "held by this page" : panel.held_by ? "held by another panel" : "";
    const text = [bits.join(", ") || "not enabled", panel.alarm ? `⚠ alarm ${panel.alarm}` : "", held].filter(Boolean).join(" · ");
    if (this.state.textContent !== text) this.state.textContent = text;
    this.element.classList.toggle("held", panel.held_by !== "");
    this.element.classList.toggle("alarmed", panel.alarm !== 0);
    const numbers: [string, string][] = [...(panel.has_position ? [["position", `${Number(panel.position).toFixed(3)} ${panel.position_unit ?? panel.velocity_unit.replace("/s", "")}`] as [string, string]] : []),
      ["velocity", `${Number(panel.velocity).toFixed(2)} ${panel.velocity_unit}`], ["override", `${short(panel.speed, 4)} %`]];
    this.numbers.replaceChildren(...numbers.flatMap(([name, value]) => [html("dt", {}, name), html("dd", { "data-name": name }, value)]));
    const unit = `${panel.velocity_unit}, at most ${short(panel.jog_velocity, 4)}`;
    if (this.velocityUnit.textContent !== unit) this.velocityUnit.textContent = unit;
    this.homing.hidden = !panel.has_position;
    this.enable.disabled = !panel.enables;
    this.enable.title = panel.enables ? "The panel enables the axis" : `${panel.enabled_by ?? "a program"} enables this axis, not the panel`;
  }
}

export class Panel {
  private readonly cards = new Map<string, Card>();
  private readonly list = html("div", { class: "panels" });
  private readonly why = html("p", { class: "why", role: "status" }, "No axis of this run takes commands of a panel.");
  readonly element = html("section", { class: "panel-screen", "aria-label": "Control panel", hidden: true },
    html("h1", {}, "Control panel"), html("p", { class: "faint" }, "A motion lasts as long as you hold its button with the pointer or with Space. It ends when you let go, when the pointer leaves, when the page is hidden or loses the focus, " +
      "and 300 ms after the connection is gone. Stop (Esc) is heard from every screen; it is no emergency stop."), this.why, this.list);
  private last: AxisPanel[] = [];

  constructor(private readonly notes: PanelNotes) {
    window.addEventListener("blur", () => this.release());
    document.addEventListener("visibilitychange", () => { if (document.hidden) this.release(); });
    window.addEventListener("pagehide", () => this.release());
  }

  setRights(canCommand: boolean, why: string): void {
    this.why.textContent = canCommand ? "No axis of this run takes commands of a panel." : why || "This studio only looks.";
    this.why.hidden = canCommand && this.cards.size > 0;
    this.list.inert = !canCommand;
    this.list.classList.toggle("inert", !canCommand);
  }

  set(panels: AxisPanel[]): void {
    this.last = panels;
    for (const panel of panels) {
      const card = this.cards.get(panel.axis);
      if (card) { card.set(panel); continue; }
      const made = new Card(panel, this.notes);
      this.cards.set(panel.axis, made);
      this.list.append(made.element);
    }
    for (const [axis, card] of this.cards) if (!panels.some((one) => one.axis === axis)) { card.release(); card.element.remove(); this.cards.delete(axis); }
    if (panels.length && !this.list.inert) this.why.hidden = true;
  }

  get isThere(): boolean { return this.cards.size > 0; }
  get isControlled(): boolean { return this.last.some(({ held_by }) => held_by !== ""); }
  release(): void { for (const card of this.cards.values()) card.release(); }
  reset(axis: string): void { void this.cards.get(axis)?.tell("reset"); }

  /// All axes, whatever screen one looks at.
  stop(): void { for (const card of this.cards.values()) { card.release(); void card.tell("stop"); } }
}
