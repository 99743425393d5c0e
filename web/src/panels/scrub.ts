import type { Timeline } from "../data/timeline.ts";
import type { Moment } from "../moment.ts";
import { kindColor, type Theme } from "../theme.ts";
import { clock } from "../ui/format.ts";
import { el, fitCanvas, setText } from "../ui/dom.ts";
import { same } from "../ui/same.ts";

/** The run as a line: segments, views by kind, and where the page is. Drag or click to go there. */
export class Scrub {
  readonly element: HTMLElement;
  private readonly canvas = el("canvas", { "aria-hidden": "true" });
  private readonly head = el("i", { class: "head" });
  private readonly tip = el("span", { class: "tip", hidden: true });
  private timeline: Timeline | null = null;
  private drawn: unknown[] = [];

  constructor(
    private readonly theme: Theme,
    private readonly seek: (t: number) => void,
  ) {
    this.element = el(
      "div",
      { class: "scrub", role: "slider", tabindex: 0, label: "Time in the run", "aria-valuemin": 0 },
      this.canvas,
      this.head,
      this.tip,
    );
    this.element.addEventListener("pointerdown", (e) => this.drag(e));
    this.element.addEventListener("pointermove", (e) => this.hover(e));
    this.element.addEventListener("pointerleave", () => (this.tip.hidden = true));
    new ResizeObserver(() => this.redraw()).observe(this.element);
    theme.use(() => this.redraw());
  }

  update({ timeline, t, segment }: Moment): void {
    this.timeline = timeline;
    const as = [timeline, timeline.duration.toFixed(1), timeline.views.length, timeline.segments.length];
    if (!same(as, this.drawn)) {
      this.drawn = as;
      this.draw();
    }
    this.head.style.left = `${100 * Math.min(1, t / this.duration())}%`;
    this.element.setAttribute("aria-valuemax", this.duration().toFixed(1));
    this.element.setAttribute("aria-valuenow", t.toFixed(1));
    this.element.setAttribute("aria-valuetext", `${clock(t)}${segment ? `, ${segment.name}` : ""}`);
  }

  private duration(): number {
    return Math.max(0.1, this.timeline?.duration ?? 0);
  }

  private redraw(): void {
    this.drawn = [];
    this.draw();
  }

  private draw(): void {
    const context = fitCanvas(this.canvas);
    if (!context || !this.timeline) return;
    const { clientWidth: w, clientHeight: h } = this.canvas;
    const palette = this.theme.palette;
    const x = (t: number) => (t / this.duration()) * w;
    const { segments, views } = this.timeline;
    segments.forEach((segment, i) => {
      const [from, to] = [x(segment.t), x(segments[i + 1]?.t ?? this.duration())];
      context.fillStyle = palette.rule;
      context.globalAlpha = i % 2 === 0 ? 1 : 0.55;
      context.fillRect(from, 0, to - from - 1, h);
      context.globalAlpha = 1;
      context.fillStyle = palette.muted;
      context.fillRect(Math.round(from), 0, 1, h);
      if (to - from > 30) {
        context.font = "10px system-ui, sans-serif";
        context.fillText(fitted(context, segment.name, to - from - 8), from + 4, 10);
      }
    });
    for (const view of views) {
      context.fillStyle = kindColor(palette, view.kind);
      context.fillRect(x(view.t) - 0.75, h - 11, 1.5, 9);
    }
  }

  private timeOf(event: PointerEvent): number {
    const box = this.element.getBoundingClientRect();
    return Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)) * this.duration();
  }

  private drag(event: PointerEvent): void {
    if (event.button !== 0) return;
    this.element.setPointerCapture(event.pointerId);
    this.seek(this.timeOf(event));
  }

  private hover(event: PointerEvent): void {
    const t = this.timeOf(event);
    if (this.element.hasPointerCapture(event.pointerId)) this.seek(t);
    this.tip.hidden = false;
    this.tip.style.left = `${(100 * t) / this.duration()}%`;
    const name = this.timeline?.segmentAt(t)?.name;
    setText(this.tip, name ? `${clock(t)} · ${name}` : clock(t));
  }
}

/** As much of a text as fits. */
function fitted(context: CanvasRenderingContext2D, text: string, width: number): string {
  if (context.measureText(text).width <= width) return text;
  let short = text;
  while (short.length > 1 && context.measureText(`${short}…`).width > width) short = short.slice(0, -1);
  return `${short}…`;
}
