// The studio's page: what a run shows of itself, live.

import { Alarms } from "./alarms";
import { Bars, Event, Job } from "./bars";
import { Diagnosis } from "./diagnosis";
import { Diagram, TimeAxis } from "./diagram";
import { button, html, save } from "./dom";
import { Frame, decode } from "./frames";
import { listen } from "./gestures";
import { byUnit, firstPaths, keep, kDiagrams, kSignals, load } from "./layout";
import { Link, Listener, Message } from "./link";
import { Measure } from "./measure";
import { Picker } from "./picker";
import { pictureOf, savePng, saveSvg } from "./picture";
import { Recording, Signal } from "./record";
import { seconds } from "./scale";
import { Theme } from "./theme";
import { Shot, Trigger } from "./trigger";
import { Cursor, View } from "./view";

const kKeys: [string, string][] = [
  ["Space", "stop the picture, or go on live"], ["+  −", "shorter or longer stretch"], ["← →", "move the active cursor by a row, or the picture"],
  ["Shift ← →", "… by ten rows"], ["A  B", "place a cursor in the middle, or make it the active one"], ["Esc", "take the cursors away"],
  ["Home", "all that is kept"], ["Backspace", "the stretch before; with Shift the one after"], ["N  P", "next or previous event"],
  ["/", "search a signal; Enter takes the first, Shift+Enter into a new diagram"], ["1  2", "the scope, the axes"], ["T", "light or dark"], ["?", "these keys"],
];

class Studio implements Listener {
  private readonly link = new Link(this);
  private readonly view = new View();
  private readonly theme = new Theme(() => this.relabel());
  private readonly diagrams: Diagram[] = [];
  private chosen: Diagram | null = null;  // that takes what is found
  private readonly axis = new TimeAxis();
  private readonly bars = new Bars();
  private readonly alarms = new Alarms((t) => this.showMoment(t));
  private readonly measure = new Measure((from, to) => this.statistics(from, to));
  private readonly picker = new Picker((text) => this.link.json(`api/signals?limit=40&q=${encodeURIComponent(text)}`),
                                       (path, isNew) => this.add(path, isNew));
  private readonly trigger = new Trigger({ ask: (message) => this.link.ask(message), show: (shot) => void this.showShot(shot) });
  private readonly diagnosis = new Diagnosis({
    search: (text, limit) => this.link.json(`api/signals?limit=${limit}&q=${encodeURIComponent(text)}`),
    read: (paths) => this.link.post("api/read", { paths }),
    show: (path) => { this.setScreen("scope"); this.add(path, true); },
  });
  private record = new Recording([]);
  private shot: { id: string; record: Recording } | null = null;  // shown in place of the run
  private subscription = 0;
  private subscribing = 0;
  private waiting: Frame[] = [];   // rows that have come before what was there already
  private isPreloading = false;
  private run = "";
  private project = { name: "", trace: [] as string[], objects: [] as { name: string }[] };
  private modulo = new Map<string, number>();  // length by object
  private events: Event[] = [];
  private history: number | undefined;
  private isDirty = true;
  private drawnAt = 0;

  private readonly title = html("h1", {}, "Lockstep");
  private readonly clock = html("output", { class: "clock", "aria-label": "Time of the run" }, "–");
  private readonly state = html("p", { class: "state", role: "status" }, "connecting");
  private readonly live = button("Stop", "Stop the picture, or go on live (Space)", () => this.toggleLive());
  private readonly scope = html("div", { class: "scope" });
  private readonly screens = { scope: button("Scope", "The oscilloscope (1)", () => this.setScreen("scope")),
    axes: button("Axes", "Axis diagnosis (2)", () => this.setScreen("axes")) };
  private readonly stack = html("div", { class: "stack" });
  private readonly dialog: HTMLDialogElement = html("dialog", { "aria-label": "Keys" }, html("h2", {}, "Keys"),
    html("dl", {}, ...kKeys.flatMap(([key, text]) => [html("dt", {}, html("kbd", {}, key)), html("dd", {}, text)])),
    button("Close", "Close", () => this.dialog.close()));
  private readonly token = this.tokenForm();

  constructor() {
    document.body.append(this.header(), html("main", {}, html("div", { class: "side" }, this.picker.element, this.trigger.element),
      this.scope, this.diagnosis.element, this.alarms.element),
      this.dialog, this.token);
    this.scope.append(this.stack, html("div", { class: "under" }, this.axis.element, this.bars.element), this.measure.element);
    this.setScreen("scope");
    this.view.onChange(() => { this.isDirty = true; this.showLive(); });
    document.addEventListener("keydown", (event) => this.key(event));
    this.link.connect();
    requestAnimationFrame(() => this.frame());
  }

  private header(): HTMLElement {
    return html("header", {}, this.title, html("nav", { "aria-label": "Screens" }, this.screens.scope, this.screens.axes), this.clock, this.live,
      button("−", "A longer stretch", () => this.zoom(1.6)), button("+", "A shorter stretch", () => this.zoom(0.625)),
      button("All", "All that is kept (Home)", () => this.fit()), button("Back", "The stretch before (Backspace)", () => this.view.back()),
      button("A", "Cursor A", () => this.cursor("A")), button("B", "Cursor B", () => this.cursor("B")),
      button("CSV", "Save the values of what is shown", () => void this.saveCsv()),
      button("SVG", "Save the picture as SVG", () => saveSvg(this.picture())), button("PNG", "Save the picture as PNG", () => void savePng(this.picture())),
      button("Theme", "Light or dark (T)", () => this.theme.toggle()), button("?", "Keys", () => this.dialog.showModal()), this.state);
  }

  private setScreen(screen: "scope" | "axes"): void {
    this.scope.hidden = screen !== "scope";
    this.diagnosis.setVisible(screen === "axes");
    for (const [name, one] of Object.entries(this.screens)) one.setAttribute("aria-current", String(name === screen));
    this.isDirty = true;
  }

  private tokenForm(): HTMLDialogElement {
    const field = html("input", { type: "password", "aria-label": "Token", autocomplete: "off", required: true });
    const dialog = html("dialog", { "aria-label": "Token" }, html("p", {}, "This studio asks for a token."),
      field, button("Enter", "Enter", () => { this.link.setToken(field.value.trim()); dialog.close(); }));
    field.addEventListener("keydown", (event) => { if (event.key === "Enter") dialog.querySelector("button")?.click(); });
    return dialog;
  }

  // What comes from the server.

  async greeted(hello: Message): Promise<void> {
    if (hello.run !== this.run) this.record = new Recording([]);
    this.run = hello.run;
    this.subscription = 0;
    this.project = await this.link.json("api/project");
    this.title.textContent = document.title = this.project.name;
    void this.picker.look();
    this.diagnosis.setObjects(this.project.objects.map(({ name }) => name));
    this.askHistory(0);
    this.shot = null;
    const { traces } = await this.link.json("api/traces");
    this.trigger.set(traces.filter(({ id }: Shot) => id !== "live").map((shot: any): Shot => ({ ...shot, t: Number(shot.t) })));
    await this.readModulo();
    const layout = load(this.project.name);
    if (!this.diagrams.length) this.arrange(layout ?? [firstPaths(this.project)]);
    await this.subscribe();
    if (!layout && this.diagrams.length === 1) {
      this.arrange(byUnit(this.record.columns));
      this.relabel();
    }
  }

  said(message: Message): void {
    if (message.type === "event") this.askHistory(250);
    if (message.type === "shot") this.trigger.caught({ id: message.id, reason: message.reason, t: Number(message.t) });
    if (message.type === "status") this.state.textContent = this.status(message);
  }

  rows(frame: Frame): void {
    if (frame.subscription !== this.subscription) return;
    if (this.isPreloading) this.waiting.push(frame);
    else this.record.append(frame);
  }

  lost(reason: string): void { this.state.textContent = reason || "connected"; this.state.classList.toggle("lost", reason !== ""); }

  tokenAsked(): void { if (!this.token.open) this.token.showModal(); }

  private status(message: Message): string {
    const lost = this.record.missing + Number(message.events_lost);
    return `${message.pages} page${message.pages === 1 ? "" : "s"}${lost ? `, ${lost} rows or events lost` : ""}`;
  }

  /// Positions of an axis with modulo jump by its length, and a line would say that they had come back.
  private async readModulo(): Promise<void> {
    for (const { name } of this.project.objects) {
      const paths = [name + ".Modulo.Enable", name + ".Modulo.Length"];
      const read = await this.link.post("api/read", { paths }).catch(() => null);
      if (read?.values[0].value === true) this.modulo.set(name, Number(read.values[1].value));
    }
  }

  private wrap = (path: string): number => {
    const [object, variable] = [path.slice(0, path.lastIndexOf(".")), path.slice(path.lastIndexOf(".") + 1)];
    const length = this.modulo.get(object);
    return length && /Position$/.test(variable) ? length / 2 : Infinity;
  };

  /// Jobs and events are asked for as a whole, so that what is a job is said in one place.
  private askHistory(delay: number): void {
    if (this.history !== undefined) return;
    this.history = window.setTimeout(async () => {
      this.history = undefined;
      const [jobs, events] = await Promise.all([this.link.json("api/jobs"), this.link.json("api/events")]).catch(() => [null, null]);
      if (!jobs || !events) return;
      const time = (event: any): Event => ({ ...event, t: Number(event.t) });
      this.events = events.events.map(time);
      this.alarms.set(events.pending.map(time), this.events);
      this.bars.set(jobs.jobs.map((job: any): Job => ({ ended: "", text: "", ...job, begin: Number(job.begin), end: job.end === undefined ? Infinity : Number(job.end) })),
        this.events, this.project.objects.map(({ name }) => name));
      this.isDirty = true;
    }, delay);
  }

  /// What is drawn: the run, or a shot.
  private get shown(): Recording { return this.shot?.record ?? this.record; }
  private get latest(): number { return this.shown.end; }

  private async showShot(shot: Shot): Promise<void> {
    const { traces } = await this.link.json("api/traces");
    const found = traces.find(({ id }: Shot) => id === shot.id);
    if (!found) return this.lost(`${shot.id} is no longer kept`);
    const record = new Recording(found.signals.filter(({ path }: Signal) => this.paths().includes(path)));
    await this.preload(record, shot.id).catch(() => undefined);
    this.shot = { id: shot.id, record };
    this.view.show(Number(found.from), Number(found.to), this.latest);
    this.view.place("A", shot.t);
    this.relabel();
  }

  // Diagrams and their signals.

  private paths(): string[] { return [...new Set((this.diagrams ?? []).flatMap((diagram) => diagram.paths))]; }

  private arrange(layout: string[][]): void {
    for (const diagram of this.diagrams.splice(0)) diagram.element.remove();
    for (const paths of layout) this.open(paths);
    this.chosen = this.diagrams[0] ?? null;
  }

  private open(paths: string[]): Diagram {
    const diagram: Diagram = new Diagram(paths, {
      remove: (path) => this.remove(diagram, path),
      chosen: () => { this.chosen = diagram; for (const one of this.diagrams) one.element.classList.toggle("chosen", one === diagram); },
    });
    listen(diagram.plot, this.view, () => this.latest, (t) => this.snap(t));
    this.diagrams.push(diagram);
    this.stack.append(diagram.element);
    return diagram;
  }

  private add(path: string, isNew: boolean): void {
    const isFull = !this.chosen || this.chosen.paths.length >= kSignals;
    if ((isNew || isFull) && this.diagrams.length < kDiagrams) this.chosen = this.open([]);
    if (!this.chosen || this.chosen.paths.includes(path)) return;
    this.chosen.paths.push(path);
    void this.changed();
  }

  private remove(diagram: Diagram, path: string): void {
    diagram.paths = diagram.paths.filter((one) => one !== path);
    if (!diagram.paths.length) {
      diagram.element.remove();
      this.diagrams.splice(this.diagrams.indexOf(diagram), 1);
      if (this.chosen === diagram) this.chosen = this.diagrams[0] ?? null;
    }
    void this.changed();
  }

  private changed(): Promise<void> {
    keep(this.project.name, this.diagrams.map((diagram) => diagram.paths));
    return this.subscribe();
  }

  /// All signals as one subscription, each time a new one, so that rows of the one before are told apart. What
  /// the server has of them comes first.
  private async subscribe(): Promise<void> {
    const old = this.subscription;
    const id = ++this.subscribing;
    const paths = this.paths();
    if (!paths.length) {
      if (old) void this.link.ask({ type: "unsubscribe", id: old });
      this.subscription = 0;
      return;
    }
    const answer = await this.link.ask({ type: "subscribe", id, paths });
    if (old) void this.link.ask({ type: "unsubscribe", id: old });
    if (id !== this.subscribing) return;
    this.subscription = id;
    this.waiting = [];
    this.isPreloading = true;
    const signals: Signal[] = answer.signals.filter((signal: any) => !signal.error);
    const record = new Recording(signals);
    await this.preload(record).catch(() => undefined);  // where nobody has seen any of them there is nothing yet
    if (id !== this.subscription) return;
    this.record = record;
    this.isPreloading = false;
    for (const frame of this.waiting.splice(0)) record.append(frame);
    this.relabel();
  }

  private async preload(record: Recording, trace = "live"): Promise<void> {
    if (!record.columns.length) return;
    const names = record.columns.map(({ path }) => encodeURIComponent(path)).join();
    const response = await this.link.get(`api/traces/${trace}/window?pixels=20000&signals=${names}`);
    record.append(decode(await response.arrayBuffer()));
  }

  private colour = (path: string): string => this.theme.colour(Math.max(this.paths().indexOf(path), 0));

  private relabel(): void {
    this.trigger?.setPaths(this.paths());
    for (const diagram of this.diagrams ?? [])
      diagram.setLegend(this.colour, (path) => this.shown.column(path)?.unit ?? "");
    this.isDirty = true;
  }

  // The picture.

  private frame(): void {
    requestAnimationFrame(() => this.frame());
    this.link.drawn();
    const end = this.latest;
    if (!this.isDirty && (!this.view.isLive || end === this.drawnAt)) return;
    const span = this.view.window(end);
    for (const diagram of this.diagrams) diagram.draw(this.shown, this.view, span, this.colour, this.wrap);
    this.axis.draw(span);
    this.bars.draw(span, end);
    if (this.isDirty || Math.floor(end / 2e8) !== Math.floor(this.drawnAt / 2e8)) this.showNumbers();
    this.isDirty = false;
    this.drawnAt = end;
  }

  /// Values and texts, five times a second: nobody reads faster.
  private showNumbers(): void {
    const { cursors, active, isLive } = this.view;
    const at = cursors[active];
    const row = !isLive && at !== null ? this.shown.nearest(at) : this.shown.size - 1;
    for (const diagram of this.diagrams) diagram.showValues(this.shown, row);
    this.clock.textContent = this.record.size ? seconds(this.record.end, 1e8) + " s" : "–";
    this.measure.draw(this.shown, this.view);
  }

  private toggleLive(): void {
    if (!this.view.isLive) this.shot = null;
    this.view.setLive(!this.view.isLive, this.latest);
  }
  private showLive(): void {
    this.live.textContent = this.view.isLive ? "Stop" : "Live";
    this.live.setAttribute("aria-pressed", String(!this.view.isLive));
  }

  private middle(): number { const { from, to } = this.view.window(this.latest); return (from + to) / 2; }
  private snap(t: number): number { const row = this.shown.nearest(t); return row < 0 ? t : this.shown.t[row]; }
  private zoom(factor: number): void { this.view.zoom(factor, this.middle(), this.latest); }
  private fit(): void { this.view.show(this.shown.begin, this.latest, this.latest); }
  private cursor(name: Cursor): void {
    if (this.view.cursors[name] === null) this.view.place(name, this.snap(this.middle()));
    else this.view.place(name, this.view.cursors[name]);
  }

  private showMoment(t: number): void {
    const { from, to } = this.view.window(this.latest);
    this.view.show(t - (to - from) / 2, t + (to - from) / 2, this.latest);
    this.view.place("A", this.snap(t));
  }

  private step(rows: number): void {
    const { cursors, active } = this.view;
    const at = cursors[active];
    if (at === null) return this.view.move(Math.sign(rows) * 0.1, this.latest);
    const row = Math.min(Math.max(this.shown.nearest(at) + rows, 0), this.shown.size - 1);
    if (row >= 0) this.view.place(active, this.shown.t[row]);
  }

  private jump(direction: 1 | -1): void {
    const at = this.view.cursors.A ?? this.middle();
    const times = this.events.map(({ t }) => t).filter((t) => (t - at) * direction > 0);
    if (times.length) this.showMoment(direction > 0 ? Math.min(...times) : Math.max(...times));
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.altKey || event.metaKey || this.dialog.open || this.token.open) return;
    if (target instanceof HTMLInputElement || target instanceof HTMLSelectElement || (target instanceof HTMLButtonElement && /^( |Enter|Arrow)/.test(event.key))) return;
    const size = event.shiftKey ? 10 : 1;
    const keys: Record<string, () => void> = {
      " ": () => this.toggleLive(), "+": () => this.zoom(0.625), "-": () => this.zoom(1.6), Home: () => this.fit(),
      ArrowLeft: () => this.step(-size), ArrowRight: () => this.step(size), a: () => this.cursor("A"), b: () => this.cursor("B"),
      Backspace: () => (event.shiftKey ? this.view.forward() : this.view.back()), n: () => this.jump(1), p: () => this.jump(-1),
      "/": () => this.picker.input.focus(), t: () => this.theme.toggle(), "?": () => this.dialog.showModal(),
      1: () => this.setScreen("scope"), 2: () => this.setScreen("axes"),
      Escape: () => { this.view.place("A", null); this.view.place("B", null); },
    };
    const call = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!call) return;
    event.preventDefault();
    call();
  }

  // What is asked of the server, and what is saved.

  private names(): string { return this.shown.columns.map(({ path }) => encodeURIComponent(path)).join(); }

  private statistics(from: number, to: number): Promise<any> {
    return this.link.json(`api/traces/${this.shot?.id ?? "live"}/statistics?signals=${this.names()}&from=${Math.round(from)}&to=${Math.round(to)}`)
      .then((all) => { setTimeout(() => { this.isDirty = true; }); return all; });
  }

  private picture(): string {
    return pictureOf(this.project.name, this.diagrams, this.shown, this.view.window(this.latest), this.colour, this.wrap);
  }

  private async saveCsv(): Promise<void> {
    const { from, to } = this.view.window(this.latest);
    const response = await this.link.get(`api/traces/${this.shot?.id ?? "live"}/export?format=csv&signals=${this.names()}&from=${Math.round(from)}&to=${Math.round(to)}`);
    save(await response.blob(), this.project.name + ".csv");
  }
}

new Studio();
