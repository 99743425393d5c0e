import * as THREE from "three";
import { compose, fromRollPitchYaw, identity } from "../data/kinematics.ts";
import type { Pose } from "../data/fields.ts";
import type { History } from "../data/history.ts";
import type { Fruit } from "../data/messages.ts";
import { fruitColor } from "../fruit_color.ts";
import type { Palette } from "../theme.ts";
import { dispose, matrixOf } from "./matrices.ts";
import { surface } from "./superellipsoid.ts";

/** T_world_fruit */
export function fruitPose(fruit: Fruit): Pose {
  const move = identity();
  for (let i = 0; i < 3; ++i) move[4 * i + 3] = fruit.centre[i];
  return compose(move, fromRollPitchYaw(fruit.rpy));
}

interface Shown {
  fruit: Fruit;
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshLambertMaterial>;
  rim: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>;
}

/** The fruits as fitted: the surer, the more solid. */
export class FruitShapes {
  readonly group = new THREE.Group();
  private readonly shown = new Map<number, Shown>();
  private readonly rimMaterial = new THREE.MeshBasicMaterial({ side: THREE.BackSide });
  private readonly chosenMaterial = new THREE.MeshBasicMaterial({ side: THREE.BackSide });
  private readonly rims = new THREE.Group();
  private readonly exact = new THREE.Group();
  /** All fruits as they are now, once somebody wants them coarse. */
  private rough: THREE.InstancedMesh | null = null;
  private step = -1;
  private selected = -1;

  constructor() {
    this.group.add(this.rims, this.exact);
  }

  get fruits(): Fruit[] {
    return [...this.shown.values()].map((s) => s.fruit);
  }

  show(history: History<Fruit>, step: number): void {
    if (step === this.step) return;
    for (const id of history.changedBetween(this.step, step)) {
      const fruit = history.at(id, step);
      if (fruit === this.shown.get(id)?.fruit) continue;
      this.drop(id);
      if (fruit) this.add(fruit);
    }
    this.step = step;
  }

  select(id: number): void {
    this.selected = id;
    for (const [other, { rim }] of this.shown)
      rim.material = other === id ? this.chosenMaterial : this.rimMaterial;
  }

  paint(palette: Palette): void {
    this.rimMaterial.color.set(palette.ink);
    this.chosenMaterial.color.set(palette.accent);
  }

  /** As ellipsoids without outlines, all drawn at once. */
  setCoarse(coarse: boolean): void {
    if (coarse && !this.rough) this.group.add((this.rough = ellipsoids(this.shown)));
    if (this.rough) this.rough.visible = coarse;
    this.rims.visible = this.exact.visible = !coarse;
  }

  reset(): void {
    for (const id of [...this.shown.keys()]) this.drop(id);
    this.step = -1;
  }

  private add(fruit: Fruit): void {
    this.forgetRough();
    const { points, triangles } = surface(fruit, 12, 20);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    geometry.setIndex(triangles);
    geometry.computeVertexNormals();
    const [r, g, b] = fruitColor(fruit).map((c) => c / 255);
    const sure = Math.min(1, Math.max(0, fruit.confidence));
    const mesh = new THREE.Mesh(
      geometry,
      new THREE.MeshLambertMaterial({
        color: new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace),
        transparent: sure < 0.95,
        opacity: 0.25 + 0.75 * sure,
      }),
    );
    const T = matrixOf(fruitPose(fruit));
    const rim = new THREE.Mesh(geometry, fruit.id === this.selected ? this.chosenMaterial : this.rimMaterial);
    // Every shape has an outline of a millimetre or so: a slightly larger one seen from inside.
    const [a, b2, c] = fruit.semiAxes.map((s) => 1 + 0.0016 / Math.max(s, 0.005));
    rim.matrix.copy(T).scale(new THREE.Vector3(a, b2, c));
    mesh.matrix.copy(T);
    for (const object of [mesh, rim]) object.matrixAutoUpdate = false;
    this.exact.add(mesh);
    this.rims.add(rim);
    this.shown.set(fruit.id, { fruit, mesh, rim });
  }

  private forgetRough(): void {
    if (!this.rough) return;
    dispose(this.rough);
    this.rough.dispose();
    this.rough = null;
  }

  private drop(id: number): void {
    const shown = this.shown.get(id);
    if (!shown) return;
    this.forgetRough();
    this.exact.remove(shown.mesh);
    this.rims.remove(shown.rim);
    shown.mesh.geometry.dispose();
    shown.mesh.material.dispose();
    this.shown.delete(id);
  }
}

function ellipsoids(shown: ReadonlyMap<number, Shown>): THREE.InstancedMesh {
  const all = new THREE.InstancedMesh(new THREE.SphereGeometry(1, 10, 6), new THREE.MeshLambertMaterial(), shown.size);
  all.frustumCulled = false;
  [...shown.values()].forEach(({ fruit, mesh }, i) => {
    all.setMatrixAt(i, mesh.matrix.clone().scale(new THREE.Vector3(...fruit.semiAxes)));
    all.setColorAt(i, mesh.material.color);
  });
  return all;
}
