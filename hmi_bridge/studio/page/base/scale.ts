// Round numbers along an axis, and numbers as people read them.

/// A round distance that fits `count` times or so into a range.
export function stepOf(length: number, count: number): number {
  const rough = length / Math.max(count, 1);
  if (!(rough > 0) || !isFinite(rough)) return 0;
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5].find((factor) => factor * power >= rough * (1 - 1e-9)) ?? 10);
}

/// Round values within a range, `count` or so of them.
export function ticks(from: number, to: number, count: number): number[] {
  const step = stepOf(to - from, count);
  if (!step) return [];
  const result: number[] = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + step * 1e-9; ++i) result.push(i * step);
  return result;
}

export interface Range { low: number; high: number }

/// A range with round ends around what is there. It stays as it was as long as that does, so that a live picture does not shake.
export function rounded(low: number, high: number, before: Range | null): Range {
  if (!(low <= high)) return before ?? { low: 0, high: 1 };
  const length = high - low;
  if (before && low >= before.low && high <= before.high && length > 0.4 * (before.high - before.low)) return before;
  const margin = length > 1e-9 * Math.max(Math.abs(low), Math.abs(high)) ? length * 0.03 : Math.max(Math.abs(high) * 0.05, 0.5);
  const step = stepOf(length + 2 * margin, 8) || 1;
  return { low: Math.floor((low - margin) / step + 1e-9) * step, high: Math.ceil((high + margin) / step - 1e-9) * step };
}

/// As short as it can be said with so many digits.
export function short(value: number, digits = 6): string {
  if (!isFinite(value)) return String(value).replace("Infinity", "inf");
  return String(Number(value.toPrecision(digits)));
}

/// A tick's value with as many decimals as the distance of ticks needs.
export function tickText(value: number, step: number): string {
  if (Math.abs(value) >= 1e7 || (value !== 0 && step < 1e-6)) return short(value, 4);
  return value.toFixed(Math.min(Math.max(Math.ceil(-Math.log10(step) - 1e-9), 0), 9));
}

/// A time [ns] in seconds; @param step what is to be told apart [ns]
export function seconds(t: number, step: number): string {
  const digits = Math.min(Math.max(Math.ceil(-Math.log10(step / 1e9)), 0), 9);
  return (t / 1e9).toFixed(digits);
}

/// A duration [ns] in the unit that fits.
export function duration(t: number): string {
  const size = Math.abs(t);
  if (size >= 1e9 || size === 0) return short(t / 1e9) + " s";
  return size >= 1e6 ? short(t / 1e6) + " ms" : short(t / 1e3) + " µs";
}

/// A number as a field has it: a decimal point or comma.
export function numberOf(text: string): number {
  const plain = text.trim().replace(",", ".");
  return plain === "" ? NaN : Number(plain);
}

/// A value as a request or a table has it: BOOL, number, text.
export function valueText(value: unknown, digits = 9): string {
  if (value === true) return "TRUE";
  if (value === false) return "FALSE";
  if (typeof value === "number") return short(value, digits);
  return value === undefined || value === null ? "–" : String(value);
}
