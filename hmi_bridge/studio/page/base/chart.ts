// A small chart of one line, with axes and ticks, as SVG: for what does not move with the run.

import { svg } from "./dom";
import { rounded, stepOf, tickText, ticks } from "./scale";

export interface ChartAxis { label: string; low: number; high: number }
export interface ChartMark { x: number; y: number; name: string }

const kLeft = 64;
const kBottom = 34;
const kTop = 8;
const kRight = 14;

/// An axis with round ends around values.
export function chartAxis(label: string, values: ArrayLike<number>): ChartAxis {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < values.length; ++i) {
    if (values[i] < low && values[i] > -Infinity) low = values[i];
    if (values[i] > high && values[i] < Infinity) high = values[i];
  }
  return { label, ...rounded(low, high, null) };
}

/// @param breaks where the line is not joined to the point before
export function chart(width: number, height: number, xs: ArrayLike<number>, ys: ArrayLike<number>, x: ChartAxis, y: ChartAxis, marks: ChartMark[],
                      breaks: (i: number) => boolean = () => false): SVGElement[] {
  const inner = { width: Math.max(width - kLeft - kRight, 1), height: Math.max(height - kTop - kBottom, 1) };
  const px = (value: number): number => kLeft + ((value - x.low) / (x.high - x.low)) * inner.width;
  const py = (value: number): number => kTop + ((y.high - value) / (y.high - y.low)) * inner.height;
  const shapes: SVGElement[] = [svg("rect", { class: "chart-box", x: kLeft, y: kTop, width: inner.width, height: inner.height })];
  const [countX, countY] = [inner.width / 90, Math.max(inner.height / 36, 2)];
  for (const value of ticks(x.low, x.high, countX))
    shapes.push(svg("line", { class: "grid", x1: px(value), x2: px(value), y1: kTop, y2: kTop + inner.height }),
      svg("text", { class: "tick", x: px(value), y: kTop + inner.height + 14, "text-anchor": "middle" }, tickText(value, stepOf(x.high - x.low, countX))));
  for (const value of ticks(y.low, y.high, countY))
    shapes.push(svg("line", { class: "grid", x1: kLeft, x2: kLeft + inner.width, y1: py(value), y2: py(value) }),
      svg("text", { class: "tick", x: kLeft - 6, y: py(value) + 4, "text-anchor": "end" }, tickText(value, stepOf(y.high - y.low, countY))));
  let path = "";
  let isDown = false;
  for (let i = 0; i < xs.length; ++i) {
    if (!isFinite(xs[i]) || !isFinite(ys[i])) { isDown = false; continue; }
    path += `${isDown && !breaks(i) ? "L" : "M"}${px(xs[i]).toFixed(1)} ${Math.min(Math.max(py(ys[i]), -1e4), 1e4).toFixed(1)}`;
    isDown = true;
  }
  shapes.push(svg("path", { class: "chart-line", d: path }),
    svg("text", { class: "axis-unit", x: kLeft + inner.width / 2, y: height - 4, "text-anchor": "middle" }, x.label),
    svg("text", { class: "axis-unit", transform: `translate(12 ${kTop + inner.height / 2}) rotate(-90)`, "text-anchor": "middle" }, y.label));
  for (const mark of marks)
    shapes.push(svg("circle", { class: "chart-mark", cx: px(mark.x), cy: py(mark.y), r: 4 }), svg("text", { class: "chart-name", x: px(mark.x) + 6, y: Math.max(py(mark.y) - 5, 14) }, mark.name));
  return shapes;
}
