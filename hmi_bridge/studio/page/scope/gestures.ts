// What a pointer does in a diagram: frames a stretch, places and drags cursors and levels, turns the wheel; on the axes of
// values it moves and zooms these. And how a signal is dragged to a diagram.

import { html } from "../base/dom";
import { Diagram, kLeft, kRight } from "./diagram";
import { TimeMap } from "./raster";
import { Cursor, Span, View } from "./view";

const kNear = 6;  // of what is taken [px]

export interface GestureNotes {
  view: View;
  latest(): number;
  snap(t: number): number;
  units(): string[];
  level(): { path: string; value: number; unit: string } | null;
  setLevel(value: number): void;
  axisChanged(): void;
}

type Taken = { cursor: Cursor } | { value: "C" | "D" } | { level: true } | { axis: string; low: number; high: number } | null;

export class Gestures {
  constructor(private readonly diagram: Diagram, private readonly notes: GestureNotes) {
    const { plot } = diagram;
    plot.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    plot.addEventListener("pointerdown", (event) => this.down(event));
    plot.addEventListener("dblclick", (event) => this.automatic(event));
  }

  private get width(): number { return Math.max(this.diagram.plot.clientWidth - kLeft - kRight, 1); }
  private span(): Span { return this.notes.view.window(this.notes.latest()); }
  private map(): TimeMap { return new TimeMap(this.span(), this.width, this.notes.view.isSweeping && this.notes.view.isLive); }
  private timeAt(x: number): number { return this.map().time((x - this.diagram.plot.getBoundingClientRect().left - kLeft) / this.width); }
  private heightAt(y: number): number { return y - this.diagram.plot.getBoundingClientRect().top; }

  /// The unit of the axis of values that lies under the pointer.
  private axisAt(x: number): string | null {
    const at = x - this.diagram.plot.getBoundingClientRect().left;
    const units = this.notes.units();
    if (at < kLeft) return units[0] ?? null;
    return at > kLeft + this.width ? units[1] ?? units[0] ?? null : null;
  }

  private taken(x: number, y: number): Taken {
    const left = this.diagram.plot.getBoundingClientRect().left + kLeft;
    const map = this.map();
    const height = this.heightAt(y);
    const level = this.notes.level();
    if (level && Math.abs(this.diagram.y(level.value, level.unit) - height) < kNear && (x < left || x > left + this.width * 0.98)) return { level: true };
    const axis = this.axisAt(x);
    if (axis !== null) return { axis, ...this.diagram.rangeOf(axis) };
    for (const name of ["A", "B"] as Cursor[]) {
      const t = this.notes.view.cursors[name];
      if (t !== null && Math.abs(left + map.share(t) * this.width - x) < kNear) return { cursor: name };
    }
    const unit = this.notes.units()[0] ?? "";
    for (const name of ["C", "D"] as const) {
      const value = this.diagram.values[name];
      if (value !== null && Math.abs(this.diagram.y(value, unit) - height) < kNear) return { value: name };
    }
    return level && Math.abs(this.diagram.y(level.value, level.unit) - height) < kNear ? { level: true } : null;
  }

  private setRange(unit: string, low: number, high: number): void {
    if (!(high > low)) return;
    this.diagram.axes[unit] = { mode: "fixed", range: { low, high } };
    this.notes.axisChanged();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const { view } = this.notes;
    const axis = this.axisAt(event.clientX) ?? (event.altKey ? this.notes.units()[0] ?? null : null);
    const factor = event.deltaY > 0 ? 1.25 : 0.8;
    if (axis !== null) {
      const { low, high } = this.diagram.rangeOf(axis);
      const around = this.diagram.valueAt(this.heightAt(event.clientY), axis);
      this.setRange(axis, around - (around - low) * factor, around + (high - around) * factor);
    } else if (event.shiftKey) view.move(Math.sign(event.deltaY || event.deltaX) * 0.1, this.notes.latest());
    else view.zoom(factor, this.timeAt(event.clientX), this.notes.latest());
  }

  private automatic(event: MouseEvent): void {
    const axis = this.axisAt(event.clientX);
    if (axis === null) return;
    delete this.diagram.axes[axis];
    this.notes.axisChanged();
  }

  private down(down: PointerEvent): void {
    if (down.button !== 0) return;
    const { plot } = this.diagram;
    const taken = this.taken(down.clientX, down.clientY);
    const begin = { t: this.timeAt(down.clientX), y: this.heightAt(down.clientY) };
    const frame = html("div", { class: "frame" });
    plot.setPointerCapture(down.pointerId);
    const move = (event: PointerEvent): void => {
      if (taken) this.drag(taken, event, begin.y);
      else this.drawFrame(frame, down, event);
    };
    const end = (event: PointerEvent): void => {
      for (const kind of ["pointermove", "pointerup", "pointercancel"] as const) plot.removeEventListener(kind, kind === "pointermove" ? move : end);
      const isFrame = frame.isConnected;
      frame.remove();
      if (event.type === "pointercancel") return;
      if (taken) return Math.abs(event.clientX - down.clientX) + Math.abs(event.clientY - down.clientY) > 2 ? this.drag(taken, event, begin.y) : undefined;
      if (isFrame) this.zoomTo(begin, event);
      else this.notes.view.place(event.shiftKey ? "B" : "A", this.notes.snap(this.timeAt(event.clientX)));
    };
    plot.addEventListener("pointermove", move);
    plot.addEventListener("pointerup", end);
    plot.addEventListener("pointercancel", end);
  }

  private drag(taken: Exclude<Taken, null>, event: PointerEvent, beginY: number): void {
    const height = this.heightAt(event.clientY);
    if ("cursor" in taken) return this.notes.view.place(taken.cursor, this.notes.snap(this.timeAt(event.clientX)));
    if ("value" in taken) {
      this.diagram.values[taken.value] = this.diagram.valueAt(height, this.notes.units()[0] ?? "");
      return this.notes.axisChanged();
    }
    if ("level" in taken) {
      const level = this.notes.level();
      if (level) this.notes.setLevel(this.diagram.valueAt(height, level.unit));
      return;
    }
    if (Math.abs(height - beginY) < 3) return;
    const by = this.diagram.valueAt(beginY, taken.axis) - this.diagram.valueAt(height, taken.axis);
    this.setRange(taken.axis, taken.low + by, taken.high + by);
  }

  private drawFrame(frame: HTMLElement, down: PointerEvent, event: PointerEvent): void {
    if (Math.abs(event.clientX - down.clientX) < 5 && !frame.isConnected) return;
    const { left, top } = this.diagram.plot.getBoundingClientRect();
    this.diagram.plot.append(frame);
    frame.style.left = Math.min(event.clientX, down.clientX) - left + "px";
    frame.style.width = Math.abs(event.clientX - down.clientX) + "px";
    if (!event.altKey) return;
    frame.style.top = Math.min(event.clientY, down.clientY) - top + "px";
    frame.style.bottom = "auto";
    frame.style.height = Math.abs(event.clientY - down.clientY) + "px";
  }

  /// With Alt the values that are framed, too.
  private zoomTo(begin: { t: number; y: number }, event: PointerEvent): void {
    const t = this.timeAt(event.clientX);
    const y = this.heightAt(event.clientY);
    if (event.altKey)
      for (const unit of this.notes.units()) {
        const ends = [this.diagram.valueAt(begin.y, unit), this.diagram.valueAt(y, unit)];
        this.setRange(unit, Math.min(...ends), Math.max(...ends));
      }
    this.notes.view.show(Math.min(begin.t, t), Math.max(begin.t, t), this.notes.latest());
  }
}

/// A signal is dragged from where it stands; `drop` hears of the element that it is let go over. A click stays a click.
export function dragSignal(path: string, down: PointerEvent, drop: (target: Element | null) => void): void {
  if (down.button !== 0) return;
  const ghost = html("div", { class: "ghost" }, path);
  let target: Element | null = null;
  const move = (event: PointerEvent): void => {
    if (!ghost.isConnected && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < 8) return;
    document.body.append(ghost);
    ghost.style.transform = `translate(${event.clientX + 8}px, ${event.clientY + 8}px)`;
    target?.classList.remove("target");
    target = document.elementFromPoint(event.clientX, event.clientY)?.closest(".diagram, .stack") ?? null;
    target?.classList.add("target");
    event.preventDefault();
  };
  const end = (event: PointerEvent): void => {
    window.removeEventListener("pointermove", move);
    window.removeEventListener("pointerup", end);
    window.removeEventListener("pointercancel", end);
    const isDragged = ghost.isConnected;
    ghost.remove();
    target?.classList.remove("target");
    if (!isDragged) return;
    // The click that comes now is none.
    const swallow = (click: Event): void => { click.stopPropagation(); click.preventDefault(); };
    window.addEventListener("click", swallow, true);
    setTimeout(() => window.removeEventListener("click", swallow, true), 0);
    if (event.type === "pointerup") drop(target);
  };
  window.addEventListener("pointermove", move);
  window.addEventListener("pointerup", end);
  window.addEventListener("pointercancel", end);
}
