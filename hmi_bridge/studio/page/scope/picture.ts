// The picture as a file: SVG with what stands in the diagrams, and PNG drawn from it.

import { save, svg } from "../base/dom";
import { seconds, short, ticks } from "../base/scale";
import { Diagram, Scene, kLeft, kRight } from "./diagram";
import { Line } from "./layout";
import { Column, Recording } from "./record";
import { Span } from "./view";

const kHeight = 220;   // of a diagram
const kWidth = 1200;
const kPoints = 4000;  // of a line, at most two for each column of pixels that a printer has

/// A line through all rows, or through the extremes of stretches where there are many.
function pathOf(record: Recording, column: Column, span: Span, x: (t: number) => number, y: (v: number) => number, wrap: number): string {
  const from = Math.max(record.rowAt(span.from) - 1, 0);
  const to = Math.min(record.rowAt(span.to) + 1, record.size);
  const step = Math.max(Math.ceil((2 * (to - from)) / kPoints), 1);
  let path = "";
  let isDown = false;
  let last = NaN;
  const point = (row: number): void => {
    const value = column.value[row];
    if (record.breaks[row] || !(Math.abs(value - last) <= wrap)) isDown = false;
    if (value === value) path += `${isDown ? "L" : "M"}${x(record.t[row]).toFixed(2)} ${y(value).toFixed(2)}`;
    isDown = value === value;
    last = value;
  };
  for (let row = from; row < to; row += step) {
    let low = row;
    let high = row;
    for (let other = row; other < Math.min(row + step, to); ++other) {
      if (column.value[other] < column.value[low]) low = other;
      if (column.value[other] > column.value[high]) high = other;
    }
    point(Math.min(low, high));
    if (low !== high) point(Math.max(low, high));
  }
  return path;
}

/// All diagrams as one SVG document, black on white.
export function pictureOf(title: string, diagrams: Diagram[], scene: Scene, colour: (line: Line) => string): string {
  const { span } = scene;
  const width = kWidth - kLeft - kRight;
  const x = (t: number): number => kLeft + ((t - span.from) / (span.to - span.from)) * width;
  const bottom = 30 + diagrams.length * (kHeight + 30);
  const root = svg("svg", { xmlns: "http://www.w3.org/2000/svg", width: kWidth, height: bottom + 30, "font-family": "sans-serif", "font-size": 12 },
    svg("title", {}, title), svg("rect", { width: "100%", height: "100%", fill: "#ffffff" }));
  diagrams.forEach((diagram, i) => {
    const top = 30 + i * (kHeight + 30);
    const first = scene.sources[0].record;
    const units = diagram.units(first);
    const drawAxis = (unit: string, isLeft: boolean): void => {
      const { low, high } = diagram.rangeOf(unit);
      for (const value of ticks(low, high, 6))
        root.append(svg("text", { x: isLeft ? kLeft - 6 : kLeft + width + 6, y: top + ((high - value) / (high - low)) * kHeight + 4, "text-anchor": isLeft ? "end" : "start" }, short(value)));
    };
    root.append(svg("clipPath", { id: "plot" + i }, svg("rect", { x: kLeft, y: top, width, height: kHeight })),
      svg("rect", { x: kLeft, y: top, width, height: kHeight, fill: "none", stroke: "#888888" }));
    units.slice(0, 2).forEach((unit, side) => drawAxis(unit, side === 0));
    let at = kLeft;
    for (const [order, source] of scene.sources.entries()) {
      const record = source.recordFor(span, () => undefined);
      const own = { from: span.from - source.shift, to: span.to - source.shift };
      for (const line of diagram.lines.filter(({ isVisible }) => isVisible)) {
        const column = record.column(line.path);
        if (!column) continue;
        const range = units.includes(column.unit) && column.type !== "BOOL" ? diagram.rangeOf(column.unit) : { low: -0.1, high: 1.1 };
        const y = (value: number): number => top + ((range.high - (value * line.scale + line.offset)) / (range.high - range.low)) * kHeight;
        root.append(svg("path", { d: pathOf(record, column, own, (t) => x(t + source.shift), y, scene.wrap(line.path)), fill: "none", stroke: colour(line), "clip-path": `url(#plot${i})`,
          "stroke-width": order ? 0.7 : line.width * 0.7, ...(order || line.dash ? { "stroke-dasharray": "4 3" } : {}) }));
        if (order) continue;
        const label = column.unit ? `${line.path} [${column.unit}]` : line.path;
        root.append(svg("text", { x: at, y: top - 6, fill: colour(line) }, label));
        at += 8 * label.length + 16;
      }
    }
  });
  const times = ticks(span.from, span.to, 10);
  for (const t of times)
    root.append(svg("text", { x: x(t), y: bottom + 4, "text-anchor": "middle" }, seconds(t, times.length > 1 ? times[1] - times[0] : 1e9) + " s"));
  return new XMLSerializer().serializeToString(root);
}

export function saveSvg(picture: string, name: string): void { save(new Blob([picture], { type: "image/svg+xml" }), name + ".svg"); }

export async function savePng(picture: string, name: string): Promise<void> {
  const address = URL.createObjectURL(new Blob([picture], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = 2 * image.width;
    canvas.height = 2 * image.height;
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => { if (blob) save(blob, name + ".png"); });
  } finally {
    URL.revokeObjectURL(address);
  }
}
