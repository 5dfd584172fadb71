// Which object follows which: as a graph in layers and as a table.

import { html, svg } from "../base/dom";
import { LiveCells } from "./tables";

export interface Coupling { following: string; leading: string; kind?: string; RatioNumerator?: string; RatioDenominator?: string; Cam?: string; instance?: string; block?: string; cam?: string; possible?: boolean; coupling?: string; area?: string; remote?: "leading" | "following"; delay?: string }

const kBox = { width: 150, height: 44, gapX: 40, gapY: 60 };

/// What a coupling does, as the block and its pins say.
function kindOf(one: Coupling): string {
  if (one.kind) return one.kind;
  if (one.area) return "transfer area";
  if (!one.block && one.coupling) return `${one.coupling} coupling`;
  if (/Cam/.test(one.block ?? "")) return "cam";
  if (/Velocity/.test(one.block ?? "")) return "velocity gear";
  return /Gear/.test(one.block ?? "") ? "gear" : one.block ?? "";
}
function functionOf(one: Coupling): string {
  const cam = one.Cam ?? one.cam;
  if (cam) return cam;
  return one.RatioNumerator || one.RatioDenominator ? `${one.RatioNumerator ?? 1} : ${one.RatioDenominator ?? 1}` : "";
}

/// The layer of each object: one below the lowest of those that it follows. Couplings that go round end there.
export function layersOf(objects: string[], couplings: Coupling[]): Map<string, number> {
  const layers = new Map<string, number>();
  const layer = (name: string, above: string[]): number => {
    const known = layers.get(name);
    if (known !== undefined) return known;
    if (above.includes(name)) return 0;
    const own = couplings.filter(({ following, leading }) => following === name && leading !== name).map(({ leading }) => layer(leading, [...above, name]) + 1);
    const found = Math.max(0, ...own);
    if (!above.length || own.length) layers.set(name, found);
    return found;
  };
  for (const name of objects) layers.set(name, layer(name, []));
  return layers;
}

/// All that an object may follow, whichever way.
function sourcesOf(name: string, couplings: Coupling[], found = new Set<string>()): Set<string> {
  for (const { following, leading } of couplings)
    if (following === name && !found.has(leading)) sourcesOf(leading, couplings, found.add(leading));
  return found;
}

/// With all couplings active, the leading object would follow its own leading value.
export function isRecursive({ following, leading }: Coupling, couplings: Coupling[]): boolean {
  return leading === following || sourcesOf(leading, couplings).has(following);
}

/// Every way from an object back to where its leading value comes from, but for those that go round (10.6.3).
export function routesOf(name: string, couplings: Coupling[], below: string[] = []): string[][] {
  const leading = [...new Set(couplings.filter((one) => one.following === name).map((one) => one.leading))];
  if (!leading.length) return [[name]];
  return leading.filter((one) => one !== name && !below.includes(one)).flatMap((one) => routesOf(one, couplings, [...below, name])).map((route) => [name, ...route]);
}

type State = "possible" | "waits" | "synchronizing" | "synchronous";
const kSigns: Record<State, string> = { possible: "○ possible", waits: "… waits", synchronizing: "▷ synchronizing", synchronous: "▶ synchronous" };

/// What outputs of its block say. One without StartSync synchronizes as soon as it is at work.
function stateOf(pins: Map<string, unknown>): State {
  if (pins.get("InSync") === true || pins.get("InGear") === true) return "synchronous";
  if (pins.get("Busy") !== true) return "possible";
  return pins.get("StartSync") === false ? "waits" : "synchronizing";
}

export class Couplings {
  private readonly picture = svg("svg", { class: "graph", role: "img", "aria-label": "Which object follows which" });
  private readonly body = html("tbody");
  readonly element = html("section", { "aria-label": "Interconnection overview" }, this.picture,
    html("table", {}, html("caption", {}, "Couplings"), html("thead", {}, html("tr", {}, ...["following", "leading", "kind", "function or cam", "by", "state", "outputs", "delay [s]", "route of the leading value"].map((head) => html("th", { scope: "col" }, head)))), this.body));
  private edges = new Map<string, SVGElement>();
  private states = new Map<string, { element: HTMLElement; pins: Map<string, unknown> }>();  // by instance

  /// @param cells shows what couplings do now
  set(here: { name: string; type?: string }[], couplings: Coupling[], cells: LiveCells, isTold = true): void {
    const elsewhere = new Set(couplings.flatMap((one) => (one.remote ? [one[one.remote]] : [])));
    const objects = [...here, ...[...elsewhere].map((name) => ({ name, type: "another controller" }))];
    const layers = layersOf(objects.map(({ name }) => name), couplings);
    const places = new Map<string, { x: number; y: number }>();
    const count = new Map<number, number>();
    for (const { name } of objects) {
      const layer = layers.get(name) ?? 0;
      const at = count.get(layer) ?? 0;
      count.set(layer, at + 1);
      places.set(name, { x: 10 + at * (kBox.width + kBox.gapX), y: 10 + layer * (kBox.height + kBox.gapY) });
    }
    const width = Math.max(...[...places.values()].map(({ x }) => x + kBox.width + 10), 100);
    const height = Math.max(...[...places.values()].map(({ y }) => y + kBox.height + 10), 60);
    this.picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.picture.setAttribute("width", String(width));
    this.picture.setAttribute("height", String(height));
    this.edges.clear();
    const names = new Set(objects.map(({ name }) => name));
    const edges = couplings.filter(({ following, leading }) => names.has(following) && names.has(leading)).map((one) => this.edge(one, places));
    this.picture.replaceChildren(svg("defs", {}, svg("marker", { id: "arrow", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 10, markerHeight: 10, markerUnits: "userSpaceOnUse", orient: "auto" }, svg("path", { d: "M0 0l8 4l-8 4z", class: "arrow" }))), ...edges,
      ...objects.map(({ name, type }) => {
        const { x, y } = places.get(name)!;
        return svg("g", { class: elsewhere.has(name) ? "node elsewhere" : "node", "data-object": name }, svg("title", {}, name), svg("rect", { x, y, width: kBox.width, height: kBox.height, rx: 6 }), svg("text", { x: x + kBox.width / 2, y: y + 19, "text-anchor": "middle", class: "node-name" }, name.length > 19 ? name.slice(0, 18) + "…" : name),
          svg("text", { x: x + kBox.width / 2, y: y + 35, "text-anchor": "middle", class: "tick" }, type ?? ""));
      }));
    this.states.clear();
    this.body.replaceChildren(...couplings.map((one) => this.row(one, couplings, cells)));
    if (!couplings.length) this.body.replaceChildren(html("tr", {}, html("td", { colspan: 9 }, isTold ? "No object follows another." : "This studio does not tell what follows what.")));
  }

  private row(one: Coupling, couplings: Coupling[], cells: LiveCells): HTMLElement {
    const isRound = isRecursive(one, couplings);
    const state = html("output", { class: "coupling-state", "data-state": "possible" }, kSigns.possible);
    const outputs = one.instance ? ["Busy", ...(one.block === "MC_GearIn" ? ["InGear"] : ["StartSync", "InSync"])] : [];
    if (one.instance) this.states.set(one.instance, { element: state, pins: new Map() });
    return html("tr", { "data-coupling": `${one.leading} ${one.following}`, class: isRound ? "recursive" : "" }, html("th", { scope: "row" }, one.following), html("td", {}, one.leading),
      html("td", {}, kindOf(one), ...(isRound ? [html("span", { class: "sign", title: "With all couplings active, the leading object would follow its own leading value" }, " ↻ recursive")] : [])),
      html("td", {}, functionOf(one)), html("td", {}, one.instance ? `${one.instance} (${one.block ?? ""})` : one.area ?? "the project"), html("td", {}, ...(one.area ? [] : [state])),
      html("td", {}, ...outputs.flatMap((pin) => [html("span", { class: "unit" }, pin + " "), cells.cell(`${one.instance}.${pin}`), " "])),
      html("td", {}, ...(one.delay ? [cells.cell(one.delay)] : [])),
      html("td", { class: "route" }, routesOf(one.leading, couplings, [one.following]).map((route) => [one.following, ...route].join(" ← ")).join("; ") || "none: it goes round"));
  }

  private edge(one: Coupling, places: Map<string, { x: number; y: number }>): SVGElement {
    const from = places.get(one.leading)!;
    const to = places.get(one.following)!;
    const a = { x: from.x + kBox.width / 2, y: from.y + kBox.height };
    const b = { x: to.x + kBox.width / 2, y: to.y };
    const path = b.y > a.y ? `M${a.x} ${a.y}C${a.x} ${a.y + 30} ${b.x} ${b.y - 30} ${b.x} ${b.y}` : `M${a.x} ${a.y}C${a.x + 120} ${a.y + 40} ${b.x + 120} ${b.y - 40} ${b.x} ${b.y}`;
    const edge = svg("g", { class: "edge" + (one.instance || one.area ? "" : " possible") }, svg("title", {}, `${one.following} follows ${one.leading}: ${kindOf(one)} ${functionOf(one)}`), svg("path", { d: path, "marker-end": "url(#arrow)" }),
      svg("text", { class: "tick", x: (a.x + b.x) / 2 + 6, y: (a.y + b.y) / 2 + 4 }, `${one.instance ?? one.area ?? ""} ${kindOf(one)} ${functionOf(one)}`.trim()));
    if (one.instance) this.edges.set(one.instance, edge);
    return edge;
  }

  /// What a coupling does now: waits, runs or is synchronous.
  told(path: string, value: unknown): void {
    const dot = path.lastIndexOf(".");
    const instance = path.slice(0, dot);
    const edge = this.edges.get(instance);
    const pin = path.slice(dot + 1);
    const told = this.states.get(instance);
    if (told) {
      told.pins.set(pin, value);
      const state = stateOf(told.pins);
      told.element.textContent = kSigns[state];
      told.element.dataset.state = state;
    }
    if (edge && /^(Busy|InSync|InGear)$/.test(pin)) edge.classList.toggle(pin === "Busy" ? "busy" : "synchronous", value === true);
  }
}
