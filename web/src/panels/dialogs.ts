import type { Timeline } from "../data/timeline.ts";
import type { PictureStore } from "../pictures/picture_store.ts";
import { kindName } from "../ui/format.ts";
import { el, setText } from "../ui/dom.ts";
import { icon } from "../ui/icons.ts";
import { PicturePair } from "./camera_view.ts";

const kKeys: [string, string][] = [
  ["Space", "play, hold"],
  ["← →", "view before, next view"],
  ["PgUp PgDn", "segment before, next segment"],
  ["Home End", "begin, end"],
  ["+ −", "faster, slower"],
  ["L", "stay with the newest"],
  ["1 … 9 0", "layers"],
  ["R W C", "look at the robot, the whole row, over the camera’s shoulder"],
  ["F", "look at what was picked"],
  ["D", "detection over the picture"],
  ["T", "light, dark"],
  ["Esc", "leave what was picked"],
  ["?", "this help"],
];

function closing(dialog: HTMLDialogElement): HTMLElement {
  return el("button", { class: "round close", label: "Close", on: { click: () => dialog.close() } }, icon("close"));
}

/** Says which keys do what. */
export class HelpDialog {
  readonly element = el("dialog", { class: "help", label: "Keys" });

  constructor() {
    const rows = kKeys.map(([key, what]) => el("div", {}, el("dt", {}, ...key.split(" ").map((k) => el("kbd", {}, k))), el("dd", {}, what)));
    this.element.append(
      closing(this.element),
      el("h2", {}, "Keys"),
      el("dl", {}, ...rows),
      el("p", { class: "hint" }, "Drag turns the picture, the wheel moves nearer, right drag shifts. Click a fruit or a view to read about it."),
    );
  }

  toggle(): void {
    if (this.element.open) this.element.close();
    else this.element.showModal();
  }
}

/** The pictures of a view, large. */
export class PictureDialog {
  readonly element = el("dialog", { class: "large", label: "Pictures of a view" });
  private readonly title = el("h2");
  private readonly pair: PicturePair;

  constructor(store: PictureStore) {
    this.pair = new PicturePair(store, null);
    this.element.append(closing(this.element), this.title, this.pair.element);
    this.element.addEventListener("click", (e) => e.target === this.element && this.element.close());
  }

  show(timeline: Timeline, number: number): void {
    const view = timeline.view(number);
    setText(this.title, `View ${number}${view ? ` · ${kindName(view.kind)}` : ""}`);
    this.pair.show(number);
    if (!this.element.open) this.element.showModal();
  }

  close(): void {
    this.element.close();
  }
}
