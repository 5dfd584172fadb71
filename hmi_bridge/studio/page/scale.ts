// Round numbers along an axis, and numbers as people read them.

/// Round values within a range, `count` or so of them.
export function ticks(from: number, to: number, count: number): number[] {
  const rough = (to - from) / Math.max(count, 1);
  if (!(rough > 0) || !isFinite(rough)) return [];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find((factor) => factor * power >= rough) ?? 10);
  const result: number[] = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + step * 1e-9; ++i) result.push(i * step);
  return result;
}

/// A little more than a range, so that its extremes do not lie on the border; something, where it is empty.
export function widened(low: number, high: number): [number, number] {
  if (!(low <= high)) return [0, 1];
  const margin = high > low ? (high - low) * 0.06 : Math.max(Math.abs(high) * 0.05, 0.5);
  return [low - margin, high + margin];
}

/// As short as it can be said with so many digits.
export function short(value: number, digits = 6): string {
  if (!isFinite(value)) return String(value).replace("Infinity", "inf");
  return String(Number(value.toPrecision(digits)));
}

/// A time or a duration [ns] in the unit that fits; @param step what is to be told apart [ns]
export function seconds(t: number, step: number): string {
  const digits = Math.min(Math.max(Math.ceil(-Math.log10(step / 1e9)), 0), 9);
  return (t / 1e9).toFixed(digits);
}

export function duration(t: number): string {
  const size = Math.abs(t);
  if (size >= 1e9 || size === 0) return short(t / 1e9) + " s";
  return size >= 1e6 ? short(t / 1e6) + " ms" : short(t / 1e3) + " µs";
}
