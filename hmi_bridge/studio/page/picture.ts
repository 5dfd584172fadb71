// The picture as a file: SVG with what stands in the diagrams, and PNG drawn from it.

import { save, svg } from "./dom";
import { Diagram, kLeft, kRight } from "./diagram";
import { Column, Recording } from "./record";
import { seconds, short, ticks } from "./scale";
import { Span } from "./view";

const kHeight = 220;   // of a diagram
const kWidth = 1200;
const kPoints = 4000;  // of a line, at most two for each column of pixels that a printer has

/// A line through all rows, or through the extremes of stretches where there are many.
function lineOf(record: Recording, column: Column, span: Span, x: (t: number) => number, y: (v: number) => number, wrap: number): string {
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
export function pictureOf(title: string, diagrams: Diagram[], record: Recording, span: Span,
                          colour: (path: string) => string, wrap: (path: string) => number): string {
  const width = kWidth - kLeft - kRight;
  const x = (t: number): number => kLeft + ((t - span.from) / (span.to - span.from)) * width;
  const bottom = 30 + diagrams.length * (kHeight + 30);
  const root = svg("svg", { xmlns: "http://www.w3.org/2000/svg", width: kWidth, height: bottom + 30, "font-family": "sans-serif", "font-size": 12 },
    svg("title", {}, title), svg("rect", { width: "100%", height: "100%", fill: "#ffffff" }));
  diagrams.forEach((diagram, i) => {
    const top = 30 + i * (kHeight + 30);
    const [low, high] = diagram.range;
    const y = (value: number): number => top + ((high - value) / (high - low)) * kHeight;
    root.append(svg("clipPath", { id: "plot" + i }, svg("rect", { x: kLeft, y: top, width, height: kHeight })),
      svg("rect", { x: kLeft, y: top, width, height: kHeight, fill: "none", stroke: "#888888" }));
    for (const value of ticks(low, high, 6))
      root.append(svg("text", { x: kLeft - 6, y: y(value) + 4, "text-anchor": "end" }, short(value)));
    let at = kLeft;
    for (const path of diagram.paths) {
      const column = record.column(path);
      if (!column) continue;
      const label = column.unit ? `${path} [${column.unit}]` : path;
      root.append(svg("text", { x: at, y: top - 6, fill: colour(path) }, label),
        svg("path", { d: lineOf(record, column, span, x, y, wrap(path)), fill: "none", stroke: colour(path), "clip-path": `url(#plot${i})` }));
      at += 8 * label.length + 16;
    }
  });
  const times = ticks(span.from, span.to, 10);
  for (const t of times)
    root.append(svg("text", { x: x(t), y: bottom + 4, "text-anchor": "middle" }, seconds(t, times.length > 1 ? times[1] - times[0] : 1e9) + " s"));
  return new XMLSerializer().serializeToString(root);
}

export function saveSvg(picture: string): void { save(new Blob([picture], { type: "image/svg+xml" }), "lockstep.svg"); }

export async function savePng(picture: string): Promise<void> {
  const address = URL.createObjectURL(new Blob([picture], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = 2 * image.width;
    canvas.height = 2 * image.height;
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => { if (blob) save(blob, "lockstep.png"); });
  } finally {
    URL.revokeObjectURL(address);
  }
}
