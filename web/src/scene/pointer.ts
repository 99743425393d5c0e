import * as THREE from "three";
import type { Moment, Selection } from "../moment.ts";
import type { Layers } from "../layers.ts";
import { kindName, percent, whole } from "../ui/format.ts";
import { el, setText } from "../ui/dom.ts";
import type { World } from "./world.ts";

interface Candidate {
  selection: Selection;
  label: string;
  point: readonly [number, number, number];
  radius_m: number;
}

/** How near a click must come, in pixels. */
const kReach = { mouse: 9, touch: 20 };

/** What is under the pointer in the 3D picture: says it, and picks it at a click. */
export class Pointer {
  private readonly label = el("div", { class: "hover", hidden: true });
  private down: { x: number; y: number } | null = null;

  constructor(
    holder: HTMLElement,
    private readonly world: World,
    private readonly layers: Layers,
    private readonly moment: () => Moment | null,
    private readonly pick: (selection: Selection) => void,
  ) {
    holder.append(this.label);
    const { canvas } = world.stage;
    canvas.addEventListener("pointermove", (e) => this.hover(e));
    canvas.addEventListener("pointerleave", () => (this.label.hidden = true));
    canvas.addEventListener("pointerdown", (e) => (this.down = { x: e.clientX, y: e.clientY }));
    canvas.addEventListener("pointerup", (e) => this.up(e));
  }

  private up(event: PointerEvent): void {
    const moved = this.down ? Math.hypot(event.clientX - this.down.x, event.clientY - this.down.y) : 99;
    this.down = null;
    if (moved > 5 || event.button !== 0) return;
    const found = this.find(event);
    if (found?.selection) this.pick(found.selection);
  }

  private hover(event: PointerEvent): void {
    const found = event.buttons === 0 && event.pointerType === "mouse" ? this.find(event) : null;
    this.label.hidden = !found;
    this.world.stage.canvas.style.cursor = found ? "pointer" : "";
    if (!found) return;
    setText(this.label, found.label);
    const box = this.world.stage.canvas.getBoundingClientRect();
    this.label.style.left = `${event.clientX - box.left}px`;
    this.label.style.top = `${event.clientY - box.top}px`;
  }

  /** The nearest to the pointer; of those it is over, the nearest to the eye. */
  private find(event: PointerEvent): Candidate | null {
    const { stage } = this.world;
    const box = stage.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const reach = event.pointerType === "touch" ? kReach.touch : kReach.mouse;
    let best: { candidate: Candidate; miss: number; distance: number } | null = null;
    const point = new THREE.Vector3();
    for (const candidate of this.candidates()) {
      point.set(...candidate.point);
      const at = stage.toScreen(point);
      if (at.depth > 1) continue;
      const distance = stage.camera.position.distanceTo(point);
      const radius = candidate.radius_m * stage.pixelsPerMetre(distance);
      const miss = Math.max(0, Math.hypot(at.x - x, at.y - y) - radius);
      if (miss > reach) continue;
      if (!best || miss < best.miss || (miss === best.miss && distance < best.distance))
        best = { candidate, miss, distance };
    }
    return best?.candidate ?? null;
  }

  private *candidates(): Generator<Candidate> {
    const moment = this.moment();
    if (!moment) return;
    if (this.layers.isOn("fruits"))
      for (const fruit of this.world.fruits.fruits)
        yield {
          selection: { is: "fruit", id: fruit.id },
          label: `Fruit ${fruit.id} · ${fruit.volume.toFixed(0)} cm³ · ${percent(fruit.confidence)} sure`,
          point: fruit.centre,
          radius_m: Math.max(...fruit.semiAxes),
        };
    const { timeline, t } = moment;
    if (this.layers.isOn("views") || this.layers.isOn("graph"))
      for (const view of timeline.views) {
        if (view.t > t) break;
        const T = view.T_world_camera;
        yield {
          selection: { is: "view", view: view.view },
          label: `View ${view.view} · ${kindName(view.kind)} · promised ${whole(view.predicted)}, seen ${whole(view.realised)}`,
          point: [T[3], T[7], T[11]],
          radius_m: 0.012,
        };
      }
    if (this.layers.isOn("onTheWay"))
      for (const look of timeline.looks.slice(0, timeline.looksBy(t)))
        yield {
          selection: null,
          label: `On the way · blurred by ${look.blur.toFixed(1)} px · seen ${whole(look.realised)}`,
          point: look.at,
          radius_m: 0.004,
        };
    if (this.layers.isOn("graph"))
      for (const node of this.world.graph.nodes)
        yield {
          selection: null,
          label: `Possible view · looks for ${kindName(node.kind)}`,
          point: node.position,
          radius_m: 0.004,
        };
  }
}
