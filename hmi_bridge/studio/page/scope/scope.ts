// The oscilloscope: diagrams over one time, with what is measured, triggered, laid over and saved.

import { html, save, svg } from "../base/dom";
import { Frame } from "../base/frames";
import { Link, Message } from "../base/link";
import { Range, rounded, seconds } from "../base/scale";
import { Tabs } from "../base/tabs";
import { Theme } from "../base/theme";
import { AnalysisScene, Spectrum, ValueTable, XyPlot } from "./analysis";
import { Bars, Event, Job } from "./bars";
import { Diagram, Scene, TimeAxis } from "./diagram";
import { Gestures, dragSignal } from "./gestures";
import { Kept, keptOf, readKept } from "./kept";
import { DiagramSetup, Layout, Line, byUnit, firstPaths, kColours, kDiagrams, kSignals, keepLast, lastLayout, lineOf } from "./layout";
import { Layouts } from "./layouts";
import { Measure, Statistics } from "./measure";
import { Overview } from "./overview";
import { Picker } from "./picker";
import { pictureOf, savePng, saveSvg } from "./picture";
import { Recording, Signal } from "./record";
import { Source, fetchWindow, signalsQuery, traceInfo } from "./source";
import { Toolbar } from "./toolbar";
import { Traces } from "./traces";
import { Trigger } from "./trigger";
import { Cursor, Span, View } from "./view";

export interface Project { couplings?: unknown; files?: string[]; name: string; trace: string[]; objects: { name: string; type?: string }[]; tags?: { name: string; comment?: string }[]; instances?: { name: string; type: string }[] }

const kNumbers = 200;  // texts are written each so many ms: nobody reads faster

export class Scope {
  readonly view = new View();
  private readonly diagrams: Diagram[] = [];
  private chosen: Diagram | null = null;  // that takes what is found
  private readonly axis = new TimeAxis();
  private readonly bars = new Bars((t, text) => { this.moment(t); this.say(text); });
  private readonly overview = new Overview(this.view, () => this.latest);
  private readonly measure = new Measure((from, to) => this.statistics(from, to), (t) => this.moment(t));
  private readonly xy = new XyPlot(() => this.dirty());
  private readonly spectrum: Spectrum;
  private readonly table = new ValueTable(() => this.dirty());
  private readonly picker: Picker;
  readonly trigger: Trigger;
  private readonly traces: Traces;
  private readonly layouts: Layouts;
  private readonly toolbar: Toolbar;
  private readonly stack = html("div", { class: "stack" });
  private readonly note = html("p", { class: "note", role: "status", hidden: true });
  private readonly side: Tabs;
  readonly dock: Tabs;
  readonly element: HTMLElement;

  private live: Source;
  private main: Source;
  private overlays: Source[] = [];
  private pages = new Map<string, Source>();  // what only the page has
  private subscription = 0;
  private subscribing = 0;
  private waiting: Frame[] = [];   // rows that have come before what was there already
  private isPreloading = false;
  project: Project = { name: "", trace: [], objects: [] };
  private modulo = new Map<string, number>();  // length by object
  private events: Event[] = [];
  private history: { jobs: Job[]; events: Event[] } = { jobs: [], events: [] };  // of the run
  private shown: { jobs: Job[]; events: Event[] } = { jobs: [], events: [] };
  private readonly pageHistory = new Map<string, [Job[], Event[]]>();  // of saved pages
  private isDirty = true;
  private hasPicture = false;
  private drawnAt = -1;
  private numbersAt = 0;
  private numbersLater = 0;  // timer of numbers that have been left out
  private before: Layout | null = null;                                // as it was before a file was opened
  private jumped: { t: number; cursor: number | null } | null = null;  // the event that one has gone to

  constructor(private readonly link: Link, private readonly theme: Theme) {
    this.live = this.main = new Source({ id: "live", signals: [], from: 0, to: 0 }, true, link);
    this.spectrum = new Spectrum(link);
    this.picker = new Picker({ search: (text, limit) => link.json(`api/signals?limit=${limit}&q=${encodeURIComponent(text)}`),
      choose: (path, isNew) => this.add(path, isNew), drop: (path, target) => this.drop(path, target) });
    this.trigger = new Trigger({ ask: (message) => link.ask(message), changed: () => this.dirty() });
    this.traces = new Traces({ link, show: (id) => void this.show(id), overlay: (id, isOn) => void this.overlay(id, isOn), shift: (id, by) => this.shift(id, by), paths: () => this.paths(),
      shown: () => ({ id: this.main.id, shift: this.main.shift }), shiftOf: (id) => this.overlays.find((one) => one.id === id)?.shift ?? 0, moment: (t) => this.moment(t), open: (text) => this.open(text) });
    this.layouts = new Layouts({ link, project: () => this.project.name, layout: () => this.layout, use: (layout) => this.use(layout) });
    this.toolbar = new Toolbar(this);
    this.side = new Tabs("Tools", [["Signals", this.picker.element], ["Trigger", this.trigger.element], ["Traces", this.traces.element], ["Layouts", this.layouts.element]], (name) => {
      if (name === "Traces") void this.traces.refresh().catch(() => undefined);
      if (name === "Layouts") this.layouts.draw();
    });
    this.dock = new Tabs("Measuring", [["Cursors", this.measure.element], ["XY", this.xy.element], ["Spectrum", this.spectrum.element], ["Values", this.table.element]], () => { this.numbersAt = 0; this.dirty(); }, true);
    this.element = this.build();
    this.side.choose("Signals");
    this.dock.choose("");
    this.view.onChange(() => { this.dirty(); this.toolbar.update(); });
    new ResizeObserver(() => this.dirty()).observe(this.stack);
  }

  private build(): HTMLElement {
    const hatch = svg("svg", { class: "unseen", "aria-hidden": "true", width: 0, height: 0 }, svg("defs", {}, svg("pattern", { id: "hatch", width: 8, height: 8, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
      svg("rect", { class: "hatch-ground", width: 8, height: 8 }), svg("line", { class: "hatch", x1: 0, x2: 0, y1: 0, y2: 8 }))));
    return html("div", { class: "scope-screen" }, html("aside", { class: "side", "aria-label": "Signals, trigger, traces, layouts" }, this.side.element),
      html("div", { class: "scope" }, this.toolbar.element, hatch, this.overview.element, this.stack, html("div", { class: "under" }, this.axis.element, html("div", { class: "bars-frame" }, this.bars.element)),
        this.note, html("div", { class: "dock" }, this.dock.element)));
  }

  dirty(): void { this.isDirty = true; }
  say(text: string): void { this.note.textContent = text; this.note.hidden = text === ""; }

  // What comes from the server.

  async greeted(project: Project, isNewRun: boolean): Promise<void> {
    if (isNewRun) {
      this.live.record = new Recording([]);
      this.traces.restart();
    }
    this.project = project;
    this.layouts.setDesk((project.files?.length ?? 0) > 0);
    this.subscription = 0;
    if (!this.main.isLive && this.main.info.kind !== "page") this.main = this.live;
    this.picker.setTree([...project.objects.map(({ name, type }) => ({ name, kind: "Objects", text: type ?? "" })), ...(project.instances ?? []).map(({ name, type }) => ({ name, kind: "Instances", text: type })),
      ...(project.tags ?? []).map(({ name, comment }) => ({ name, kind: "Tags", text: comment ?? "" }))]);
    void this.picker.look();
    void this.traces.refresh();
    await this.readModulo();
    const layout = lastLayout(project.name);
    const isFirst = !this.diagrams.length;
    if (isFirst) this.arrange(layout?.diagrams ?? [{ lines: firstPaths(project).map((path, i) => lineOf(path, i)), axes: {} }]);
    if (isFirst && layout) this.view.span = layout.length;
    await this.subscribe();
    if (isFirst && !layout) {
      this.arrange(byUnit(this.live.record.columns));
      this.relabel();
    }
  }

  rows(frame: Frame): void {
    if (frame.subscription !== this.subscription) return;
    if (this.isPreloading) this.waiting.push(frame);
    else this.live.record.append(frame);
  }

  caught(shot: { id: string; reason: string; t: number }): void { this.trigger.caught(shot); void this.traces.refresh(); }
  told(message: Message): void { this.traces.told(message); }
  get lostRows(): number { return this.live.record.missing; }
  get end(): number { return this.live.record.end; }

  /// Of the run, and so of its shots.
  setHistory(jobs: Job[], events: Event[]): void {
    this.history = { jobs, events };
    if (!this.hasOwnEvents) this.showHistory(jobs, events);
  }

  private showHistory(jobs: Job[], events: Event[]): void {
    this.events = events;
    this.shown = { jobs, events };
    // A file may tell of objects that no project here has.
    const objects = [...this.project.objects.map(({ name }) => name), ...jobs.map(({ object }) => object)];
    this.bars.set(jobs, events, [...new Set(objects)].filter((name) => name !== ""));
    this.dirty();
  }

  /// Files and saved pages have events of their own, or none.
  private get hasOwnEvents(): boolean { return this.main.info.kind === "file" || this.main.info.kind === "page"; }

  private async showOwnEvents(source: Source): Promise<void> {
    if (source.info.kind === "page") return this.showHistory(...(this.pageHistory.get(source.id) ?? [[], []]));
    if (source.info.kind !== "file") return this.showHistory(this.history.jobs, this.history.events);
    const told = await this.link.json(`api/traces/${source.id}/events`).catch(() => null);
    if (this.main === source) this.showHistory((told?.jobs ?? []).map(jobOf), (told?.events ?? []).map(eventOf));
  }

  /// Positions of an axis with modulo jump by its length, and a line would say that they had come back.
  private async readModulo(): Promise<void> {
    const turning = this.project.objects.filter(({ type }) => /^TO_(PositioningAxis|SynchronousAxis|ExternalEncoder)$/.test(type ?? ""));
    await Promise.all(turning.map(async ({ name }) => {
      const paths = [name + ".Modulo.Enable", name + ".Modulo.Length"];
      const read = await this.link.post("api/read", { paths }).catch(() => null);
      if (read?.values[0].value === true) this.modulo.set(name, Number(read.values[1].value));
    }).slice(0, 20));
  }

  wrap = (path: string): number => {
    const [object, variable] = [path.slice(0, path.lastIndexOf(".")), path.slice(path.lastIndexOf(".") + 1)];
    const length = this.modulo.get(object);
    return length && /Position$/.test(variable) ? length / 2 : Infinity;
  };

  // What is drawn: the run, a shot or a file; and what is laid over it.

  get latest(): number { return this.main.end; }
  get record(): Recording { return this.main.record; }
  get sourceName(): string { return this.main.isLive ? "" : this.main.name; }
  get isLive(): boolean { return this.view.isLive && this.main.isLive; }

  private async source(id: string): Promise<Source | null> {
    const known = this.pages.get(id);
    if (known) return known;
    if (id === "live") return this.live;
    const { traces } = await this.link.json("api/traces");
    const found = traces.find((one: any) => one.id === id);
    if (!found) { this.say(`${id} is no longer kept`); return null; }
    const source = new Source(traceInfo(found), false, this.link);
    await source.load(this.paths());
    return source;
  }

  async show(id: string): Promise<void> {
    const source = await this.source(id).catch((error) => { this.say(error.message); return null; });
    if (!source) return;
    this.main = source;
    this.overlays = this.overlays.filter((one) => one.id !== id);
    if (!source.isLive) await this.fitSignals(source);
    void this.showOwnEvents(source);
    if (source.isLive && this.before) {
      // What a file has brought with it goes with it.
      this.use(this.before);
      this.before = null;
    }
    if (source.isLive) this.view.setLive(true, this.latest);
    else {
      const { t } = source.info;
      this.view.show(source.begin, source.end, this.latest);
      if (t !== undefined) this.view.place("A", t);
    }
    this.traces.setOverlays(this.overlays.map((one) => one.id));
    this.relabel();
    this.toolbar.update();
  }

  /// A file that has nothing of what stands in the diagrams is shown with what it has.
  private async fitSignals(source: Source): Promise<void> {
    if (source.record.columns.length || !source.info.signals.length) return;
    this.arrange(byUnit(source.info.signals.slice(0, 64)));
    await source.load(this.paths());
  }

  private async overlay(id: string, isOn: boolean): Promise<void> {
    this.overlays = this.overlays.filter((one) => one.id !== id);
    if (isOn) {
      const source = await this.source(id).catch(() => null);
      if (source && source !== this.main) {
        const shifted = source.isLive ? new Source(source.info, true, this.link) : source;
        if (source.isLive) shifted.record = source.record;
        shifted.shift = this.traces.aligned(id, this.main.info);
        if (this.overlays.length < 50) this.overlays.push(shifted);
      }
    }
    this.traces.setOverlays(this.overlays.map((one) => one.id));
    this.dirty();
  }

  private shift(id: string, by: number): void {
    const source = this.overlays.find((one) => one.id === id);
    if (source) source.shift = by;
    this.dirty();
  }

  /// What this page or the server has saved with its values.
  open(text: string): boolean {
    const kept = readKept(text);
    if (!kept) return false;
    const id = `page-${this.pages.size + 1}`;
    const { record } = kept;
    if (this.main.info.kind !== "page" && this.diagrams.length) this.before = structuredClone(this.layout);
    const source = new Source({ id, name: `${kept.about.project ?? kept.about.name ?? "trace"} (saved)`, kind: "page", signals: kept.signals, from: record.begin, to: record.end }, false, null);
    source.record = record;
    this.pages.set(id, source);
    this.traces.add(source.info);
    this.main = source;
    this.arrange(kept.read?.diagrams ?? byUnit(kept.signals.slice(0, 64)));
    this.view.show(Number(kept.window?.from ?? record.begin), Number(kept.window?.to ?? record.end), this.latest);
    this.relabel();
    this.toolbar.update();
    this.pageHistory.set(id, [(kept.jobs ?? []).map(jobOf), (kept.events ?? []).map(eventOf)]);
    void this.showOwnEvents(source);
    return true;
  }

  // Diagrams and their signals.

  paths(): string[] { return [...new Set(this.diagrams.flatMap((diagram) => diagram.paths))]; }
  get layout(): Layout { return { version: 2, diagrams: this.diagrams.map(({ setup }) => setup), length: this.view.span }; }

  private use(layout: Layout): void {
    this.view.span = layout.length;
    this.arrange(layout.diagrams);
    void this.changed();
  }

  private arrange(setups: DiagramSetup[]): void {
    for (const diagram of this.diagrams.splice(0)) diagram.element.remove();
    for (const setup of setups) this.openDiagram(setup);
    this.choose(this.diagrams[0] ?? null);
  }

  private choose(diagram: Diagram | null): void {
    this.chosen = diagram;
    for (const one of this.diagrams) one.element.classList.toggle("chosen", one === diagram);
  }

  private openDiagram(setup: DiagramSetup): Diagram {
    const diagram: Diagram = new Diagram(setup, {
      remove: (path) => this.remove(diagram, path), chosen: () => this.choose(diagram), close: () => this.close(diagram), resized: () => this.dirty(),
      changed: () => { this.keep(); this.relabel(); }, trigger: (path) => this.triggerOn(path), drag: (path, event) => dragSignal(path, event, (target) => this.move(diagram, path, target)),
      analyse: (path, how) => { this.dock.choose(how === "xy" ? "XY" : "Spectrum"); this.dirty(); this.frame(); (how === "xy" ? this.xy : this.spectrum).choose(path); },
      fit: (unit) => { diagram.axes[unit] = { mode: "fixed", range: diagram.rangeOf(unit) }; this.keep(); this.relabel(); },
    });
    new Gestures(diagram, { view: this.view, latest: () => this.latest, snap: (t) => this.snap(t), units: () => diagram.units(this.record),
      level: () => { const level = this.level(); const column = level && diagram.paths.includes(level.path) ? this.record.column(level.path) : undefined; return level && column ? { ...level, unit: column.unit } : null; },
      setLevel: (value) => this.trigger.setLevel(value), axisChanged: () => { this.keep(); this.relabel(); } });
    this.diagrams.push(diagram);
    this.stack.append(diagram.element);
    return diagram;
  }

  newDiagram(): void {
    if (this.diagrams.length >= kDiagrams) return this.say(`${kDiagrams} diagrams are the most`);
    this.choose(this.openDiagram({ lines: [], axes: {} }));
    this.relabel();
  }

  private close(diagram: Diagram): void {
    diagram.element.remove();
    this.diagrams.splice(this.diagrams.indexOf(diagram), 1);
    if (this.chosen === diagram) this.choose(this.diagrams[0] ?? null);
    void this.changed();
  }

  /// A colour that no line of a diagram has yet, or the next.
  private freeColour(): number {
    const used = this.diagrams.flatMap(({ lines }) => lines.map(({ colour }) => colour));
    const free = Array.from({ length: kColours }, (_, i) => i).find((colour) => !used.includes(colour));
    return free ?? used.length % kColours;
  }

  add(path: string, isNew: boolean): void {
    const isFull = !this.chosen || this.chosen.lines.length >= kSignals;
    if ((isNew || isFull) && this.diagrams.length < kDiagrams) this.choose(this.openDiagram({ lines: [], axes: {} }));
    if (!this.chosen || this.chosen.paths.includes(path)) return;
    this.chosen.lines.push(lineOf(path, this.freeColour()));
    void this.changed();
  }

  private drop(path: string, target: Element | null): void {
    if (!target) return;
    const diagram = this.diagrams.find(({ element }) => element === target);
    if (diagram) this.choose(diagram);
    this.add(path, !diagram);
  }

  private move(from: Diagram, path: string, target: Element | null): void {
    const to = this.diagrams.find(({ element }) => element === target);
    const line = from.lines.find((one) => one.path === path);
    if (!line || !target || to === from || to?.paths.includes(path)) return;
    from.lines = from.lines.filter((one) => one !== line);
    const diagram = to ?? this.openDiagram({ lines: [], axes: {} });
    diagram.lines.push(line);
    if (!from.lines.length) this.close(from);
    this.choose(diagram);
    void this.changed();
  }

  private remove(diagram: Diagram, path: string): void {
    diagram.lines = diagram.lines.filter((one) => one.path !== path);
    if (!diagram.lines.length) return this.close(diagram);
    void this.changed();
  }

  private keep(): void { if (this.project.name) keepLast(this.project.name, this.layout); }

  private async changed(): Promise<void> {
    this.keep();
    this.relabel();
    for (const source of [this.main, ...this.overlays]) if (!source.isLive) await source.load(this.paths()).catch(() => undefined);
    await this.subscribe();
  }

  /// All signals as one subscription, each time a new one, so that rows of the one before are told apart. What
  /// the server has of them comes first.
  private async subscribe(): Promise<void> {
    const old = this.subscription;
    const id = ++this.subscribing;
    const paths = this.paths();
    if (!this.link.isOpen) return;
    if (!paths.length) {
      if (old) void this.link.ask({ type: "unsubscribe", id: old });
      this.subscription = 0;
      return;
    }
    const kept = this.link.json("api/traces").catch(() => null);
    const answer = await this.link.ask({ type: "subscribe", id, paths });
    if (old) void this.link.ask({ type: "unsubscribe", id: old });
    if (id !== this.subscribing) return;
    this.subscription = id;
    this.waiting = [];
    this.isPreloading = true;
    const wrong = answer.signals.filter((signal: any) => signal.error);
    if (wrong.length) this.say(wrong.map((signal: any) => `${signal.path}: ${signal.error.message}`).join("; "));
    const signals: Signal[] = answer.signals.filter((signal: any) => !signal.error);
    // Where nobody has seen any of them there is nothing yet, nor of a simulation that has not begun.
    const isEmpty = (await kept)?.traces.find((one: any) => one.id === "live")?.rows === 0 && this.live.record.size === 0;
    const record = isEmpty ? new Recording(signals) : await fetchWindow(this.link, "live", signals, null).catch(() => new Recording(signals));
    if (id !== this.subscription) return;
    this.live.record = record;
    this.isPreloading = false;
    for (const frame of this.waiting.splice(0)) record.append(frame);
    this.relabel();
    void this.readNames(record);
  }

  /// What the values of enumerations are called, where the project tells it.
  private async readNames(record: Recording): Promise<void> {
    if (!this.project.couplings) return;
    for (const column of record.columns.filter(({ type }) => /INT$/.test(type))) {
      const object = this.project.objects.find(({ name }) => column.path.startsWith(name + "."));
      if (!object) continue;
      const { variables } = await this.link.json(`api/objects/${encodeURIComponent(object.name)}`).catch(() => ({ variables: [] }));
      const found = variables.find(({ path }: { path: string }) => path === column.path);
      if (found?.choices?.length) column.names = Object.fromEntries(found.choices.map(({ value, text }: { value: number; text: string }) => [value, text]));
    }
    this.dirty();
  }

  colour = (line: Line): string => this.theme.colour(line.colour);

  relabel(): void {
    this.trigger?.setPaths(this.paths());
    const scene = this.scene();
    for (const diagram of this.diagrams) diagram.relabel(scene);
    this.numbersAt = 0;
    this.dirty();
  }

  // The picture.

  private level(): { path: string; value: number } | null { return this.side.chosen === "Trigger" ? this.trigger.shown : null; }

  private commonRange = (unit: string): Range | null => {
    let [low, high] = [Infinity, -Infinity];
    const scene = this.scene();
    for (const diagram of this.diagrams) {
      if (diagram.axes[unit]?.mode !== "common") continue;
      const ends = diagram.extremes(unit, scene);
      low = Math.min(low, ends[0]);
      high = Math.max(high, ends[1]);
    }
    return low <= high ? rounded(low, high, null) : null;
  };

  private scene(): Scene {
    return { sources: [this.main, ...this.overlays], view: this.view, span: this.view.window(this.latest), isMoving: this.isLive, colour: this.colour, faint: () => this.theme.line,
      wrap: this.wrap, common: this.commonRange, level: this.level(), changed: () => this.dirty() };
  }

  frame(): void {
    const end = this.latest;
    if (!this.isDirty && (!this.isLive || end === this.drawnAt)) return;
    const scene = this.scene();
    this.isDirty = false;
    this.drawnAt = end;
    for (const diagram of this.diagrams) diagram.draw(scene);
    if (!this.hasPicture && this.record.size > 1) {
      this.hasPicture = true;
      performance.mark("first picture");
    }
    this.axis.draw(scene.span, this.view.isSweeping && this.isLive);
    this.bars.draw(scene.span, this.hasOwnEvents ? this.main.end : this.live.end, this.isLive);
    this.overview.draw(this.main, this.overviewLines(), this.colour, scene.span, this.wrap);
    const now = performance.now();
    if (!this.isLive || now - this.numbersAt > kNumbers) {
      this.numbersAt = now;
      this.showNumbers(scene);
    } else this.numbersLater ||= window.setTimeout(() => { this.numbersLater = 0; this.dirty(); }, kNumbers);
  }

  private overviewLines(): Line[] { return (this.chosen ?? this.diagrams[0])?.lines.filter(({ isVisible }) => isVisible).slice(0, 4) ?? []; }

  private showNumbers(scene: Scene): void {
    const { cursors, active } = this.view;
    const at = cursors[active];
    const record = this.main.recordFor(scene.span, () => this.dirty());
    const row = !this.isLive && at !== null ? record.nearest(at - this.main.shift) : record.size - 1;
    for (const diagram of this.diagrams) diagram.showValues(record, row);
    const chosen = this.chosen ?? this.diagrams[0];
    this.measure.draw(record, this.view, this.main.shift, { ...(chosen?.values ?? { C: null, D: null }), unit: chosen?.units(record)[0] ?? "" });
    const analysis: AnalysisScene = { source: this.main, others: this.overlays, view: this.view, span: scene.span, paths: this.paths(), wrap: this.wrap };
    this.xy.draw(analysis);
    this.spectrum.draw(analysis);
    this.table.draw(analysis);
  }

  // What one does.

  toggleLive(): void {
    if (!this.main.isLive) return void this.show("live");
    this.view.setLive(!this.view.isLive, this.latest);
  }
  middle(): number { const { from, to } = this.view.window(this.latest); return (from + to) / 2; }
  snap(t: number): number {
    const record = this.main.recordFor(this.view.window(this.latest), () => undefined);
    const row = record.nearest(t - this.main.shift);
    return row < 0 ? t : record.t[row] + this.main.shift;
  }
  zoom(factor: number): void { this.view.zoom(factor, this.middle(), this.latest); }
  fit(): void { this.view.show(this.main.begin, this.latest, this.latest); }
  setLength(length: number): void { this.view.setLength(length, this.latest); this.keep(); }

  cursor(name: Cursor): void {
    if (this.view.cursors[name] === null) this.view.place(name, this.snap(this.middle()));
    else this.view.place(name, this.view.cursors[name]);
    if (this.dock.chosen === "") this.dock.choose("Cursors");
  }

  /// Places a cursor of values in the chosen diagram, or takes it away.
  valueCursor(name: "C" | "D"): void {
    const diagram = this.chosen ?? this.diagrams[0];
    if (!diagram) return;
    const { low, high } = diagram.rangeOf(diagram.units(this.record)[0] ?? "");
    diagram.values[name] = diagram.values[name] === null ? low + (high - low) * (name === "C" ? 1 / 3 : 2 / 3) : null;
    if (this.dock.chosen === "") this.dock.choose("Cursors");
    this.dirty();
  }

  clearCursors(): void {
    this.view.place("A", null);
    this.view.place("B", null);
    for (const diagram of this.diagrams) diagram.values.C = diagram.values.D = null;
    if (this.dock.chosen === "Cursors") this.dock.choose("");
    this.say("");
  }

  moment(t: number): void {
    const { from, to } = this.view.window(this.latest);
    this.view.show(t - (to - from) / 2, t + (to - from) / 2, this.latest);
    this.view.place("A", this.snap(t));
  }

  step(rows: number): void {
    const { cursors, active } = this.view;
    const at = cursors[active];
    if (at === null) return this.view.move(Math.sign(rows) * 0.1, this.latest);
    const record = this.main.recordFor(this.view.window(this.latest), () => undefined);
    const row = Math.min(Math.max(record.nearest(at - this.main.shift) + rows, 0), record.size - 1);
    if (row >= 0) this.view.place(active, record.t[row] + this.main.shift);
  }

  /// Values of the axes of the chosen diagram: a part of them, or all again.
  zoomValues(factor: number | null): void {
    const diagram = this.chosen ?? this.diagrams[0];
    if (!diagram) return;
    for (const unit of diagram.units(this.record)) {
      const { low, high } = diagram.rangeOf(unit);
      const [middle, half] = [(low + high) / 2, ((high - low) / 2) * (factor ?? 1)];
      if (factor === null) delete diagram.axes[unit];
      else diagram.axes[unit] = { mode: "fixed", range: { low: middle - half, high: middle + half } };
    }
    this.keep();
    this.relabel();
  }

  jump(direction: 1 | -1): void {
    // A stands on a row, which may be a little beside the event.
    const isThere = this.jumped !== null && this.view.cursors.A === this.jumped.cursor;
    const at = isThere ? this.jumped!.t : this.view.cursors.A ?? this.middle();
    const next = this.events.filter(({ t }) => (t - at) * direction > 0).sort((a, b) => (a.t - b.t) * direction)[0];
    if (!next) return this.say(direction > 0 ? "no event after this" : "no event before this");
    this.moment(next.t);
    this.jumped = { t: next.t, cursor: this.view.cursors.A };
    this.say(`${seconds(next.t, 1e6)} s ${next.source || "the run"}: ${next.kind}${next.number ? " " + next.number : ""}${next.text ? ", " + next.text : ""}`);
  }

  triggerOn(path: string): void {
    this.side.choose("Trigger");
    const diagram = this.diagrams.find((one) => one.paths.includes(path));
    const column = this.record.column(path);
    const { low, high } = diagram && column ? diagram.rangeOf(column.unit) : { low: 0, high: 1 };
    this.trigger.setPath(path, column?.type === "BOOL" ? 0.5 : (low + high) / 2);
  }

  searchSignal(): void { this.side.choose("Signals"); this.picker.input.focus(); }

  // What is asked of the server, and what is saved.

  private names(): string { return signalsQuery(this.main.record.columns.map(({ path }) => path)); }
  private part(from: number, to: number): string { return `from=${Math.round(from - this.main.shift)}&to=${Math.round(to - this.main.shift)}`; }

  private async statistics(from: number, to: number): Promise<Statistics[]> {
    const all = this.main.info.kind === "page" ? [] : await this.link.json(`api/traces/${this.main.id}/statistics?${this.names()}&${this.part(from, to)}`);
    setTimeout(() => { this.numbersAt = 0; this.dirty(); });
    return all;
  }

  picture(): string { return pictureOf(this.project.name, this.diagrams, this.scene(), (line) => this.theme.printed(line.colour)); }

  async export_(format: "csv" | "lcm" | "html" | "svg" | "png" | "json"): Promise<void> {
    const name = this.project.name || "lockstep";
    const { from, to } = this.view.window(this.latest);
    try {
      if (format === "svg") return saveSvg(this.picture(), name);
      if (format === "png") return await savePng(this.picture(), name);
      if (format === "json") {
        const span = { from: from - this.main.shift, to: to - this.main.shift };
        const kept: Kept = keptOf(name, this.main.recordFor({ from, to }, () => undefined), span, this.layout, { from, to });
        kept.jobs = this.shown.jobs.filter((job) => job.begin <= span.to && job.end >= span.from);
        kept.events = this.shown.events.filter(({ t }) => t >= span.from && t <= span.to);
        return save(new Blob([JSON.stringify(kept)], { type: "application/json" }), name + ".studio.json");
      }
      const response = await this.link.get(`api/traces/${this.main.id}/export?format=${format}&${this.names()}&${this.part(from, to)}`);
      save(await response.blob(), `${name}.${format}`);
    } catch (error) {
      this.say((error as Error).message);
    }
  }
}

const numberOr = (value: any, other: number): number => (value === undefined || value === null ? other : Number(value));
export function eventOf(event: any): Event { return { ...event, t: Number(event.t) }; }
export function jobOf(job: any): Job { return { ended: "", text: "", ...job, begin: Number(job.begin), end: numberOr(job.end, Infinity) }; }
