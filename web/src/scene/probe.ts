import * as THREE from "three";
import type { LayerId, Layers } from "../layers.ts";
import type { World } from "./world.ts";

type Point = readonly [number, number, number];

/** Looks into the 3D picture, for tests in a browser. */
export class SceneProbe {
  constructor(
    private readonly world: World,
    private readonly layers: Layers,
  ) {}

  get figures(): { frames: number; frame_ms: number; voxels: number; slow: boolean } {
    const { frames, frame_ms, slow } = this.world.stage;
    return { frames, frame_ms, voxels: this.world.map.count, slow };
  }

  /** What the graphics card holds. */
  get held(): { geometries: number; textures: number } {
    return this.world.stage.renderer.info.memory;
  }

  /** The robot where it works and the first plants have been drawn. */
  get furnished(): boolean {
    return this.world.furnishedAt < this.world.stage.frames;
  }

  /** All voxels of this moment are drawn, and all plants. */
  get settled(): boolean {
    return this.world.stage.frames > 0 && this.world.map.pending + this.world.truth.pending === 0;
  }

  /** A fruit in sight, in pixels of the page. */
  someFruit(): { id: number; x: number; y: number } | null {
    const { left, top, width, height } = this.world.stage.canvas.getBoundingClientRect();
    for (const fruit of this.world.fruits.fruits) {
      const at = this.world.stage.toScreen(new THREE.Vector3(...fruit.centre));
      const inside = at.x > 0.3 * width && at.x < 0.85 * width && at.y > 0.1 * height && at.y < 0.9 * height;
      if (inside) return { id: fruit.id, x: left + at.x, y: top + at.y };
    }
    return null;
  }

  /** The colour where a layer has something, with the layer and without; all other layers off. */
  compare(layer: LayerId): [number[], number[]] {
    const point = this.pointOf(layer);
    const before = this.layers.shown;
    const only = (ids: LayerId[]) => this.layers.show(ids);
    only([layer]);
    const on = this.colorAt(point);
    only([]);
    const off = this.colorAt(point);
    only(before);
    return [on, off];
  }

  /** Until the moment that was asked for is drawn, all of it and finely; so are all from then on. */
  async still(): Promise<void> {
    const { stage } = this.world;
    const frame = () => new Promise((resume) => requestAnimationFrame(resume));
    stage.patient = true;
    await frame();
    do {
      stage.ask();
      await frame();
    } while (!this.settled);
    await frame();
  }

  /** Turns the camera for so long; frames a second. */
  async turn(milliseconds: number): Promise<number> {
    const { stage } = this.world;
    const { target } = stage.controls;
    const begin = performance.now();
    const first = stage.frames;
    while (performance.now() - begin < milliseconds) {
      const away = stage.camera.position.clone().sub(target);
      stage.camera.position.copy(away.applyAxisAngle(stage.camera.up, 0.02).add(target));
      stage.ask();
      await new Promise((resume) => requestAnimationFrame(resume));
    }
    return (1000 * (stage.frames - first)) / (performance.now() - begin);
  }

  private colorAt(point: Point): number[] {
    const { stage } = this.world;
    stage.drawNow();
    const { canvas } = stage;
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    copy?.drawImage(canvas, 0, 0);
    const at = stage.toScreen(new THREE.Vector3(...point));
    const scale = canvas.width / canvas.clientWidth;
    return [...(copy?.getImageData(Math.round(at.x * scale), Math.round(at.y * scale), 1, 1).data ?? [])];
  }

  private pointOf(layer: LayerId): Point {
    const { world } = this;
    switch (layer) {
      case "robot":
        return world.robot.somewhere();
      case "occupied":
        return world.map.somewhere(1);
      case "roi":
        return world.map.somewhere(2);
      case "fruits":
        return world.fruits.fruits[0]?.centre ?? [0, 0, 0];
      default:
        return world.truth.somewhere();
    }
  }
}
