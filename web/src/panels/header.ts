import type { Moment } from "../moment.ts";
import { clock, whole } from "../ui/format.ts";
import { el, setText } from "../ui/dom.ts";
import { icon } from "../ui/icons.ts";

export type RunStatus = "connecting" | "live" | "replay" | "done" | "lost" | "stopped early" | "cut off";

/** The line above: which run, and how it stands. */
export class Header {
  readonly element: HTMLElement;
  private readonly mission = el("h1", {}, "…");
  private readonly about = el("p", { class: "about" });
  private readonly status = el("span", { class: "status", role: "status" });
  private readonly figures: Record<"time" | "segment" | "view" | "looks" | "fruits" | "voxels", HTMLElement>;

  private readonly lookBox: HTMLElement;
  private readonly report = el("a", { class: "plain", href: `report.html${location.search}`, hidden: true }, "Report");

  constructor(actions: { theme(): void; help(): void }) {
    const figure = (name: string, wide = "") => {
      const value = el("dd");
      return { value, box: el("div", { class: `figure ${wide}` }, el("dt", {}, name), value) };
    };
    const time = figure("Time");
    const segment = figure("Segment", "wide");
    const view = figure("View");
    const looks = figure("On the way");
    looks.box.title = "Frames taken while the arm or the trolley moved";
    looks.box.hidden = true;
    this.lookBox = looks.box;
    const fruits = figure("Fruits");
    const voxels = figure("Fruit voxels");
    this.figures = {
      time: time.value,
      segment: segment.value,
      view: view.value,
      looks: looks.value,
      fruits: fruits.value,
      voxels: voxels.value,
    };
    this.element = el(
      "header",
      { class: "top" },
      el("div", { class: "title" }, el("div", { class: "name" }, this.mission, this.status), this.about),
      el("dl", { class: "figures" }, time.box, segment.box, view.box, looks.box, fruits.box, voxels.box),
      el(
        "div",
        { class: "tools" },
        this.report,
        el("button", { class: "round", label: "Light or dark", title: "Light or dark (T)", on: { click: actions.theme } }, icon("theme")),
        el("button", { class: "round", label: "Help: keys", title: "Keys (?)", on: { click: actions.help } }, "?"),
      ),
    );
  }

  setStatus(status: RunStatus): void {
    this.status.dataset.status = status;
    setText(this.status, status);
  }

  update({ timeline, t, step, view, segment }: Moment): void {
    const { hello } = timeline;
    if (hello) {
      setText(this.mission, hello.mission || "Canopeer");
      const parts = [hello.planner, hello.seed && `seed ${hello.seed}`, hello.simulated ? "simulated" : "on the robot"];
      setText(this.about, parts.filter(Boolean).join(" · "));
      document.title = `${hello.mission} – Canopeer`;
    }
    this.report.hidden = timeline.end === null;
    setText(this.figures.time, clock(t));
    const total = Math.max(hello?.segments ?? 0, timeline.segments.length);
    setText(this.figures.segment, segment ? `${segment.segment + 1}/${total} ${segment.name}` : "–");
    this.figures.segment.title = segment?.name ?? "";
    const views = timeline.views.length;
    setText(this.figures.view, view ? `${view.view} / ${timeline.views[views - 1].view}` : "–");
    const looks = timeline.looks.length;
    this.lookBox.hidden = looks === 0;
    setText(this.figures.looks, `${timeline.looksBy(t)} / ${looks}`);
    const counted = timeline.truth?.fruits.filter((f) => f.counted).length;
    let fruits = 0;
    for (const _ of timeline.fruits.entriesAt(step)) ++fruits;
    setText(this.figures.fruits, counted === undefined ? whole(fruits) : `${whole(fruits)} / ${counted}`);
    setText(this.figures.voxels, whole(view?.roiVoxels ?? null));
  }
}
