import type { View } from "../data/messages.ts";
import type { Timeline } from "../data/timeline.ts";
import type { Actions, Moment, Selection } from "../moment.ts";
import { depthPicture, detectionOverlay, paintLayers } from "../pictures/paint.ts";
import { depthGradient } from "../pictures/false_color.ts";
import type { PictureStore } from "../pictures/picture_store.ts";
import { kindName, shortClock } from "../ui/format.ts";
import { el, setText } from "../ui/dom.ts";
import { same } from "../ui/same.ts";

/** What the pictures of a view are drawn from: differs where they must be drawn anew. */
export function picturesDrawn(timeline: Timeline | null, view: number | null, overlay: boolean): unknown[] {
  const { color, depth, fruit } = (view === null ? null : timeline?.pictures.get(view)) ?? {};
  return [timeline, view, overlay, color, depth, fruit];
}

/** A pair of pictures of one view: colour with the detection over it, and depth with its scale. */
export class PicturePair {
  readonly element: HTMLElement;
  overlay = true;
  /** After a picture was drawn. */
  onColor: (image: ImageBitmap | null, view: number) => void = () => {};
  private readonly color = el("canvas", { role: "img", label: "What the camera sees" });
  private readonly depth = el("canvas", { role: "img", label: "Depth" });
  private readonly near = el("span");
  private readonly far = el("span");
  private readonly none = el("p", { class: "none" }, "No picture.");
  private shown: unknown[] = [];
  private busy = false;
  private wanted: number | null = null;

  constructor(
    private readonly store: PictureStore,
    enlarge: (() => void) | null,
  ) {
    const scale = el("i", { class: "scale" });
    scale.style.background = depthGradient();
    const frame = (canvas: HTMLCanvasElement, name: string) =>
      enlarge
        ? el("button", { class: "frame", label: `${name}: enlarge`, on: { click: enlarge } }, canvas)
        : el("div", { class: "frame" }, canvas);
    this.element = el(
      "div",
      { class: "pair" },
      el("figure", {}, frame(this.color, "Colour"), el("figcaption", {}, el("i", { class: "detected" }), "taken for fruit")),
      el("figure", {}, frame(this.depth, "Depth"), el("figcaption", {}, this.near, scale, this.far)),
      this.none,
    );
  }

  show(view: number | null): void {
    this.wanted = view;
    if (!this.busy) void this.draw();
  }

  /** One at a time; the newest wish wins, and the newest run. */
  private async draw(): Promise<void> {
    const view = this.wanted;
    const as = picturesDrawn(this.store.timeline, view, this.overlay);
    if (same(as, this.shown)) return;
    const pictures = view === null ? undefined : this.store.timeline?.pictures.get(view);
    this.busy = true;
    try {
      const at = view ?? -1;
      const [color, mask, depth] = await Promise.all([this.store.color(at), this.store.fruit(at), this.store.depth(at)]);
      paintLayers(this.color, [color, mask && this.overlay ? detectionOverlay(mask) : null]);
      paintLayers(this.depth, [depth && depthPicture(depth)]);
      this.none.hidden = color !== null || depth !== null;
      setText(this.near, pictures?.depth ? `${pictures.depth.min.toFixed(2)} m` : "near");
      setText(this.far, pictures?.depth ? `${pictures.depth.max.toFixed(2)} m` : "far");
      this.shown = as;
      this.onColor(color, at);
    } finally {
      this.busy = false;
    }
    void this.draw();
  }
}

/** What the camera saw last, or in the view that was picked. */
export class CameraPanel {
  readonly element: HTMLElement;
  readonly pair: PicturePair;
  private readonly caption = el("p", { class: "caption" });
  private readonly overlay = el("input", { type: "checkbox", checked: true });
  private view: View | null = null;

  constructor(store: PictureStore, actions: Actions) {
    this.pair = new PicturePair(store, () => this.view && actions.enlarge(this.view.view));
    this.overlay.addEventListener("change", () => this.showOverlay());
    this.element = el(
      "section",
      { class: "card camera", label: "Camera" },
      el("div", { class: "card-head" }, el("h2", {}, "Camera"), this.caption, el("label", { class: "check" }, this.overlay, "Detection")),
      this.pair.element,
    );
  }

  update(moment: Moment, selection: Selection): void {
    const picked = selection?.is === "view" ? moment.timeline.view(selection.view) : null;
    const view = picked ?? moment.view;
    this.view = view;
    const what = picked ? "Picked: view" : "View";
    setText(this.caption, view ? `${what} ${view.view} · ${kindName(view.kind)} · ${shortClock(view.t)}` : "No view yet");
    this.pair.show(view?.view ?? null);
  }

  toggleOverlay(): void {
    this.overlay.checked = !this.overlay.checked;
    this.showOverlay();
  }

  private showOverlay(): void {
    this.pair.overlay = this.overlay.checked;
    this.pair.show(this.view?.view ?? null);
  }
}
