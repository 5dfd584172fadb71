// An object at a glance: every bit of its words with its meaning and since when, and how it moves.

import { button, html, renew } from "../base/dom";
import { seconds, short } from "../base/scale";
import { Job } from "../scope/bars";

interface Found { path: string; type: string; unit: string; text: string }
interface Reading { t: string; values: { path: string; type: string; unit: string; value: unknown }[] }

interface Cell { item: HTMLElement; value: HTMLElement; since: HTMLElement | null; last: unknown }

export interface DiagnosisServer {
  search(text: string, limit: number): Promise<{ signals: Found[] }>;
  read(paths: string[]): Promise<Reading>;
  /// as `lockstep describe WORDS --json`
  describe(words: string): Promise<any>;
  /// brings a signal into the scope
  show(path: string): void;
  /// opens the data block of an object
  configure(name: string): void;
}

const bitsOf = (word: string, ...bits: number[]): string[] => bits.map((bit) => `${word}.X${bit}`);

/// Status and error bits in their groups and order (11.1.1); of what an object has. `*` stands for each sensor that there is.
const kGroups: [string, string[]][] = [
  ["Axis", [...bitsOf("StatusWord", 25, 0, 28, 5, 1, 2, 4), "StatusDrive.InOperation", "StatusSensor[*].State", "OperativeSensor", "StatusSensor[*].Adjusted", "StatusWord.X3"]],
  ["Limit switches", bitsOf("StatusWord", 15, 16, 17, 18)],
  ["Motion", [...bitsOf("StatusWord", 6, 11, 9, 10, 8, 12, 7, 13, 14, 27), "StatusWord2.X0", "StatusWord.X23", "StatusWord2.X6", "StatusWord2.X7"]],
  ["Synchronism", ["StatusWord.X21", "StatusWord.X22", "StatusWord2.X1", "StatusSynchronizedMotion.FunctionState", "StatusSynchronizedMotion.WaitingFunctionState",
    "StatusSynchronizedMotion.StatusWord.X4", "StatusWord.X24", ...bitsOf("StatusWord2", 3, 4, 5)]],
  ["Errors", [...bitsOf("ErrorWord", 0, 1, 2, 4), "StatusSensor[*].Error", ...bitsOf("ErrorWord", 7, 13, 3, 10, 12, 6, 11, 8, 9, 15, 14)]],
  ["Warnings", bitsOf("WarningWord", 1, 3, 6, 14)],
];
/// Whatever else of these words is declared stands behind the groups.
const kWords: [string, string][] = [
  ["StatusWord", "further of StatusWord"], ["StatusWord2", "further of StatusWord2"], ["ErrorWord", "further of ErrorWord"], ["WarningWord", "further of WarningWord"],
  ["StatusSynchronizedMotion.StatusWord", "further of synchronous motion"], ["StatusMotionIn.StatusWord", "MotionIn"], ["StatusKinematicsMotion", "kinematics"],
];
const kMotion = [
  "Position", "Velocity", "Acceleration", "ActualPosition", "ActualVelocity", "ActualAcceleration", "Override.Velocity", "ActualSpeed", "VelocitySetpoint",
  "OperativeSensor", "StatusPositioning.Distance", "StatusPositioning.TargetPosition", "StatusPositioning.FollowingError", "StatusPositioning.SetpointExecutionTime",
  "DynamicLimits.Velocity", "DynamicLimits.MaxVelocity", "DynamicLimits.MaxAcceleration", "DynamicLimits.MaxDeceleration", "DynamicLimits.MaxJerk",
  "StatusSynchronizedMotion.FunctionState", "StatusSynchronizedMotion.WaitingFunctionState", "StatusSynchronizedMotion.PhaseShift",
  "StatusSynchronizedMotion.ActualMaster", "StatusSynchronizedMotion.MasterOffset", "StatusSynchronizedMotion.SlaveOffset", "ErrorDetail.Number", "ErrorDetail.Reaction",
];
/// What the words of a telegram of drive and encoders would tell (11.1.3), and which variable tells it here.
const kTelegram: [string, string][] = [
  ["ZSW1, operation enabled", "StatusDrive.InOperation"], ["ZSW1, fault", "StatusDrive.Error"], ["NSOLL", "VelocitySetpoint"], ["NIST", "ActualVelocity"],
  ["Gx_ZSW, error", "StatusSensor[*].Error"], ["Gx_XIST1", "StatusSensor[*].Position"],
];
const kNoTelegram = "There is none: drive and encoders are models that exchange values with the controller, without words of PROFIdrive. What those would tell:";
/// A variable by what tells it from the others of its group.
const shortened = (path: string): string => path.slice(path.indexOf(".") + 1).replace("StatusSynchronizedMotion", "…").replace("StatusMotionIn", "…");
const kPause = 250;  // between two readings [ms]

export class Diagnosis {
  private readonly choice = html("select", { "aria-label": "Object", change: () => void this.choose() });
  private readonly groups = html("div", { class: "groups" });
  private readonly jobRows = html("tbody");
  private readonly noJobs = html("p", { class: "faint" }, "No job has moved it yet.");
  private readonly jobTable = html("table", {}, html("caption", { class: "unseen" }, "Jobs of the object"), html("thead", {}, html("tr", {}, ...["instance", "block", "since", "state", ""].map((head) => html("th", { scope: "col" }, head)))), this.jobRows);
  private readonly jobs = html("section", { class: "jobs", "aria-label": "Jobs of the object" }, html("h2", {}, "Jobs"), this.noJobs, this.jobTable);
  private readonly rules = html("section", { class: "rules", "aria-label": "Override rules", "aria-live": "polite" });
  readonly element = html("section", { class: "diagnosis", "aria-label": "Axis diagnosis", hidden: true },
    html("p", { class: "row" }, html("label", {}, "Object ", this.choice), button("Data block", "Its whole data block, with project and default values", () => this.server.configure(this.choice.value))), this.jobs, this.rules, this.groups);
  private all: Job[] = [];
  private paths: string[] = [];
  private cells = new Map<string, Cell[]>();  // a signal may stand in two groups
  private timer = 0;
  private chosen = 0;

  constructor(private readonly server: DiagnosisServer) {}

  setObjects(objects: string[]): void {
    this.choice.replaceChildren(...objects.map((name) => html("option", { value: name }, name)));
    if (!this.element.hidden) void this.choose();
  }

  /// Which jobs move the object, wait, or have been overridden, the newest first.
  setJobs(jobs: Job[]): void {
    this.all = jobs;
    if (!this.element.hidden) this.showJobs();
  }

  private showJobs(): void {
    const own = this.all.filter(({ object }) => object === this.choice.value);
    const running = own.filter(({ end }) => end === Infinity);
    const past = own.filter(({ end }) => end !== Infinity).slice(-8).reverse();
    const row = (job: Job): HTMLElement => html("tr", { "data-instance": job.instance }, html("th", { scope: "row" }, job.instance), html("td", {}, button(job.type, `What ${job.type} overrides, and what overrides it`, () => void this.showRules(job.type, running))),
      html("td", {}, seconds(job.begin, 1e6) + " s"), html("td", {}, job.end === Infinity ? "▶ goes on" : `${{ done: "✓ ", failed: "! ", aborted: "✕ " }[job.ended.replace("job ", "")] ?? ""}${job.ended.replace("job ", "").replace("started", "begun anew")} at ${seconds(job.end, 1e6)} s`), html("td", {}, job.text || this.overriddenBy(job, own)));
    renew(this.jobRows, [...running.map(row), ...past.map(row)]);
    this.noJobs.hidden = own.length > 0;
    this.jobTable.hidden = own.length === 0;
  }

  /// A job that was aborted when another of the same object began.
  private overriddenBy(job: Job, own: Job[]): string {
    if (!/aborted/.test(job.ended)) return "";
    const next = own.filter((other) => other !== job && Math.abs(other.begin - job.end) <= 1e7).sort((a, b) => Math.abs(a.begin - job.end) - Math.abs(b.begin - job.end))[0];
    return next ? `overridden by ${next.instance} (${next.type}) ` : "";
  }

  private async showRules(type: string, running: Job[]): Promise<void> {
    try {
      const told = await this.server.describe(`override/${type}`);
      const rows: any[] = (told.new_jobs ?? []).flatMap((one: any) => one.running_jobs.map((row: any) => ({ ...row, as: one.which })));
      const isRunning = (row: any): boolean => row.running.some((name: string) => running.some((job) => job.type === name));
      const cells = (row: any): string[] => [row.as, row.running.join(", "), row.which, row.effect, row.effect_without_position_control];
      this.rules.replaceChildren(html("h2", {}, `What ${type} does to a job that runs`), html("table", {}, html("thead", {}, html("tr", {}, ...["of", "running job", "of it", "effect", "without position control"].map((head) => html("th", { scope: "col" }, head)))),
        html("tbody", {}, ...rows.map((row) => html("tr", { class: isRunning(row) ? "present" : "" }, ...cells(row).map((cell, i) => html("td", {}, i === 1 && isRunning(row) ? "▶ runs: " : "", cell)))))), button("Close", "Close", () => this.rules.replaceChildren()));
    } catch (error) {
      this.rules.replaceChildren(html("p", { class: "faint" }, `Override rules: ${(error as Error).message}`));
    }
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
    this.rules.replaceChildren();
    this.showJobs();
    const { signals } = await this.server.search(name + ".", 10_000);
    if (turn !== this.chosen) return;
    const own = new Map(signals.filter(({ path }) => path.startsWith(name + ".")).map((signal) => [signal.path, signal]));
    this.cells.clear();
    const sensors = await this.sensors(name, own);
    if (turn !== this.chosen) return;
    const placed = new Set<Found>();
    const grouped = kGroups.map(([title, variables]) => this.bits(title, variables.flatMap((variable) => (variable.includes("*") ? sensors.map((one) => variable.replace("*", one)) : [variable]))
      .map((variable) => own.get(`${name}.${variable}`)).filter((signal): signal is Found => !!signal && !!placed.add(signal))));
    const further = kWords.map(([word, title]) => this.bits(title, [...own.values()].filter((signal) =>
      !placed.has(signal) && new RegExp(`^${word.replace(".", "\\.")}\\.X\\d+$`).test(signal.path.slice(name.length + 1)))));
    const sections = [...grouped, ...further];
    const motion = kMotion.map((variable) => own.get(`${name}.${variable}`)).filter((signal): signal is Found => !!signal);
    this.groups.replaceChildren(...[this.values(motion, name), ...sections, this.telegram(name, own, sensors)].filter((section): section is HTMLElement => !!section));
    this.paths = [...this.cells.keys()].slice(0, 1000);
    void this.look(turn);
  }

  /// Numbers of the encoders that the axis has.
  private async sensors(name: string, own: Map<string, Found>): Promise<string[]> {
    const paths = ["1", "2", "3", "4"].map((one) => `${name}.Sensor[${one}].Existent`).filter((path) => own.has(path));
    const read = paths.length ? await this.server.read(paths).catch(() => null) : null;
    return read?.values.filter(({ value }) => value === true).map(({ path }) => /\[(\d)\]/.exec(path)![1]) ?? ["1"];
  }

  private line(signal: Found, label: string, isBit: boolean): HTMLElement {
    const value = html("output", { class: "value" }, "–");
    const since = isBit ? html("span", { class: "since" }) : null;
    const item = html("li", { "data-path": signal.path }, html("button", { type: "button", title: `${signal.path} into the scope`,
      click: () => this.server.show(signal.path) }, label), value, ...(since ? [since] : [html("span", { class: "unit" }, signal.unit)]));
    this.cells.set(signal.path, [...(this.cells.get(signal.path) ?? []), { item, value, since, last: undefined }]);
    return item;
  }

  private bits(title: string, signals: Found[]): HTMLElement | null {
    if (!signals.length) return null;
    return html("section", {}, html("h2", {}, title), html("ul", { class: "bits" }, ...signals.map((signal) =>
      this.line(signal, `${shortened(signal.path)} ${signal.text}`, true))));
  }

  private telegram(name: string, own: Map<string, Found>, sensors: string[]): HTMLElement | null {
    const told = kTelegram.flatMap(([word, variable]) => (variable.includes("*") ? sensors : [""]).map((sensor): [string, Found | undefined] =>
      [word.replace("Gx", `G${sensor}`), own.get(`${name}.${variable.replace("*", sensor)}`)])).filter((one): one is [string, Found] => !!one[1]);
    if (!told.length) return null;
    return html("section", { class: "telegram" }, html("h2", {}, "Telegram of drive and encoders"), html("p", { class: "faint" }, kNoTelegram),
      html("ul", { class: "bits" }, ...told.map(([word, signal]) => this.line(signal, `${word}: ${signal.path.slice(name.length + 1)}`, false))));
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
    for (const cell of this.cells.get(path) ?? []) {
      if (cell.last === value) continue;
      // When a bit changed before one looked is not known.
      if (cell.since && cell.last !== undefined) cell.since.textContent = `since ${seconds(t, 1e8)} s`;
      cell.last = value;
      cell.item.dataset.value = String(value);
      cell.value.textContent = value === true ? "● TRUE" : value === false ? "○ FALSE" : typeof value === "number" ? short(value, 9) : String(value);
    }
  }
}
