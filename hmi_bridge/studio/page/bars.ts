// Jobs as bars: a lane for each object, as many rows in it as jobs go on at once; and events as marks.

import { svg } from "./dom";
import { kLeft, kRight } from "./diagram";
import { Span } from "./view";

export interface Job {
  instance: string; type: string; object: string;
  begin: number; end: number;  // [ns]; Infinity: it goes on
  ended: string; text: string;
}

export interface Event { kind: string; t: number; source: string; number: number; text: string; [key: string]: any }

const kBar = 18;   // [px]
const kLane = 6;   // between objects

interface Placed { job: Job; row: number }

export class Bars {
  readonly element = svg("svg", { class: "bars", role: "img", "aria-label": "Jobs of the objects as bars" });
  private lanes: { object: string; top: number; rows: number }[] = [];
  private placed: Placed[] = [];
  private events: Event[] = [];
  private height = 0;

  set(jobs: Job[], events: Event[], objects: string[]): void {
    this.events = events.filter((event) => event.kind === "alarm" || event.kind.includes("overrun"));
    this.placed = [];
    this.lanes = [];
    let top = kBar;  // marks of events stand above
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
  }

  draw(span: Span, latest: number): void {
    const width = this.element.clientWidth - kLeft - kRight;
    const x = (t: number): number => kLeft + ((t - span.from) / (span.to - span.from)) * width;
    const shapes: SVGElement[] = [];
    for (const { job, row } of this.placed) {
      const from = Math.max(x(job.begin), kLeft);
      const to = Math.min(x(Math.min(job.end, Math.max(latest, job.begin))), kLeft + width);
      if (to < kLeft || from > kLeft + width) continue;
      const state = job.ended.replace("job ", "") || "goes on";
      const size = Math.max(to - from, 3);
      const label = `${job.instance} (${job.type})`;
      shapes.push(svg("g", { class: "job", "data-state": state, "data-instance": job.instance },
        svg("title", {}, `${label}: ${state}${job.text ? ", " + job.text : ""}`),
        svg("rect", { x: from, y: row + 1, width: size, height: kBar - 3, rx: 2 }),
        svg("text", { x: from + 4, y: row + kBar - 6 }, size > 7 * label.length ? label : size > 7 * job.instance.length ? job.instance : "")));
    }
    for (const event of this.events) {
      const at = x(event.t);
      if (at < kLeft || at > kLeft + width) continue;
      shapes.push(svg("g", { class: "event" }, svg("title", {}, `${event.source || "the run"}: ${event.kind} ${event.number} ${event.text}`),
        svg("path", { d: `M${at} ${kBar - 4}l-5 -9h10z` }), svg("line", { x1: at, x2: at, y1: kBar - 4, y2: this.height })));
    }
    for (const lane of this.lanes)
      shapes.push(svg("text", { class: "lane", x: kLeft - 6, y: lane.top + kBar - 6, "text-anchor": "end" }, lane.object));
    this.element.replaceChildren(...shapes);
  }
}
