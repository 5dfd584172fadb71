// Jobs as bars: a lane for each object, as many rows in it as jobs go on at once; and events as marks above.

import { svg } from "../base/dom";
import { kLeft, kRight } from "./diagram";
import { Span } from "./view";

export interface Job {
  instance: string; type: string; object: string;
  begin: number; end: number;  // [ns]; Infinity: it goes on
  ended: string; text: string;
}

export interface Event { kind: string; t: number; source: string; number: number; text: string; [key: string]: any }

const kBar = 18;      // [px]
const kLane = 6;      // between objects
const kMarks = 16;    // of events, above
const kRebuild = 250; // of a live picture; between, it is moved [ms]
const kClutter = 400; // marks that are drawn at most

interface Placed { job: Job; row: number }

/// What a mark looks like, so that it is not told by its colour alone.
const kGlyphs: [RegExp, string, string][] = [
  [/^alarm$/, "alarm", "M0 0l-6 -11h12z"], [/acknow|reset|gone/, "done", "M-5 -10h10v10h-10z"], [/overrun|missed/, "warn", "M0 0l-5 -5l5 -6l5 6z"],
  [/failed/, "alarm", "M-5 -10l4 5l-4 5h3l2 -3l2 3h3l-4 -5l4 -5h-3l-2 3l-2 -3z"], [/aborted/, "warn", "M-5 -6h10v3h-10z"], [/done/, "done", "M-5 -5l3 5l7 -9l-2 -1l-5 6l-1 -3z"],
  [/started/, "runs", "M-3 0v-10l7 5z"],
];

export function isMark(kind: string): boolean { return !/command|written|write/.test(kind); }

export class Bars {
  private readonly moving = svg("g", { "clip-path": "url(#bars-clip)" });
  private readonly names = svg("g");
  private readonly clip = svg("rect", { x: kLeft, y: 0, height: 10000 });
  readonly element = svg("svg", { class: "bars", role: "group", "aria-label": "Jobs of the objects as bars, and events" },
    svg("defs", {}, svg("clipPath", { id: "bars-clip" }, this.clip)), this.moving, this.names);
  private lanes: { object: string; top: number; rows: number }[] = [];
  private placed: Placed[] = [];
  private events: Event[] = [];
  private height = kMarks;
  private namesOf = "";
  private builtAt = 0;
  private built: { span: Span; width: number } | null = null;
  private told = new WeakMap<Element, () => void>();  // what a shape stands for
  private pressed: (() => void) | undefined;          // a live picture may be built anew until one lets go

  /// @param choose an event or a job has been clicked
  constructor(private readonly choose: (t: number, text: string) => void) {
    const at = (event: globalThis.Event): (() => void) | undefined => this.told.get((event.target as Element).closest(".job, .event") ?? this.element);
    this.element.addEventListener("pointerdown", (event) => { this.pressed = at(event); });
    this.element.addEventListener("pointerup", () => { this.pressed?.(); this.pressed = undefined; });
    this.element.addEventListener("pointerleave", () => { this.pressed = undefined; });
    // What is clicked without a pointer.
    this.element.addEventListener("click", (event) => { if (event.detail === 0) at(event)?.(); });
  }

  set(jobs: Job[], events: Event[], objects: string[]): void {
    this.events = events.filter((event) => isMark(event.kind));
    this.placed = [];
    this.lanes = [];
    let top = kMarks;
    for (const object of [...objects, ""]) {
      const own = jobs.filter((job) => (objects.includes(job.object) ? job.object : "") === object);
      if (!own.length) continue;
      const ends: number[] = [];  // of the last job in each row
      for (const job of [...own].sort((a, b) => a.begin - b.begin)) {
        let row = ends.findIndex((end) => end <= job.begin);
        if (row < 0) row = ends.length;
        ends[row] = job.end;
        this.placed.push({ job, row: top + row * kBar });
      }
      this.lanes.push({ object: object || "other", top, rows: ends.length });
      top += ends.length * kBar + kLane;
    }
    this.height = top;
    this.element.setAttribute("height", String(top));
    this.built = null;
  }

  draw(span: Span, latest: number, isMoving: boolean): void {
    const width = this.element.clientWidth - kLeft - kRight;
    if (width <= 0) return;
    const now = performance.now();
    const same = this.built && this.built.width === width && Math.abs(this.built.span.to - this.built.span.from - (span.to - span.from)) < 1;
    if (isMoving && same && now - this.builtAt < kRebuild)
      return this.moving.firstElementChild?.setAttribute("transform", `translate(${((this.built!.span.from - span.from) / (span.to - span.from)) * width} 0)`);
    this.builtAt = now;
    this.built = { span: { ...span }, width };
    this.clip.setAttribute("width", String(width));
    const x = (t: number): number => kLeft + ((t - span.from) / (span.to - span.from)) * width;
    const shapes: SVGElement[] = [];
    const open = isMoving ? span.to + (span.to - span.from) : latest;  // what goes on is drawn beyond the edge
    for (const { job, row } of this.placed) {
      const from = x(job.begin);
      const to = x(Math.min(job.end, Math.max(open, job.begin)));
      if (to >= kLeft && from <= kLeft + 2 * width) shapes.push(this.bar(job, row, Math.max(from, kLeft - width), to));
    }
    for (const event of this.events.slice(-4 * kClutter)) {
      const at = x(event.t);
      if (at >= kLeft && at <= kLeft + width && shapes.length < kClutter) shapes.push(this.mark(event, at));
    }
    this.moving.replaceChildren(svg("g", {}, ...shapes));
    const key = this.lanes.map(({ object, top }) => `${object} ${top}`).join();
    if (key !== this.namesOf) {
      this.namesOf = key;
      this.names.replaceChildren(...this.lanes.map((lane) => svg("text", { class: "lane", x: kLeft - 6, y: lane.top + kBar - 6, "text-anchor": "end" },
        ...(lane.object.length > 10 ? [svg("title", {}, lane.object), lane.object.slice(0, 9) + "…"] : [lane.object]))));
    }
  }

  private bar(job: Job, row: number, from: number, to: number): SVGElement {
    const state = job.ended.replace("job ", "") || "goes on";
    const size = Math.max(to - from, 3);
    const label = `${job.instance} (${job.type})`;
    const seen = to - Math.max(from, kLeft);
    const text = seen > 7 * label.length ? label : seen > 7 * job.instance.length ? job.instance : "";
    const sign = { done: "✓ ", failed: "! ", aborted: "✕ " }[state] ?? "";
    const told = `${label}: ${state}${job.text ? ", " + job.text : ""}`;
    const shape = svg("g", { class: "job", "data-state": state, "data-instance": job.instance },
      svg("title", {}, told), svg("rect", { x: from, y: row + 1, width: size, height: kBar - 3, rx: 2 }),
      svg("text", { x: Math.max(from, kLeft) + 4, y: row + kBar - 6 }, text && seen > 7 * (text.length + 2) ? sign + text : text));
    this.told.set(shape, () => this.choose(job.begin, told));
    return shape;
  }

  private mark(event: Event, at: number): SVGElement {
    const [, kind, path] = kGlyphs.find(([pattern]) => pattern.test(event.kind)) ?? [null, "runs", "M-3 -8h6v6h-6z"];
    const text = `${event.source || "the run"}: ${event.kind}${event.number ? " " + event.number : ""}${event.text ? ", " + event.text : ""}`;
    const isTall = event.kind === "alarm";
    const shape = svg("g", { class: `event event-${kind}`, "data-kind": event.kind }, svg("title", {}, text),
      ...(isTall ? [svg("line", { x1: at, x2: at, y1: kMarks - 3, y2: this.height })] : []), svg("path", { transform: `translate(${at} ${kMarks - 3})`, d: path }));
    this.told.set(shape, () => this.choose(event.t, text));
    return shape;
  }
}
