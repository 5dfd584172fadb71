// Binary frames as hmi_bridge/STUDIO.md lays them out; little-endian, looked at in place.

export const enum Kind { rows = 1, coarse = 2, window = 3 }
const enum ValueType { f64 = 0, i64 = 1, u64 = 2, bool = 3 }

/// Values of a signal: one array of rows, or first, minimum, maximum and last of points.
export interface FrameColumn { arrays: ArrayLike<number>[] }

export interface Frame {
  kind: Kind;
  subscription: number;
  number: number;
  dropped: number;  // rows missing before the first one
  t: Float64Array;  // [ns]
  columns: FrameColumn[];
}

function numbers(values: BigInt64Array | BigUint64Array): Float64Array {
  const result = new Float64Array(values.length);
  for (let i = 0; i < values.length; ++i) result[i] = Number(values[i]);
  return result;
}

function values(buffer: ArrayBuffer, at: number, rows: number, type: number): ArrayLike<number> {
  switch (type) {
    case ValueType.i64: return numbers(new BigInt64Array(buffer, at, rows));
    case ValueType.u64: return numbers(new BigUint64Array(buffer, at, rows));
    case ValueType.bool: return new Uint8Array(buffer, at, rows);
    default: return new Float64Array(buffer, at, rows);
  }
}

const padded = (size: number): number => (size + 7) & ~7;

/// Throws RangeError if the buffer is shorter than it says.
export function decode(buffer: ArrayBuffer): Frame {
  const head = new DataView(buffer);
  const width = head.getUint16(2, true);
  const rows = head.getUint32(8, true);
  let at = 24 + 16 * rows;
  const columns: FrameColumn[] = [];
  for (let i = 0; i < width; ++i) {
    const type = head.getUint8(at);
    const count = head.getUint8(at + 1);
    at += 8;
    const arrays: ArrayLike<number>[] = [];
    for (let k = 0; k < count; ++k) {
      arrays.push(values(buffer, at, rows, type));
      at += type === ValueType.bool ? padded(rows) : 8 * rows;
    }
    columns.push({ arrays });
  }
  return {
    kind: head.getUint8(0),
    subscription: head.getUint32(4, true),
    number: head.getUint32(12, true),
    dropped: Number(head.getBigUint64(16, true)),
    t: numbers(new BigInt64Array(buffer, 24, rows)),
    columns,
  };
}

/// A frame of rows as the server writes one; all columns are of numbers.
export function encode(t: Float64Array, columns: Float64Array[]): ArrayBuffer {
  const rows = t.length;
  const buffer = new ArrayBuffer(24 + 16 * rows + columns.length * (8 + 8 * rows));
  const head = new DataView(buffer);
  head.setUint8(0, Kind.window);
  head.setUint8(1, 1);
  head.setUint16(2, columns.length, true);
  head.setUint32(8, rows, true);
  new BigInt64Array(buffer, 24, rows).set(BigInt64Array.from(t, (one) => BigInt(Math.round(one))));
  let at = 24 + 16 * rows;
  for (const column of columns) {
    head.setUint8(at + 1, 1);
    new Float64Array(buffer, at + 8, rows).set(column);
    at += 8 + 8 * rows;
  }
  return buffer;
}
