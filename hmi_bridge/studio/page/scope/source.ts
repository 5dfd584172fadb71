// A trace as the scope draws it: the run, a shot of a trigger, a file, what another page has saved.

import { decode } from "../base/frames";
import { Link } from "../base/link";
import { Recording, Signal } from "./record";
import { Span } from "./view";

const kPoints = 20000;       // of a window that is asked for at most, as the server has it
const kRowsOfPoint = 4;

export interface TraceInfo {
  id: string; name?: string; kind?: string; state?: string; progress?: number;
  signals: Signal[]; from: number; to: number; t?: number; reason?: string; rows?: number;
  error?: { message: string };  // of one that cannot be read
}

/// As /api/traces tells of a trace.
export function traceInfo(json: any): TraceInfo {
  return { ...json, signals: json.signals ?? [], from: Number(json.from ?? 0), to: Number(json.to ?? 0), t: json.t === undefined ? undefined : Number(json.t) };
}

/// Paths as a request names them: by commas, or one by one where a path has a comma itself.
export function signalsQuery(paths: string[]): string {
  if (!paths.some((path) => path.includes(","))) return "signals=" + paths.map(encodeURIComponent).join();
  return paths.map((path) => "signal=" + encodeURIComponent(path)).join("&");
}

/// Rows of signals of a trace, or points where there are many.
export async function fetchWindow(link: Link, id: string, signals: Signal[], span: Span | null, points = kPoints): Promise<Recording> {
  const record = new Recording(signals);
  if (!signals.length) return record;
  const part = span ? `&from=${Math.floor(span.from)}&to=${Math.ceil(span.to)}` : "";
  const response = await link.get(`api/traces/${id}/window?pixels=${points}&${signalsQuery(signals.map(({ path }) => path))}${part}`);
  record.append(decode(await response.arrayBuffer()));
  return record;
}

export class Source {
  record = new Recording([]);
  shift = 0;                       // by which it lies later than it was recorded [ns]
  private detail: { record: Recording; span: Span } | null = null;
  private isAsking = false;
  private asked: Span | null = null;

  /// @param isLive rows come by the WebSocket  @param link null: all is there already
  constructor(readonly info: TraceInfo, readonly isLive: boolean, private readonly link: Link | null) {}

  get id(): string { return this.info.id; }
  get name(): string { return this.info.name ?? (this.isLive ? "the run" : this.info.reason ? `${this.id} ${this.info.reason}` : this.id); }
  get begin(): number { return (this.isLive ? this.record.begin : this.info.from) + this.shift; }
  get end(): number { return (this.isLive ? this.record.end : this.info.to) + this.shift; }

  /// Gets all rows of the paths that it has, as points where they are many; derived ones are made by the server first.
  async load(paths: string[]): Promise<void> {
    if (this.isLive || !this.link) return;
    const signals: Signal[] = [];
    for (const path of paths) {
      const found = this.info.signals.find((signal) => signal.path === path);
      if (found) signals.push(found);
      else if (path.startsWith("=")) {
        const made = await this.link.post(`api/traces/${this.id}/derived`, { signal: path }).catch(() => null);
        if (made) signals.push({ path, type: made.type ?? "LREAL", unit: made.unit ?? "" });
      }
    }
    this.record = await fetchWindow(this.link, this.id, signals, null);
    this.detail = null;
  }

  /// What is drawn of a stretch: its rows if they have come, else points. Asks for rows where points are too coarse.
  recordFor(span: Span, changed: () => void): Recording {
    const own = { from: span.from - this.shift, to: span.to - this.shift };
    if (this.isLive || !this.link || !this.record.columns.some(({ low }) => low)) return this.record;
    const isWhole = own.from <= this.info.from && own.to >= this.info.to;
    if (this.detail && this.detail.span.from <= Math.max(own.from, this.info.from) && this.detail.span.to >= Math.min(own.to, this.info.to) &&
        this.detail.span.to - this.detail.span.from <= 6 * (own.to - own.from)) return this.detail.record;
    if (!isWhole) void this.ask(own, changed);
    return this.record;
  }

  private async ask(span: Span, changed: () => void): Promise<void> {
    const length = span.to - span.from;
    this.asked = { from: span.from - length, to: span.to + length };
    if (this.isAsking || !this.link) return;
    this.isAsking = true;
    try {
      while (this.asked) {
        const part: Span = this.asked;
        this.asked = null;
        const record = await fetchWindow(this.link, this.id, this.record.columns.map(({ path, type, unit }) => ({ path, type, unit })), part, kPoints / kRowsOfPoint);
        this.detail = { record, span: part };
        changed();
      }
    } catch {
      this.asked = null;
    } finally {
      this.isAsking = false;
    }
  }
}
