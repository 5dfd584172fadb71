// Which signals stand in which diagram and how they are drawn. Kept in the browser, by project and by name.

import { Range } from "../base/scale";
import { Signal } from "./record";

export const kDiagrams = 16;
export const kSignals = 16;  // of a diagram
export const kColours = 8;   // of the style sheet

/// How a signal is drawn: value × scale + offset.
export interface Line {
  path: string;
  colour: number;
  width: number;       // [px]
  dash: number;        // columns that are drawn and left out in turns; 0: all
  scale: number;
  offset: number;
  isVisible: boolean;
  shape: "auto" | "line" | "bands";
}

export type RangeMode = "auto" | "fixed" | "common";
/// Of all signals of a unit in a diagram; common: with all diagrams that have it so.
export interface AxisSetup { mode: RangeMode; range: Range | null }

export interface DiagramSetup { lines: Line[]; axes: Record<string, AxisSetup> }
export interface Layout { version: 2; diagrams: DiagramSetup[]; length: number }

export function lineOf(path: string, colour: number): Line {
  return { path, colour: colour % kColours, width: 2, dash: colour >= kColours ? 6 : 0, scale: 1, offset: 0, isVisible: true, shape: "auto" };
}

const isText = (value: unknown): value is string => typeof value === "string";
const orElse = (value: unknown, other: number): number => (typeof value === "number" && isFinite(value) ? value : other);

function readLine(kept: any, colour: number): Line | null {
  if (!isText(kept?.path)) return null;
  const plain = lineOf(kept.path, colour);
  return { ...plain, colour: Math.abs(Math.trunc(orElse(kept.colour, plain.colour))) % kColours, width: Math.min(Math.max(orElse(kept.width, 2), 1), 5),
    dash: Math.min(Math.max(orElse(kept.dash, plain.dash), 0), 20), scale: orElse(kept.scale, 1) || 1, offset: orElse(kept.offset, 0),
    isVisible: kept.isVisible !== false, shape: ["line", "bands"].includes(kept.shape) ? kept.shape : "auto" };
}

function readAxes(kept: any): Record<string, AxisSetup> {
  const axes: Record<string, AxisSetup> = {};
  for (const [unit, axis] of Object.entries<any>(kept ?? {})) {
    const range = axis?.range && axis.range.low < axis.range.high ? { low: Number(axis.range.low), high: Number(axis.range.high) } : null;
    if (["fixed", "common"].includes(axis?.mode)) axes[unit] = { mode: axis.mode, range };
  }
  return axes;
}

/// A layout as it was kept or comes from a file; null: it is none.
export function readLayout(kept: any): Layout | null {
  if (!Array.isArray(kept?.diagrams)) return null;
  let colour = 0;
  const diagrams = kept.diagrams.slice(0, kDiagrams).map((one: any): DiagramSetup => ({
    lines: (Array.isArray(one?.lines) ? one.lines : []).slice(0, kSignals).map((line: any) => readLine(line, colour++)).filter((line: Line | null) => line !== null),
    axes: readAxes(one?.axes) }));
  return { version: 2, diagrams, length: Math.min(Math.max(orElse(kept.length, 1e10), 1e7), 3.6e12) };
}

const keyOf = (project: string): string => "lockstep-layouts:" + project;
const kLast = "";  // under which that stands that one has left

/// All layouts of a project that this browser keeps.
export function keptLayouts(project: string): Record<string, Layout> {
  try {
    const layouts: Record<string, Layout> = {};
    for (const [name, kept] of Object.entries(JSON.parse(localStorage.getItem(keyOf(project)) ?? "{}"))) {
      const layout = readLayout(kept);
      if (layout) layouts[name] = layout;
    }
    return layouts;
  } catch {
    return {};
  }
}

export function keepLayouts(project: string, layouts: Record<string, Layout>): void {
  localStorage.setItem(keyOf(project), JSON.stringify(layouts));
}

export function lastLayout(project: string): Layout | null { return keptLayouts(project)[kLast] ?? null; }
export function keepLast(project: string, layout: Layout): void { keepLayouts(project, { ...keptLayouts(project), [kLast]: layout }); }

/// What an outsider sees first: the signals that the project traces, or how its objects move, those of a unit
/// together and what is TRUE or FALSE below.
export function byUnit(signals: Signal[]): DiagramSetup[] {
  const groups = new Map<string, string[]>();
  for (const { path, unit, type } of signals) {
    const key = type === "BOOL" ? "~" : unit;
    groups.set(key, [...(groups.get(key) ?? []), path].slice(0, kSignals));
  }
  const last = groups.get("~");
  groups.delete("~");
  let colour = 0;
  return [...groups.values(), ...(last ? [last] : [])].slice(0, kDiagrams)
    .map((paths) => ({ lines: paths.map((path) => lineOf(path, colour++ % kColours)), axes: {} }));
}

export function firstPaths(project: { trace: string[]; objects: { name: string }[] }): string[] {
  if (project.trace.length) return project.trace.slice(0, 64);
  return project.objects.slice(0, 16).flatMap(({ name }) => [name + ".Position", name + ".Velocity"]);
}
