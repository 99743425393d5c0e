import type { App } from "../app.ts";
import type { View } from "../data/messages.ts";
import type { Timeline } from "../data/timeline.ts";
import type { Moment, Selection } from "../moment.ts";
import { Pointer } from "./pointer.ts";
import { SceneProbe } from "./probe.ts";
import { Stage } from "./stage.ts";
import { World } from "./world.ts";

/** How near the eye goes to what was picked. */
const kNearby_m = 0.8;

/** The 3D picture as the page uses it. */
export class Scene {
  private readonly world: World;
  /** For tests in a browser. */
  readonly probe: SceneProbe;
  private moment: Moment | null = null;

  constructor(holder: HTMLElement, app: App) {
    const stage = new Stage(holder);
    stage.canvas.setAttribute("aria-label", "The row, the robot and what it knows, in 3D");
    this.world = new World(stage, app.layers, app.theme);
    this.probe = new SceneProbe(this.world, app.layers);
    stage.controls.addEventListener("start", () => this.world.setFollow(false));
    new Pointer(holder, this.world, app.layers, () => this.moment, (selection) => {
      if (selection?.is === "view") app.selectView(selection.view);
      if (selection?.is === "fruit") app.selectFruit(selection.id);
    });
    app.layers.listen(() => this.moment && this.show(this.moment));
  }

  load(timeline: Timeline): void {
    this.moment = null;
    this.world.load(timeline);
  }

  show(moment: Moment): void {
    this.moment = moment;
    this.world.show(moment.t, moment.step);
  }

  choose(selection: Selection, view: View | null): void {
    this.world.chooseView(view);
    this.world.chooseFruit(selection?.is === "fruit" ? selection.id : -1);
  }

  /** From nearby. */
  lookAt(point: readonly [number, number, number]): void {
    this.world.setFollow(false);
    this.world.lookAt(point, kNearby_m);
  }

  look(where: "robot" | "row" | "camera", t: number): void {
    this.world.setFollow(where === "camera");
    if (where === "camera") {
      if (this.moment) this.show(this.moment);
    } else {
      this.world.frame(where === "row", t);
    }
  }

  /** What the camera saw in a view; null: there is no picture. */
  setPicture(image: ImageBitmap | null, view: View | null): void {
    this.world.hangPicture(view && image, view);
  }
}

/** Null where the browser has no WebGL 2. */
export function openScene(holder: HTMLElement, app: App): Scene | null {
  try {
    return new Scene(holder, app);
  } catch (error) {
    console.warn(error);
    return null;
  }
}
