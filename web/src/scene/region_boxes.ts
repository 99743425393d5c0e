import * as THREE from "three";
import type { Segment } from "../data/messages.ts";
import type { Palette } from "../theme.ts";

/** Where the camera may be (solid) and where targets are sought (fainter) in the present segment. */
export class RegionBoxes {
  readonly group = new THREE.Group();
  private readonly workspace = new THREE.Box3Helper(new THREE.Box3());
  private readonly region = new THREE.Box3Helper(new THREE.Box3());

  constructor() {
    this.group.add(this.workspace, this.region);
    this.show(null);
  }

  show(segment: Segment | null): void {
    set(this.workspace, segment?.workspace);
    set(this.region, segment?.region);
  }

  paint(palette: Palette): void {
    (this.workspace.material as THREE.LineBasicMaterial).color.set(palette.muted);
    (this.region.material as THREE.LineBasicMaterial).color.set(palette.border);
  }
}

/** A box of six numbers; the empty box where there are none. */
export function boxOf(numbers: number[] | undefined): THREE.Box3 {
  if (numbers?.length !== 6) return new THREE.Box3();
  const [a, b, c, d, e, f] = numbers;
  return new THREE.Box3(new THREE.Vector3(a, b, c), new THREE.Vector3(d, e, f));
}

function set(helper: THREE.Box3Helper, numbers: number[] | undefined): void {
  helper.box.copy(boxOf(numbers));
  helper.visible = !helper.box.isEmpty();
}
