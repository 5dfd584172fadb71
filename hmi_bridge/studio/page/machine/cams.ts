// The cams of a project, and cam files: what they are made of, and their curves as the product itself computes them.

import { chart, chartAxis } from "../base/chart";
import { html, svg } from "../base/dom";
import { Link } from "../base/link";
import { short } from "../base/scale";

export interface Cam { name: string; type: string; file?: string }

const kSamples = 1001;
const kCurves = ["following value", "velocity", "acceleration", "jerk"];

/// A number of an answer, which has "inf" and "nan" as texts.
const numberIn = (value: unknown): number => (value === "inf" ? Infinity : value === "-inf" ? -Infinity : typeof value === "number" ? value : NaN);

export class Cams {
  private readonly choice = html("select", { "aria-label": "Cam", change: () => void this.show() });
  private readonly about = html("p", { class: "faint", role: "status" });
  private readonly findings = html("ul", { class: "checks", "aria-label": "What is wrong with the cam" });
  private readonly charts = html("div", { class: "cam-charts" });
  private readonly extremes = html("tbody");
  private readonly stretches = html("tbody");
  private readonly tables = html("div", { class: "beside" },
    html("table", { class: "numbers" }, html("caption", {}, "Extremes"), html("thead", {}, html("tr", {}, ...["", "minimum", "maximum"].map((head) => html("th", { scope: "col" }, head)))), this.extremes),
    html("table", { class: "numbers" }, html("caption", {}, "Elements"), html("thead", {}, html("tr", {}, ...["element", "from", "to", "points", "segments"].map((head) => html("th", { scope: "col" }, head)))), this.stretches));
  readonly element = html("section", { class: "cams", "aria-label": "Cams" }, html("p", { class: "row" }, html("label", {}, "Cam ", this.choice), this.about), this.findings, this.charts, this.tables);
  private turn = 0;

  constructor(private readonly link: Link) {}

  async load(): Promise<void> {
    const { cams } = (await this.link.json("api/cams")) as { cams: Cam[] };
    const before = this.choice.value;
    this.choice.replaceChildren(...cams.map(({ name, type }) => html("option", { value: name }, type === "file" ? name : `${name} (${type})`)));
    if (cams.some(({ name }) => name === before)) this.choice.value = before;
    this.about.textContent = cams.length ? "" : "There is no cam.";
    this.tables.hidden = !cams.length;
    if (cams.length) await this.show();
  }

  private async show(): Promise<void> {
    const turn = ++this.turn;
    const cam = await this.link.json(`api/cams/${encodeURIComponent(this.choice.value)}?curves=${kSamples}`);
    if (turn !== this.turn) return;
    const findings = [...cam.problems.map((one: any) => ["✕", one]), ...cam.warnings.map((one: any) => ["!", one])];
    this.findings.replaceChildren(...findings.map(([sign, one]: any) => html("li", {}, `${sign} `, html("code", {}, one.place ?? ""), " ", one.text)));
    const hasCurves = cam.curves !== undefined;
    this.tables.hidden = !hasCurves;
    this.about.textContent = hasCurves ? `${cam.description ? cam.description + ". " : ""}Leading values from ${short(cam.start, 7)} to ${short(cam.end, 7)}, ${cam.points} points, ${cam.segments} segments` : "It has no curve.";
    this.charts.replaceChildren(...(hasCurves ? kCurves.map((name) => this.chart(name, cam.curves)) : []));
    this.extremes.replaceChildren(...Object.entries<any>(cam.extremes ?? {}).map(([name, [low, high]]) => html("tr", {}, html("th", { scope: "row" }, name), html("td", {}, short(numberIn(low), 7)), html("td", {}, short(numberIn(high), 7)))));
    this.stretches.replaceChildren(...(cam.elements ?? []).map((one: any) => html("tr", {}, html("th", { scope: "row" }, one.kind), html("td", {}, short(one.from, 7)), html("td", {}, short(one.to, 7)), html("td", {}, String(one.points)), html("td", {}, String(one.segments)))));
  }

  private chart(name: string, curves: Record<string, unknown[]>): SVGElement {
    const picture = svg("svg", { class: "chart", role: "img", "aria-label": `${name} over the leading value`, "data-curve": name, width: 560, height: 220, viewBox: "0 0 560 220" });
    const [xs, ys] = [curves.x.map(numberIn), curves[name].map(numberIn)];
    picture.append(...chart(560, 220, xs, ys, { label: "leading value", low: xs[0], high: xs[xs.length - 1] }, chartAxis(name, ys), []));
    return picture;
  }
}
