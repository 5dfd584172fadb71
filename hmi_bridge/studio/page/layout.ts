// Which signals stand in which diagram. It is kept in the browser, by project.

import { Signal } from "./record";

export const kDiagrams = 16;
export const kSignals = 16;  // of a diagram

export function load(project: string): string[][] | null {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem("lockstep-layout:" + project) ?? "null");
    const isLayout = Array.isArray(kept) && kept.every((paths) => Array.isArray(paths) && paths.every((path) => typeof path === "string"));
    return isLayout ? (kept as string[][]) : null;
  } catch {
    return null;
  }
}

export function keep(project: string, layout: string[][]): void {
  localStorage.setItem("lockstep-layout:" + project, JSON.stringify(layout));
}

/// What an outsider sees first: the signals that the project traces, or how its objects move, those of a unit
/// together and what is TRUE or FALSE below.
export function byUnit(signals: Signal[]): string[][] {
  const groups = new Map<string, string[]>();
  for (const { path, unit, type } of signals) {
    const key = type === "BOOL" ? "~" : unit;
    groups.set(key, [...(groups.get(key) ?? []), path].slice(0, kSignals));
  }
  const last = groups.get("~");
  groups.delete("~");
  return [...groups.values(), ...(last ? [last] : [])].slice(0, kDiagrams);
}

export function firstPaths(project: { trace: string[]; objects: { name: string }[] }): string[] {
  if (project.trace.length) return project.trace.slice(0, 64);
  return project.objects.slice(0, 16).flatMap(({ name }) => [name + ".Position", name + ".Velocity"]);
}
