import uPlot from "uplot";
import { upperBound } from "../data/search.ts";
import type { Timeline } from "../data/timeline.ts";
import type { Actions, Moment } from "../moment.ts";
import type { Palette, Theme } from "../theme.ts";
import { brief, shortClock } from "../ui/format.ts";
import { el, setText } from "../ui/dom.ts";
import { same } from "../ui/same.ts";

type Series = (number | null)[];

/** One plot over mission time, with what is still to come behind a veil. */
class TimePlot {
  readonly element: HTMLElement;
  private readonly holder = el("div", { class: "plot" });
  private readonly veil = el("div", { class: "veil" });
  private readonly reading = el("p", { class: "reading" });
  private plot: uPlot | null = null;
  private data: uPlot.AlignedData = [[], []];
  private end = 1;
  private now = 0;

  constructor(
    title: string,
    private readonly names: string[],
    private readonly options: (palette: Palette) => Partial<uPlot.Options>,
    private readonly palette: () => Palette,
    private readonly clicked: (t: number) => void,
  ) {
    const key = el("span", { class: "keys" }, ...names.map((n, i) => el("span", { class: `key s${i}` }, n)));
    this.element = el("div", { class: "plot-box" }, el("h2", {}, title, key, this.reading), this.holder);
    this.holder.setAttribute("role", "img");
    this.holder.setAttribute("aria-label", `${title} over time`);
    new ResizeObserver(() => this.resize()).observe(this.holder);
  }

  setData(x: number[], series: Series[], end: number): void {
    this.data = [x, ...series] as uPlot.AlignedData;
    this.end = Math.max(end, 1);
    if (this.plot) this.plot.setData(this.data);
    else this.resize();
  }

  /** The veil begins here. */
  setNow(t: number): void {
    this.now = t;
    this.placeVeil();
  }

  private placeVeil(): void {
    this.veil.style.left = `${(100 * Math.min(this.now, this.end)) / this.end}%`;
  }

  /** Another theme. */
  remake(): void {
    this.plot?.destroy();
    this.plot = null;
    this.resize();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width < 40 || height < 40) return;
    if (this.plot) this.plot.setSize({ width, height });
    else this.make(width, height);
    this.placeVeil();
  }

  private make(width: number, height: number): void {
    const palette = this.palette();
    const axis: uPlot.Axis = {
      stroke: palette.muted,
      font: "11px system-ui, sans-serif",
      grid: { stroke: palette.rule, width: 1 },
      ticks: { show: false },
      gap: 4,
    };
    const { series = [], scales = {}, axes = [] } = this.options(palette);
    this.plot = new uPlot(
      {
        width,
        height,
        legend: { show: false },
        padding: [6, 8, 0, 0],
        cursor: { y: false, drag: { x: false, y: false }, sync: { key: "canopeer" }, points: { size: 6 } },
        scales: { x: { time: false, range: () => [0, this.end] }, ...scales },
        axes: [
          { ...axis, size: 20, values: (_, ticks) => ticks.map(shortClock), space: 60, incrs: kTimeSteps },
          { ...axis, size: 40, values: (_, ticks) => ticks.map(brief), filter: (_, ticks) => ticks, space: 24, ...axes[0] },
        ],
        series: [{}, ...series],
        hooks: { setCursor: [(u) => this.read(u)] },
      },
      this.data,
      this.holder,
    );
    this.plot.over.append(this.veil);
    this.plot.over.addEventListener("click", () => {
      const left = this.plot?.cursor.left ?? -1;
      if (this.plot && left >= 0) this.clicked(this.plot.posToVal(left, "x"));
    });
  }

  /** What is under the pointer. */
  private read(u: uPlot): void {
    const i = u.cursor.idx;
    if (i === null || i === undefined) return setText(this.reading, "");
    const values = this.names.map((_, s) => brief(u.data[s + 1]?.[i] ?? null));
    setText(this.reading, `${shortClock(u.data[0][i])} · ${values.join(" / ")}`);
  }
}

/** Powers of ten; every second one where there are many. */
function decades(min: number, max: number): number[] {
  const [low, high] = [Math.round(Math.log10(min)), Math.round(Math.log10(max))];
  const step = high - low > 4 ? 2 : 1;
  return Array.from({ length: Math.floor((high - low) / step) + 1 }, (_, i) => 10 ** (low + i * step));
}

const kTimeSteps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600];

/** Fruits found, and gain promised and realised, view by view. */
export class Plots {
  readonly element: HTMLElement;
  private readonly fruits: TimePlot;
  private readonly gain: TimePlot;
  private shownAs: unknown[] = [];
  private timeline: Timeline | null = null;

  constructor(actions: Actions, theme: Theme) {
    const stepped = uPlot.paths.stepped?.({ align: 1 });
    const nearest = (t: number) => this.nearestView(t, actions);
    this.fruits = new TimePlot(
      "Fruits",
      ["found", "there are"],
      (p) => ({
        series: [
          { stroke: p.driven, width: 2, paths: stepped, points: { show: false }, fill: `${p.driven}22` },
          { stroke: p.muted, width: 1, dash: [5, 4], points: { show: false } },
        ],
        scales: { y: { range: (_u, _min, max) => [0, Math.max(5, 1.08 * (max ?? 5))] } },
      }),
      () => theme.palette,
      nearest,
    );
    this.gain = new TimePlot(
      "Gain (voxels)",
      ["promised", "seen"],
      (p) => ({
        series: [
          { stroke: p.border, width: 1, paths: () => null, points: { show: true, size: 4.5, width: 1.3, fill: p.card } },
          { stroke: p.occupied, width: 1.5, points: { show: true, size: 3.5, fill: p.occupied } },
        ],
        scales: { y: { distr: 3, range: (_u, _min, max) => [10, 10 ** Math.ceil(Math.log10(Math.max(1000, max || 0)))] } },
        axes: [{ splits: (_u, _axis, min, max) => decades(min, max) }],
      }),
      () => theme.palette,
      nearest,
    );
    this.element = el("div", { class: "plots" }, this.fruits.element, this.gain.element);
    theme.use(() => this.remake());
  }

  update({ timeline, t }: Moment): void {
    if (this.element.closest("[hidden]")) return;
    this.timeline = timeline;
    const views = timeline.views;
    const end = timeline.duration;
    const counted = timeline.truth?.fruits.filter((f) => f.counted).length ?? null;
    const as = [timeline, views.length, timeline.looks.length, end.toFixed(1), counted];
    if (!same(as, this.shownAs)) {
      this.shownAs = as;
      const course = timeline.fruitCourse();
      // A last point, so that the line reaches the newest moment.
      const last = course.at(-1);
      const xs = [...course.map((c) => c.t), Math.max(end, last?.t ?? 0)];
      this.fruits.setData(xs, [[...course.map((c) => c.fruits), last?.fruits ?? null], xs.map(() => counted)], end);
      const x = views.map((v) => v.t);
      const positive = (v: number | null) => (v === null ? null : Math.max(v, 10));
      this.gain.setData(x, [views.map((v) => positive(v.predicted)), views.map((v) => positive(v.realised))], end);
    }
    this.fruits.setNow(t);
    this.gain.setNow(t);
  }

  private remake(): void {
    this.fruits.remake();
    this.gain.remake();
  }

  private nearestView(t: number, actions: Actions): void {
    const views = this.timeline?.views ?? [];
    const i = upperBound(this.timeline?.viewTimes ?? [], t);
    const [before, after] = [views[i - 1], views[i]];
    const nearest = before && after ? (t - before.t < after.t - t ? before : after) : (before ?? after);
    if (nearest) actions.selectView(nearest.view);
  }
}
