// The studio's page: what a run shows of itself, live, and how it is told something.

import { button, html } from "./base/dom";
import { Frame } from "./base/frames";
import { Link, Listener, Message } from "./base/link";
import { seconds } from "./base/scale";
import { Theme } from "./base/theme";
import { Alarms } from "./machine/alarms";
import { Diagnosis } from "./machine/diagnosis";
import { Panel } from "./machine/panel";
import { Project } from "./machine/project";
import { Scope, eventOf, jobOf } from "./scope/scope";

const kKeys: [string, [string, string][]][] = [
  ["everywhere", [["1  2  3  4", "scope, axes, project, panel"], ["Esc", "stop all axes of the panel while one is held; else take the cursors away"], ["/", "search a signal; Enter takes the first, Shift+Enter into a new diagram"],
    ["T", "light or dark"], ["E", "alarms and events, or not"], ["?", "these keys"]]],
  ["time", [["Space", "stop the picture, or go on live"], ["+  −", "shorter or longer stretch"], ["Home", "all that is kept"], ["Backspace", "the stretch before; with Shift the one after"], ["N  P", "next or previous event"]]],
  ["measuring", [["A  B", "place a cursor in the middle, or make it the active one"], ["← →", "move the active cursor by a row, or the picture"], ["Shift ← →", "… by ten rows"], ["C  D", "cursors of values, in the chosen diagram"],
    ["↑ ↓", "fewer or more values in the chosen diagram"], ["V", "all values again"], ["M", "the table of what is measured, or not"]]],
  ["diagrams", [["I", "a further diagram"], ["Alt + frame", "zooms values, too"], ["wheel on an axis", "zooms its values; double click: all again"]]],
  ["panel", [["Space on Jog", "held: the axis moves"]]],
];

type Screen = "scope" | "axes" | "project" | "panel";

class Studio implements Listener {
  private readonly link = new Link(this);
  private readonly theme = new Theme(() => this.scope?.relabel());
  private readonly scope: Scope = new Scope(this.link, this.theme);
  private readonly alarms = new Alarms({ show: (t) => this.showMoment(t), acknowledge: null });
  private readonly diagnosis = new Diagnosis({
    search: (text, limit) => this.link.json(`api/signals?limit=${limit}&q=${encodeURIComponent(text)}`),
    read: (paths) => this.link.post("api/read", { paths }), describe: async (words) => (await this.link.optional(`api/describe/${words}`)).json(),
    show: (path) => this.showSignal(path), configure: (name) => { this.setScreen("project"); this.projectScreen.showObject(name); },
  });
  private readonly panel = new Panel({ ask: (message) => this.link.ask(message), held: () => this.showControl() });
  private readonly projectScreen = new Project({ link: this.link, show: (path) => this.showSignal(path), trigger: (path) => { this.setScreen("scope"); this.scope.triggerOn(path); },
    canWrite: () => this.rights.write === true, whyNotWrite: () => this.whyNot.write ?? "" });
  private rights: Record<string, boolean> = {};
  private whyNot: Record<string, string> = {};
  private run = "";
  private history: number | undefined;

  private readonly title = html("h1", {}, "Lockstep");
  private readonly clock = html("output", { class: "clock", "aria-label": "Time of the run" }, "–");
  private readonly state = html("p", { class: "state", role: "status" }, "connecting");
  private readonly bell = button("✓ 0", "Alarms and events (E)", () => this.toggleAlarms());
  private readonly stop = html("button", { type: "button", class: "stop", hidden: true, title: "Stops all axes of the panel, from every screen (Esc). It is no emergency stop.", click: () => this.panel.stop() }, "■ STOP", html("small", {}, "no emergency stop"));
  private readonly screens: Record<Screen, HTMLButtonElement> = {
    scope: button("Scope", "The oscilloscope (1)", () => this.setScreen("scope")), axes: button("Axes", "Axis diagnosis (2)", () => this.setScreen("axes")),
    project: button("Project", "The project (3)", () => this.setScreen("project")), panel: button("Panel", "The control panel (4)", () => this.setScreen("panel")),
  };
  private readonly control = html("p", { class: "control", role: "alert", hidden: true });
  private readonly controlSpace = html("div", { class: "control-space", hidden: true }, this.control);  // so that nothing moves when it comes
  private readonly dialog: HTMLDialogElement = html("dialog", { "aria-label": "Keys", class: "keys" }, html("h2", {}, "Keys"),
    html("div", { class: "key-groups" }, ...kKeys.map(([group, keys]) => html("section", {}, html("h3", {}, group), html("dl", {}, ...keys.flatMap(([key, text]) => [html("dt", {}, html("kbd", {}, key)), html("dd", {}, text)]))))),
    button("Close", "Close", () => this.dialog.close()));
  private readonly token = this.tokenForm();

  constructor() {
    document.getElementById("first")?.remove();  // what was seen until now
    document.body.append(this.header(), html("main", {}, this.scope.element, this.diagnosis.element, this.projectScreen.element, this.panel.element, this.alarms.element), this.dialog, this.token);
    this.setScreen("scope");
    document.addEventListener("keydown", (event) => this.key(event));
    if (!this.isExported()) this.link.connect();
    requestAnimationFrame(() => this.frame());
  }

  private header(): HTMLElement {
    return html("header", { class: "top" }, this.title, html("nav", { "aria-label": "Screens" }, ...Object.values(this.screens)), this.clock, this.controlSpace, this.state, this.bell, this.stop,
      button("◐", "Light or dark (T)", () => this.theme.toggle()), button("?", "Keys", () => this.dialog.showModal()));
  }

  /// A page that holds its own values, as the export writes it, asks no server.
  private isExported(): boolean {
    const kept = document.getElementById("lockstep-trace");
    if (!kept || !this.scope.open(kept.textContent ?? "")) return false;
    this.state.textContent = "saved values";
    for (const screen of ["axes", "project", "panel"] as const) this.screens[screen].hidden = true;
    return true;
  }

  private setScreen(screen: Screen): void {
    this.scope.element.hidden = screen !== "scope";
    this.diagnosis.setVisible(screen === "axes");
    this.projectScreen.setVisible(screen === "project");
    this.panel.element.hidden = screen !== "panel";
    for (const [name, one] of Object.entries(this.screens)) one.setAttribute("aria-current", String(name === screen));
    this.scope.dirty();
  }

  private toggleAlarms(): void {
    this.alarms.element.hidden = !this.alarms.element.hidden;
    document.body.classList.toggle("no-alarms", this.alarms.element.hidden);
    this.scope.dirty();
  }

  private showSignal(path: string): void { this.setScreen("scope"); this.scope.add(path, true); }
  private showMoment(t: number): void { this.setScreen("scope"); this.scope.moment(t); }

  private tokenForm(): HTMLDialogElement {
    const field = html("input", { type: "password", "aria-label": "Token", autocomplete: "off", required: true });
    const dialog = html("dialog", { "aria-label": "Token" }, html("p", {}, "This studio asks for a token."),
      field, button("Enter", "Enter", () => { this.link.setToken(field.value.trim()); dialog.close(); }));
    field.addEventListener("keydown", (event) => { if (event.key === "Enter") dialog.querySelector("button")?.click(); });
    return dialog;
  }

  // What comes from the server.

  async greeted(hello: Message): Promise<void> {
    const isNewRun = hello.run !== this.run;
    this.run = hello.run;
    const api = await this.link.json("api");
    const hasProject = api.mode !== "files";
    const project = hasProject ? await this.link.json("api/project") : { name: "traces", trace: [], objects: [], tags: [], instances: [] };
    for (const screen of ["axes", "panel"] as const) this.screens[screen].hidden = !hasProject;
    this.link.hasMore = api.rights?.simulation !== undefined;
    this.setRights(hello.rights ?? api.rights, hello.why_not ?? api.why_not);
    this.title.textContent = document.title = project.name;
    this.diagnosis.setObjects(project.objects.map(({ name }: { name: string }) => name));
    this.projectScreen.set(project);
    if (hello.panels) this.setPanels(hello.panels);
    this.askHistory(0);
    await this.scope.greeted(project, isNewRun);
  }

  private setRights(rights: any, whyNot: any): void {
    this.rights = Array.isArray(rights) ? Object.fromEntries(rights.map((right) => [right, true])) : rights ?? {};
    this.whyNot = whyNot ?? {};
    this.panel.setRights(this.rights.command === true, this.whyNot.command ?? "");
    this.alarms.notes.acknowledge = this.rights.command ? (source) => this.panel.reset(source) : null;
    this.alarms.draw();
    this.showControl();
  }

  private setPanels(panels: any[]): void {
    this.panel.set(panels);
    this.showControl();
  }

  /// A frame in signal colour while somebody moves the machine by hand.
  private showControl(): void {
    const isControlled = this.panel.isControlled;
    this.stop.hidden = !(this.panel.isThere && this.rights.command);
    this.controlSpace.hidden = !this.panel.isThere;
    this.control.hidden = !isControlled;
    document.body.classList.toggle("controlled", isControlled);
    if (isControlled) this.control.textContent = "⚠ The control panel moves the machine";
  }

  said(message: Message): void {
    const { type } = message;
    if (type === "event") this.askHistory(250);
    if (type === "shot") this.scope.caught({ id: message.id, reason: message.reason, t: Number(message.t) });
    if (type === "status") this.state.textContent = this.status(message);
    if (type === "panel") this.setPanels(message.panels);
    if (type === "trace") this.scope.told(message);
    if (type === "restarted") this.link.again();
  }

  rows(frame: Frame): void { this.scope.rows(frame); }

  lost(reason: string): void {
    this.state.textContent = reason || "connected";
    this.state.classList.toggle("lost", reason !== "");
    if (reason) this.panel.release();
  }

  tokenAsked(): void { if (!this.token.open) this.token.showModal(); }

  private status(message: Message): string {
    const lost = this.scope.lostRows + Number(message.events_lost ?? 0);
    return `● ${message.pages} page${message.pages === 1 ? "" : "s"}${lost ? `, ${lost} rows or events lost` : ""}`;
  }

  /// Jobs and events are asked for as a whole, so that what is a job is said in one place.
  private askHistory(delay: number): void {
    if (this.history !== undefined) return;
    this.history = window.setTimeout(async () => {
      this.history = undefined;
      const [jobs, events] = await Promise.all([this.link.json("api/jobs"), this.link.json("api/events")]).catch(() => [null, null]);
      if (!jobs || !events) return this.link.isOpen ? this.askHistory(1000) : undefined;
      const all = events.events.map(eventOf);
      const pending = events.pending.map(eventOf);
      this.alarms.set(pending, all);
      this.bell.textContent = pending.length ? `▼ ${pending.length} alarm${pending.length === 1 ? "" : "s"}` : "✓ no alarm";
      this.bell.classList.toggle("alarming", pending.length > 0);
      const bars = jobs.jobs.map(jobOf);
      this.diagnosis.setJobs(bars);
      this.scope.setHistory(bars, all);
    }, delay);
  }

  private frame(): void {
    requestAnimationFrame(() => this.frame());
    this.link.drawn();
    if (!this.scope.element.hidden) this.scope.frame();
    const text = this.scope.end ? seconds(this.scope.end, 1e8) + " s" : "–";
    if (this.clock.textContent !== text) this.clock.textContent = text;
  }

  // Keys.

  private escape(): void {
    // Stopping is free of everything; what one meant by the key else is done as well.
    if (this.panel.isThere && this.rights.command && (this.panel.isControlled || !this.panel.element.hidden)) this.panel.stop();
    this.scope.clearCursors();
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.altKey || event.metaKey || this.dialog.open || this.token.open) return;
    if (event.key === "Escape" && this.panel.isControlled) this.panel.stop();
    if (target instanceof HTMLInputElement || target instanceof HTMLSelectElement || target.closest(".popover") || (target.closest("button, summary, [role=tab]") && /^( |Enter)$/.test(event.key))) return;
    const { scope } = this;
    const size = event.shiftKey ? 10 : 1;
    const anywhere: Record<string, () => void> = {
      "/": () => { this.setScreen("scope"); scope.searchSignal(); }, t: () => this.theme.toggle(), e: () => this.toggleAlarms(), "?": () => this.dialog.showModal(), Escape: () => this.escape(),
      1: () => this.setScreen("scope"), 2: () => this.setScreen("axes"), 3: () => this.setScreen("project"), 4: () => this.setScreen("panel"),
    };
    const inScope: Record<string, () => void> = {
      " ": () => scope.toggleLive(), "+": () => scope.zoom(0.625), "-": () => scope.zoom(1.6), Home: () => scope.fit(), ArrowLeft: () => scope.step(-size), ArrowRight: () => scope.step(size),
      ArrowUp: () => scope.zoomValues(0.8), ArrowDown: () => scope.zoomValues(1.25), a: () => scope.cursor("A"), b: () => scope.cursor("B"), c: () => scope.valueCursor("C"), d: () => scope.valueCursor("D"),
      Backspace: () => (event.shiftKey ? scope.view.forward() : scope.view.back()), n: () => scope.jump(1), p: () => scope.jump(-1), v: () => scope.zoomValues(null), i: () => scope.newDiagram(),
      m: () => scope.dock.choose(scope.dock.chosen ? "" : "Cursors"),
    };
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const call = anywhere[key] ?? (scope.element.hidden ? undefined : inScope[key]);
    if (!call) return;
    event.preventDefault();
    call();
  }
}

new Studio();
