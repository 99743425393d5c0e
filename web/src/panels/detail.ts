import type { Fruit, View } from "../data/messages.ts";
import type { Timeline } from "../data/timeline.ts";
import type { Actions, Moment, Selection } from "../moment.ts";
import { type Sighting, sightings } from "../pictures/sightings.ts";
import type { PictureStore } from "../pictures/picture_store.ts";
import { clock, kindName, percent, seconds, whole } from "../ui/format.ts";
import { el, fill, setText } from "../ui/dom.ts";
import { icon } from "../ui/icons.ts";
import { same } from "../ui/same.ts";
import { swatch } from "./fruit_list.ts";
import { outlines } from "./outline.ts";

/** Pictures of a fruit that are shown at most, evenly among all that saw it. */
const kThumbs = 12;

const kNone: Fruit[] = [];

/** What was picked out: a view, or a fruit. Takes the place of the tabs while it is there. */
export class Detail {
  readonly element: HTMLElement;
  private readonly title = el("h2");
  private readonly body = el("div", { class: "detail-body" });
  private shownAs: unknown[] = [];
  private thumbs = el("div", { class: "thumbs" });
  private thumbsOf: unknown[] = [];
  private asked = 0;

  constructor(
    private readonly store: PictureStore,
    private readonly actions: Actions,
  ) {
    this.element = el(
      "section",
      { class: "card detail", hidden: true, label: "What was picked" },
      el(
        "div",
        { class: "card-head" },
        el("button", { class: "round", label: "Back", title: "Back (Esc)", on: { click: () => actions.clearSelection() } }, icon("back")),
        this.title,
      ),
      this.body,
    );
  }

  update(moment: Moment, selection: Selection): void {
    this.element.hidden = selection === null;
    if (selection?.is === "view") this.showView(moment.timeline, selection.view);
    else if (selection?.is === "fruit") this.showFruit(moment, selection.id);
    else this.shownAs = [];
  }

  private showView(timeline: Timeline, number: number): void {
    const view = timeline.view(number);
    const index = view ? timeline.views.indexOf(view) : -1;
    const changed = timeline.fruitsOfView.get(number) ?? kNone;
    const as = [timeline, number, view, timeline.views[index + 1], changed];
    if (same(as, this.shownAs)) return;
    this.shownAs = as;
    setText(this.title, `View ${number}`);
    if (!view) return fill(this.body, el("p", { class: "none" }, "There is no such view."));
    const go = (by: number, name: string) => {
      const other = timeline.views[index + by];
      return el("button", { class: "plain", disabled: !other, on: { click: () => other && this.actions.selectView(other.view) } }, name);
    };
    fill(
      this.body,
      el("div", { class: "buttons" }, go(-1, "Earlier"), go(1, "Later"), this.lookButton(), el("button", { class: "plain", on: { click: () => this.actions.enlarge(number) } }, "Large pictures")),
      viewFigures(view),
      el("h3", {}, changed.length > 0 ? "Fruits found or changed" : "No fruit changed"),
      el("div", { class: "chips" }, ...changed.map((f) => this.fruitChip(f))),
    );
  }

  private lookButton(): HTMLElement {
    return el("button", { class: "plain", title: "From nearby (F)", on: { click: () => this.actions.lookAtSelection() } }, "Look at it");
  }

  private fruitChip(fruit: Fruit): HTMLElement {
    return el("button", { class: "chip", on: { click: () => this.actions.selectFruit(fruit.id) } }, swatch(fruit), `Fruit ${fruit.id}`);
  }

  private showFruit({ timeline, step, t, view }: Moment, id: number): void {
    const fruit = timeline.fruits.at(id, step);
    const points = timeline.surfaceOf(id, step);
    const as = [timeline, id, fruit, view, points];
    if (same(as, this.shownAs)) return;
    this.shownAs = as;
    setText(this.title, `Fruit ${id}`);
    if (!fruit) return fill(this.body, el("p", { class: "none" }, "Not known at this time."));
    if (!same(this.thumbsOf, [timeline, id])) {
      this.thumbsOf = [timeline, id];
      this.thumbs = el("div", { class: "thumbs" });
    }
    const { thumbs } = this;
    const heading = el("h3", {}, "Pictures that saw it");
    fill(this.body, el("div", { class: "buttons" }, this.lookButton()), outlines(fruit, points), fruitFigures(fruit), heading, thumbs);
    void this.findPictures(timeline, fruit, t, thumbs, heading);
  }

  private async findPictures(timeline: Timeline, fruit: Fruit, t: number, thumbs: HTMLElement, heading: HTMLElement): Promise<void> {
    const asked = ++this.asked;
    const all = await sightings(timeline, this.store, fruit, t);
    if (asked !== this.asked) return;
    setText(heading, `Pictures that saw it: ${all.length}`);
    const share = Math.max(1, all.length / kThumbs);
    const chosen = Array.from({ length: Math.min(kThumbs, all.length) }, (_, i) => all[Math.floor(i * share)]);
    const made = await Promise.all(chosen.map((s) => this.thumb(timeline, s)));
    if (asked === this.asked) fill(thumbs, ...made);
  }

  private async thumb(timeline: Timeline, sighting: Sighting): Promise<HTMLElement> {
    const canvas = el("canvas", { width: 96, height: 96 });
    const image = await this.store.color(sighting.view.view);
    const camera = timeline.cameraOf(sighting.view);
    const context = canvas.getContext("2d");
    if (image && camera && context) {
      const scale = image.width / camera.width;
      const half = Math.max(14, 2.2 * sighting.radius * scale);
      const [u, v] = [sighting.u * scale, sighting.v * scale];
      context.drawImage(image, u - half, v - half, 2 * half, 2 * half, 0, 0, 96, 96);
      context.strokeStyle = "#fff";
      context.lineWidth = 1.5;
      context.beginPath();
      context.arc(48, 48, (48 * sighting.radius * scale * 1.15) / half, 0, 2 * Math.PI);
      context.stroke();
    }
    const name = `View ${sighting.view.view}`;
    return el("button", { class: "thumb", label: name, on: { click: () => this.actions.selectView(sighting.view.view) } }, canvas, el("span", {}, name));
  }
}

function figures(entries: [string, string][]): HTMLElement {
  return el("dl", { class: "facts" }, ...entries.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value))));
}

function viewFigures(view: View): HTMLElement {
  return figures([
    ["Looks for", kindName(view.kind)],
    ["Time", clock(view.t)],
    ["Promised", view.predicted === null ? "nothing said" : `${whole(view.predicted)} voxels`],
    ["Seen", view.realised === null ? "–" : `${whole(view.realised)} voxels`],
    ["Points", whole(view.points)],
    ["Fruit voxels", whole(view.roiVoxels)],
    ["Planned for", seconds(view.planning)],
    ["Moved for", seconds(view.motion)],
    ["Fruits known", whole(view.fruits)],
    ["Graph", `${whole(view.nodes)} · ${whole(view.edges)} ways`],
  ]);
}

function fruitFigures(fruit: Fruit): HTMLElement {
  return figures([
    ["Volume", `${fruit.volume.toFixed(1)} cm³`],
    ["Sure", percent(fruit.confidence)],
    ["Ripeness", fruit.ripeness || "–"],
    ["Size", fruit.semiAxes.map((a) => (200 * a).toFixed(1)).join(" × ") + " cm"],
    ["Centre", fruit.centre.map((c) => c.toFixed(2)).join(", ") + " m"],
    ["Surface seen", percent(fruit.seenShare)],
    ["Points", whole(fruit.points)],
    ["Views", whole(fruit.views)],
    ["First seen", clock(fruit.first)],
    ["Last seen", clock(fruit.last)],
  ]);
}
