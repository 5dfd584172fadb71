// An object at a glance: every bit of its words with its meaning and since when, and how it moves.

import { html } from "./dom";
import { seconds, short } from "./scale";

interface Found { path: string; type: string; unit: string; text: string }
interface Reading { t: string; values: { path: string; type: string; unit: string; value: unknown }[] }

export interface DiagnosisServer {
  search(text: string, limit: number): Promise<{ signals: Found[] }>;
  read(paths: string[]): Promise<Reading>;
  /// brings a signal into the scope
  show(path: string): void;
}

/// Words of the data block, and what is said of the motion; of what an object has.
const kWords: [string, string][] = [
  ["StatusWord", "Status"], ["StatusWord2", "Status, further"], ["ErrorWord", "Errors"], ["WarningWord", "Warnings"],
  ["StatusSynchronizedMotion.StatusWord", "Synchronous motion"], ["StatusMotionIn.StatusWord", "MotionIn"],
];
const kMotion = [
  "Position", "Velocity", "Acceleration", "ActualPosition", "ActualVelocity", "ActualAcceleration", "Override.Velocity", "ActualSpeed", "VelocitySetpoint",
  "OperativeSensor", "StatusPositioning.Distance", "StatusPositioning.TargetPosition", "StatusPositioning.FollowingError", "StatusPositioning.SetpointExecutionTime",
  "DynamicLimits.Velocity", "DynamicLimits.MaxVelocity", "DynamicLimits.MaxAcceleration", "DynamicLimits.MaxDeceleration", "DynamicLimits.MaxJerk",
  "StatusSynchronizedMotion.FunctionState", "StatusSynchronizedMotion.WaitingFunctionState", "StatusSynchronizedMotion.PhaseShift",
  "StatusSynchronizedMotion.ActualMaster", "StatusSynchronizedMotion.MasterOffset", "StatusSynchronizedMotion.SlaveOffset", "ErrorDetail.Number", "ErrorDetail.Reaction",
];
const kPause = 250;  // between two readings [ms]

export class Diagnosis {
  private readonly choice = html("select", { "aria-label": "Object", change: () => void this.choose() });
  private readonly groups = html("div", { class: "groups" });
  readonly element = html("section", { class: "diagnosis", "aria-label": "Axis diagnosis", hidden: true },
    html("p", {}, html("label", {}, "Object ", this.choice)), this.groups);
  private paths: string[] = [];
  private cells = new Map<string, { item: HTMLElement; value: HTMLElement; since: HTMLElement | null; last: unknown }>();
  private timer = 0;
  private chosen = 0;

  constructor(private readonly server: DiagnosisServer) {}

  setObjects(objects: string[]): void {
    this.choice.replaceChildren(...objects.map((name) => html("option", { value: name }, name)));
    if (!this.element.hidden) void this.choose();
  }

  setVisible(isVisible: boolean): void {
    this.element.hidden = !isVisible;
    if (isVisible) void this.choose();
    else clearTimeout(this.timer);
  }

  private async choose(): Promise<void> {
    const name = this.choice.value;
    const turn = ++this.chosen;
    clearTimeout(this.timer);
    if (!name) return;
    const { signals } = await this.server.search(name + ".", 10_000);
    if (turn !== this.chosen) return;
    const own = new Map(signals.filter(({ path }) => path.startsWith(name + ".")).map((signal) => [signal.path, signal]));
    this.cells.clear();
    const sections = kWords.map(([word, title]) => this.bits(title, [...own.values()].filter(({ path }) =>
      new RegExp(`^${word.replace(".", "\\.")}\\.X\\d+$`).test(path.slice(name.length + 1)))));
    const motion = kMotion.map((variable) => own.get(`${name}.${variable}`)).filter((signal): signal is Found => !!signal);
    this.groups.replaceChildren(this.values(motion, name), ...sections.filter((section): section is HTMLElement => !!section));
    this.paths = [...this.cells.keys()].slice(0, 1000);
    void this.look(turn);
  }

  private line(signal: Found, label: string, isBit: boolean): HTMLElement {
    const value = html("output", { class: "value" }, "–");
    const since = isBit ? html("span", { class: "since" }) : null;
    const item = html("li", { "data-path": signal.path }, html("button", { type: "button", title: `${signal.path} into the scope`,
      click: () => this.server.show(signal.path) }, label), value, ...(since ? [since] : [html("span", { class: "unit" }, signal.unit)]));
    this.cells.set(signal.path, { item, value, since, last: undefined });
    return item;
  }

  private bits(title: string, signals: Found[]): HTMLElement | null {
    if (!signals.length) return null;
    return html("section", {}, html("h2", {}, title), html("ul", { class: "bits" }, ...signals.map((signal) =>
      this.line(signal, `${signal.path.slice(signal.path.lastIndexOf(".") + 1)} ${signal.text}`, true))));
  }

  private values(signals: Found[], name: string): HTMLElement {
    return html("section", {}, html("h2", {}, "Motion"), html("ul", { class: "bits" }, ...signals.map((signal) =>
      this.line(signal, signal.path.slice(name.length + 1), false))));
  }

  private async look(turn: number): Promise<void> {
    if (turn !== this.chosen || this.element.hidden) return;
    const read = await this.server.read(this.paths).catch(() => null);
    if (turn !== this.chosen) return;
    if (read) for (const { path, value } of read.values) this.set(path, value, Number(read.t));
    this.timer = window.setTimeout(() => void this.look(turn), kPause);
  }

  private set(path: string, value: unknown, t: number): void {
    const cell = this.cells.get(path);
    if (!cell || cell.last === value) return;
    // When a bit changed before one looked is not known.
    if (cell.since && cell.last !== undefined) cell.since.textContent = `since ${seconds(t, 1e8)} s`;
    cell.last = value;
    cell.item.dataset.value = String(value);
    cell.value.textContent = value === true ? "● TRUE" : value === false ? "○ FALSE" : typeof value === "number" ? short(value, 9) : String(value);
  }
}
