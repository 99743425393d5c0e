import * as THREE from "three";
import type { Pose } from "../data/fields.ts";

/** A pose as three.js has it. */
export function matrixOf(T: Pose): THREE.Matrix4 {
  return new THREE.Matrix4().set(
    T[0], T[1], T[2], T[3],
    T[4], T[5], T[6], T[7],
    T[8], T[9], T[10], T[11],
    0, 0, 0, 1,
  ); // prettier-ignore
}

/** Frees what three.js keeps on the graphics card. */
export function dispose(object: THREE.Object3D): void {
  object.traverse((child) => {
    const mesh = child as Partial<THREE.Mesh>;
    mesh.geometry?.dispose();
    for (const material of [mesh.material ?? []].flat()) material.dispose();
  });
  object.removeFromParent();
}
