// What a pointer does in a diagram: frames a stretch, places and drags cursors, turns the wheel.

import { kLeft, kRight } from "./diagram";
import { Cursor, Span, View } from "./view";

const kNear = 6;  // of a cursor that is taken [px]

export function listen(plot: HTMLElement, view: View, latest: () => number, snap: (t: number) => number): void {
  const span = (): Span => view.window(latest());
  const width = (): number => Math.max(plot.clientWidth - kLeft - kRight, 1);
  const timeAt = (x: number): number => {
    const { from, to } = span();
    return from + ((x - plot.getBoundingClientRect().left - kLeft) / width()) * (to - from);
  };
  const near = (x: number): Cursor | null => {
    const { from, to } = span();
    const perPixel = (to - from) / width();
    const t = timeAt(x);
    return (["A", "B"] as Cursor[]).find((name) => {
      const at = view.cursors[name];
      return at !== null && Math.abs(at - t) < kNear * perPixel;
    }) ?? null;
  };

  plot.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (event.shiftKey) view.move(Math.sign(event.deltaY || event.deltaX) * 0.1, latest());
    else view.zoom(event.deltaY > 0 ? 1.25 : 0.8, timeAt(event.clientX), latest());
  }, { passive: false });

  plot.addEventListener("pointerdown", (down) => {
    if (down.button !== 0) return;
    const cursor = near(down.clientX);
    const begin = timeAt(down.clientX);
    const frame = document.createElement("div");
    frame.className = "frame";
    plot.setPointerCapture(down.pointerId);
    const move = (event: PointerEvent): void => {
      if (cursor) return view.place(cursor, snap(timeAt(event.clientX)));
      if (Math.abs(event.clientX - down.clientX) < 5 && !frame.isConnected) return;
      const left = plot.getBoundingClientRect().left;
      plot.append(frame);
      frame.style.left = Math.min(event.clientX, down.clientX) - left + "px";
      frame.style.width = Math.abs(event.clientX - down.clientX) + "px";
    };
    const end = (event: PointerEvent): void => {
      plot.removeEventListener("pointermove", move);
      plot.removeEventListener("pointerup", end);
      plot.removeEventListener("pointercancel", end);
      const isFrame = frame.isConnected;
      frame.remove();
      if (event.type === "pointercancel" || cursor) return;
      const t = timeAt(event.clientX);
      if (isFrame) view.show(Math.min(begin, t), Math.max(begin, t), latest());
      else view.place(event.shiftKey ? "B" : "A", snap(t));
    };
    plot.addEventListener("pointermove", move);
    plot.addEventListener("pointerup", end);
    plot.addEventListener("pointercancel", end);
  });
}
