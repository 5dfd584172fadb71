// A layout with the values that it shows, as one file, and what stands in an exported page: both open again as they were.

import { decode, encode } from "../base/frames";
import { Layout, readLayout } from "./layout";
import { Recording, Signal } from "./record";
import { Span } from "./view";

/// As the server writes it into a page, and the page into its own files.
export interface Kept { about: { project?: string; version?: string; name?: string }; signals: Signal[]; frame: string; gaps?: any[]; events?: any[]; jobs?: any[]; layout?: unknown; window?: Span }

const kPiece = 0x8000;

function base64(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += kPiece) text += String.fromCharCode(...bytes.subarray(at, at + kPiece));
  return btoa(text);
}

function bytesOf(text: string): ArrayBuffer {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}

/// Rows of what is shown, with the layout.
export function keptOf(project: string, record: Recording, span: Span, layout: Layout, window_: Span): Kept {
  const from = record.rowAt(span.from);
  const to = record.rowAt(span.to + 1);
  const frame = encode(record.t.subarray(from, to), record.columns.map((column) => {
    const scale = column.type === "TIME" ? 1e9 : 1;
    return column.value.subarray(from, to).map((value) => value * scale);
  }));
  return { about: { project, name: "studio" }, signals: record.columns.map(({ path, type, unit }) => ({ path, type, unit })), frame: base64(new Uint8Array(frame)),
    gaps: record.gaps.filter((gap) => gap.to >= span.from && gap.from <= span.to), layout, window: window_ };
}

/// null: it is nothing of this kind.
export function readKept(text: string): (Kept & { record: Recording; read: Layout | null }) | null {
  try {
    const inner = /<script type="application\/json" id="lockstep-trace">([\s\S]*?)<\/script>/.exec(text);
    const kept = JSON.parse(inner ? inner[1] : text) as Kept;
    if (!Array.isArray(kept.signals) || typeof kept.frame !== "string") return null;
    const record = new Recording(kept.signals);
    record.append(decode(bytesOf(kept.frame)));
    for (const gap of kept.gaps ?? []) {
      const row = record.rowAt(Number(gap.to ?? gap.t));
      if (row > 0 && row < record.size) record.breakBefore(row, Number(gap.rows ?? 0));
    }
    return { ...kept, record, read: readLayout(kept.layout) };
  } catch {
    return null;
  }
}
