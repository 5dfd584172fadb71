// What there is to draw: the run, shots of triggers, files. One is shown, others are laid over it, shifted in time, and compared.

import { button, html, renew } from "../base/dom";
import { Link, RequestError } from "../base/link";
import { duration, numberOf, seconds, short } from "../base/scale";
import { TraceInfo, signalsQuery, traceInfo } from "./source";

export interface TracesNotes {
  link: Link;
  show(id: string): void;
  /// laid over what is shown, or no more
  overlay(id: string, isOn: boolean): void;
  shift(id: string, by: number): void;
  paths(): string[];
  shown(): { id: string; shift: number };
  shiftOf(id: string): number;
  moment(t: number): void;
  /// a file of the page's own
  open(text: string, name: string): boolean;
}

const kRefresh = 500;  // [ms]

export class Traces {
  private readonly list = html("ul", { class: "traces", "aria-label": "Traces" });
  private readonly state = html("p", { class: "faint", role: "status" });
  private readonly file: HTMLInputElement = html("input", { type: "file", "aria-label": "Files to open", accept: ".csv,.lcm,.json,.html", multiple: true, hidden: true, change: () => void this.take(this.file.files) });
  private readonly path = html("input", { "aria-label": "File on the machine of the studio", placeholder: "or a path, at the desk", spellcheck: "false" });
  private readonly tolerance = html("input", { "aria-label": "Tolerance", inputmode: "decimal", value: "0" });
  private readonly differences = html("div", { class: "compare", "aria-live": "polite" });
  readonly element = html("section", { class: "traces-panel", "aria-label": "Traces and files" }, this.list,
    html("p", { class: "row" }, button("Open file…", "A trace (.csv, .lcm) or what this page has saved (.json); or drop it anywhere", () => this.file.click()), this.file, this.path),
    this.state, this.differences);
  private infos: TraceInfo[] = [];
  private overlays = new Set<string>();
  private ended = new Set<string>();  // files of which it has been told that they have been read, or cannot be
  private timer = 0;
  private turn = 0;

  constructor(private readonly notes: TracesNotes) {
    this.path.addEventListener("keydown", (event) => { if (event.key === "Enter") void this.byPath(); });
    window.addEventListener("dragover", (event) => { if (event.dataTransfer?.types.includes("Files")) { event.preventDefault(); document.body.classList.add("dropping"); } });
    window.addEventListener("dragleave", (event) => { if (!event.relatedTarget) document.body.classList.remove("dropping"); });
    window.addEventListener("drop", (event) => {
      document.body.classList.remove("dropping");
      if (!event.dataTransfer?.files.length) return;
      event.preventDefault();
      void this.take(event.dataTransfer.files);
    });
  }

  info(id: string): TraceInfo | undefined { return this.infos.find((one) => one.id === id); }
  add(info: TraceInfo): void { this.infos = [...this.infos.filter(({ id }) => id !== info.id), info]; this.draw(); }

  /// What the server has. Those that only the page has stay.
  async refresh(): Promise<void> {
    const turn = ++this.turn;
    const { traces } = await this.notes.link.json("api/traces");
    if (turn !== this.turn) return;  // a later answer knows more
    const own = this.infos.filter(({ kind }) => kind === "page");
    this.infos = [...traces.map(traceInfo), ...own];
    this.draw();
  }

  /// Another run, in which files are numbered anew.
  restart(): void { this.ended.clear(); }

  /// A file is being read, or has been.
  told(message: any): void {
    const name = message.name ?? message.id;
    if (this.ended.has(message.id)) return;
    if (message.state !== "loading") this.ended.add(message.id);
    if (message.state === "loading") this.state.textContent = `${name}: ${Math.round(100 * (message.progress ?? 0))} %`;
    if (message.state === "failed") this.state.textContent = `${name}: ${message.error?.message ?? "cannot be read"}`;
    if (message.state === "ready") {
      this.state.textContent = "";
      // A further trace of a log does not take the picture from the one that was opened.
      void this.refresh().then(() => { if (!message.of) this.notes.show(message.id); });
    }
  }

  private async take(files: FileList | null): Promise<void> {
    for (const file of files ?? []) {
      try {
        this.state.textContent = `${file.name} is sent`;
        if (/\.(json|html?)$/.test(file.name)) {
          this.state.textContent = this.notes.open(await file.text(), file.name) ? "" : `${file.name} is nothing that this page has saved`;
          continue;
        }
        const { id } = await this.notes.link.send(`api/traces?name=${encodeURIComponent(file.name)}`, file, /\.csv$/.test(file.name) ? "text/csv" : "application/octet-stream");
        // What has become of it may be told before the answer to its sending has come.
        if (!this.ended.has(id)) this.state.textContent = `${file.name} is read`;
        await this.refresh();
        this.poll(id);
      } catch (error) {
        this.state.textContent = error instanceof RequestError && error.status === 404 ? "This studio takes no files." : `${file.name}: ${(error as Error).message}`;
      }
    }
    this.file.value = "";
  }

  private async byPath(): Promise<void> {
    try {
      const { id } = await this.notes.link.post("api/traces", { path: this.path.value.trim() });
      this.poll(id);
    } catch (error) {
      this.state.textContent = (error as Error).message;
    }
  }

  /// Until a file has been read, in case that nobody says so.
  private poll(id: string): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(async () => {
      await this.refresh().catch(() => undefined);
      const info = this.info(id);
      if (info?.state === "loading") this.poll(id);
      else if (info) this.told(info);
    }, kRefresh);
  }

  setOverlays(ids: string[]): void { this.overlays = new Set(ids); this.draw(); }

  private draw(): void {
    const shown = this.notes.shown().id;
    const order = (info: TraceInfo): number => (info.id === "live" ? 0 : info.kind === "file" || info.kind === "page" ? 1 : 2);
    const sorted = [...this.infos].sort((a, b) => order(a) - order(b) || (b.t ?? 0) - (a.t ?? 0)).slice(0, 60);
    renew(this.list, sorted.map((info) => this.item(info, info.id === shown)));
  }

  private item(info: TraceInfo, isShown: boolean): HTMLElement {
    const isShot = info.id.startsWith("shot");
    const name = info.id === "live" ? "the run" : isShot ? `${seconds(info.t ?? 0, 1e6)} s ${info.reason ?? ""}` : info.name ?? info.id;
    const state = info.state === "loading" ? ` ${Math.round(100 * (info.progress ?? 0))} %` : info.state === "failed" ? ` cannot be read: ${info.error?.message ?? "for no reason that is known"}` : "";
    const over = html("input", { type: "checkbox", "aria-label": `Lay ${name} over what is shown`, title: "lay over", checked: this.overlays.has(info.id), disabled: isShown, change: () => {
      if (over.checked) this.overlays.add(info.id); else this.overlays.delete(info.id);
      this.notes.overlay(info.id, over.checked);
      this.draw();
    } });
    const choose = html("button", { type: "button", "data-shot": info.id, "data-trace": info.id, "aria-pressed": String(isShown), click: () => this.notes.show(info.id) }, name + state);
    const tools: HTMLElement[] = [over, choose];
    if (info.id !== "live" && info.kind !== "page") tools.push(button("×", `Forget ${name}`, () => void this.forget(info.id)));
    const shift = html("input", { class: "shift", inputmode: "decimal", "aria-label": `Shift of ${name} [ms]`, value: short(this.notes.shiftOf(info.id) / 1e6, 9), change: () => {
      const by = numberOf(shift.value);
      if (isFinite(by)) this.notes.shift(info.id, by * 1e6);
    } });
    const below = !isShown && this.overlays.has(info.id)
      ? [html("p", { class: "row" }, html("label", {}, "shift [ms] ", shift), html("label", {}, "± ", this.tolerance), button("Compare", "With what is shown: differences and the first one", () => void this.compare(info.id)))] : [];
    return html("li", { class: isShown ? "shown" : "" }, html("div", { class: "row" }, ...tools), ...below);
  }

  private async forget(id: string): Promise<void> {
    await this.notes.link.remove(`api/traces/${id}`).catch((error) => { this.state.textContent = error.message; });
    this.overlays.delete(id);
    this.notes.overlay(id, false);
    if (this.notes.shown().id === id) this.notes.show("live");
    await this.refresh();
  }

  /// The server compares row by row; what the page has saved is not the server's.
  private async compare(id: string): Promise<void> {
    const shown = this.notes.shown();
    const paths = this.notes.paths().filter((path) => this.info(id)?.signals.some((signal) => signal.path === path) || path.startsWith("="));
    try {
      // A row of the other at t + shift belongs to that of the shown at t.
      const shift = Math.round(shown.shift - this.notes.shiftOf(id));
      const answer = await this.notes.link.json(`api/compare?a=${shown.id}&b=${id}&${signalsQuery(paths)}&shift=${shift}&tolerance=${numberOf(this.tolerance.value) || 0}`);
      this.showDifferences(answer, id);
    } catch (error) {
      this.differences.replaceChildren(html("p", { class: "lost" }, (error as Error).message));
    }
  }

  private showDifferences(answer: any, id: string): void {
    const { shift } = this.notes.shown();
    const moment = (t: string): HTMLElement => button(seconds(Number(t) + shift, 1e5) + " s", "Show this moment", () => this.notes.moment(Number(t) + shift));
    const first = answer.first ? [html("p", { class: "lost" }, `first difference: ${answer.first.path}, tick ${answer.first.tick}, `, moment(answer.first.t))] : [html("p", { class: "same" }, "✓ no difference")];
    this.differences.replaceChildren(html("h3", {}, `${this.notes.shown().id} and ${id}: ${answer.rows} rows`), ...first,
      ...(answer.only_a || answer.only_b ? [html("p", { class: "faint" }, `without a partner: ${answer.only_a} and ${answer.only_b} rows`)] : []),
      html("table", { class: "numbers" }, html("thead", {}, html("tr", {}, ...["signal", "rows that differ", "first", "by at most"].map((head) => html("th", { scope: "col" }, head)))),
        html("tbody", {}, ...answer.signals.map((one: any) => html("tr", {}, html("th", { scope: "row" }, one.path), html("td", {}, String(one.different)), html("td", {}, one.first ? moment(one.first.t) : "–"),
          html("td", {}, one.maximum ? short(Number(one.maximum.difference), 6) : "–"))))));
  }

  /// A trace lies so that its occasion is that of another.
  aligned(id: string, other: TraceInfo | undefined): number {
    const info = this.info(id);
    return info?.t !== undefined && other?.t !== undefined ? other.t - info.t : 0;
  }

  describe(): string { return this.infos.map(({ id, from, to }) => `${id} ${duration(to - from)}`).join(", "); }
}
