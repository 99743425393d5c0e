/** 75.3 → "1:15.3" */
export function clock(t: number): string {
  const tenths = Math.max(0, Math.floor(t * 10 + 1e-6));
  const minutes = Math.floor(tenths / 600);
  const seconds = ((tenths % 600) / 10).toFixed(1).padStart(4, "0");
  return `${minutes}:${seconds}`;
}

/** 75.3 → "1:15" */
export function shortClock(t: number): string {
  const seconds = Math.max(0, Math.floor(t + 1e-6));
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}

const kWhole = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

/** 458880 → "458,880"; nothing → "–" */
export function whole(value: number | null | undefined): string {
  return value === null || value === undefined ? "–" : kWhole.format(value);
}

/** 458880 → "459k" */
export function brief(value: number | null | undefined): string {
  if (value === null || value === undefined) return "–";
  const size = Math.abs(value);
  if (size >= 1e7) return `${(value / 1e6).toFixed(0)}M`;
  if (size >= 1e6) return `${(value / 1e6).toFixed(1)}M`;
  if (size >= 1e4) return `${(value / 1e3).toFixed(0)}k`;
  if (size >= 1e3) return `${Number((value / 1e3).toFixed(1))}k`;
  return kWhole.format(value);
}

export function seconds(value: number): string {
  if (value >= 100) return `${value.toFixed(0)} s`;
  return value >= 1 ? `${value.toFixed(1)} s` : `${(value * 1000).toFixed(0)} ms`;
}

export function percent(share: number): string {
  return `${Math.round(100 * share)} %`;
}

const kKindNames: Record<string, string> = {
  home: "home",
  roi: "fruit",
  occupied: "occupied",
  border: "border",
  random: "random",
  none: "no target",
};

/** What a view is after, in a word. */
export function kindName(kind: string): string {
  return kKindNames[kind] ?? kind;
}
