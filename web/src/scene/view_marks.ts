import * as THREE from "three";
import type { Timeline } from "../data/timeline.ts";
import { upperBound } from "../data/search.ts";
import { kindColor, type Palette } from "../theme.ts";
import { matrixOf } from "./matrices.ts";

/** What is marked: where each one is and in what colour, and when each one came, by time. */
export interface Marked {
  times: number[];
  matrix(i: number): THREE.Matrix4;
  color(i: number, palette: Palette): string;
}

/** A small pyramid where each view was taken, pointing where the camera looked. */
export function markedViews({ views, viewTimes }: Timeline): Marked {
  return {
    times: viewTimes,
    matrix: (i) => matrixOf(views[i].T_world_camera),
    color: (i, palette) => kindColor(palette, views[i].kind),
  };
}

/** A smaller one for each frame on the way. */
export function markedLooks({ looks, lookTimes }: Timeline): Marked {
  const forward = new THREE.Vector3(0, 0, 1);
  const size = new THREE.Vector3(0.45, 0.45, 0.45);
  return {
    times: lookTimes,
    matrix: (i) => {
      const turn = new THREE.Quaternion().setFromUnitVectors(forward, new THREE.Vector3(...looks[i].direction).normalize());
      return new THREE.Matrix4().compose(new THREE.Vector3(...looks[i].at), turn, size);
    },
    color: (_, palette) => palette.driven,
  };
}

/** Small pyramids where frames were taken. */
export class ViewMarks {
  readonly group = new THREE.Group();
  private mesh: THREE.InstancedMesh | null = null;
  private made = 0;
  private palette: Palette | null = null;
  private readonly geometry = pyramid();
  private readonly material = new THREE.MeshLambertMaterial({ flatShading: true, side: THREE.DoubleSide });

  constructor(private readonly marked: (timeline: Timeline) => Marked) {}

  show(timeline: Timeline, t: number): void {
    const { times, matrix, color } = this.marked(timeline);
    if (!this.mesh || this.mesh.instanceMatrix.count < times.length) this.grow(times.length);
    const mesh = this.mesh;
    if (!mesh || !this.palette) return;
    for (; this.made < times.length; ++this.made) {
      mesh.setMatrixAt(this.made, matrix(this.made));
      mesh.setColorAt(this.made, new THREE.Color(color(this.made, this.palette)));
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
    mesh.count = upperBound(times, t);
  }

  paint(palette: Palette): void {
    this.palette = palette;
    this.made = 0;
  }

  reset(): void {
    this.made = 0;
    if (this.mesh) this.mesh.count = 0;
  }

  private grow(wanted: number): void {
    this.mesh?.dispose();
    this.group.clear();
    this.mesh = new THREE.InstancedMesh(this.geometry, this.material, Math.max(64, 2 * wanted));
    this.mesh.frustumCulled = false;
    this.mesh.count = 0;
    this.group.add(this.mesh);
    this.made = 0;
  }
}

/** Its tip is the optical centre; z forward. */
function pyramid(): THREE.BufferGeometry {
  const [w, h, d] = [0.014, 0.01, 0.024];
  const geometry = new THREE.BufferGeometry();
  const corners = [0, 0, 0, -w, -h, d, w, -h, d, w, h, d, -w, h, d];
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 1, 3, 2, 1, 4, 3]);
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}
