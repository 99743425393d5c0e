import * as THREE from "three";
import { type Configuration, linkPoses } from "../data/kinematics.ts";
import type { Robot, Shape } from "../data/messages.ts";
import type { Palette } from "../theme.ts";
import { matrixOf } from "./matrices.ts";

/** The robot's links as they stand. */
export class RobotModel {
  readonly group = new THREE.Group();
  private robot: Robot | null = null;
  private links: THREE.Group[] = [];
  private readonly light = new THREE.MeshLambertMaterial();
  private readonly dark = new THREE.MeshLambertMaterial();
  private readonly lens = new THREE.MeshLambertMaterial({ color: 0x20262a });

  set(robot: Robot): void {
    this.clear();
    this.robot = robot;
    this.links = robot.links.map((link, i) => {
      const group = new THREE.Group();
      group.matrixAutoUpdate = false;
      const material = i === robot.cameraLink ? this.lens : moves(robot, i) ? this.light : this.dark;
      for (const shape of link.shapes) group.add(shapeMesh(shape, material));
      this.group.add(group);
      return group;
    });
  }

  clear(): void {
    for (const link of this.links) for (const child of link.children) (child as THREE.Mesh).geometry.dispose();
    this.group.clear();
    this.links = [];
    this.robot = null;
  }

  paint(palette: Palette): void {
    this.light.color.set(palette.robot);
    this.dark.color.set(palette.robotDark);
  }

  move(at: Configuration): void {
    if (!this.robot) return;
    linkPoses(this.robot, at).forEach((T, i) => {
      this.links[i].matrix.copy(matrixOf(T));
      this.links[i].matrixWorldNeedsUpdate = true;
    });
  }

  /** A point in the middle of its largest part. */
  somewhere(): [number, number, number] {
    const boxes = this.links.map((link) => new THREE.Box3().setFromObject(link));
    boxes.sort((a, b) => b.getSize(new THREE.Vector3()).length() - a.getSize(new THREE.Vector3()).length());
    return (boxes[0] ?? new THREE.Box3()).getCenter(new THREE.Vector3()).toArray();
  }

}

/** Whether an arm joint is on the way to this link. */
function moves(robot: Robot, link: number): boolean {
  for (let i = link; i >= 0; i = robot.links[i].parent)
    if (robot.links[i].source === "arm") return true;
  return false;
}

function shapeMesh(shape: Shape, material: THREE.Material): THREE.Mesh {
  const mesh = new THREE.Mesh(shapeGeometry(shape), material);
  mesh.matrixAutoUpdate = false;
  mesh.matrix.copy(matrixOf(shape.pose));
  return mesh;
}

function shapeGeometry(shape: Shape): THREE.BufferGeometry {
  switch (shape.kind) {
    case "box":
      return new THREE.BoxGeometry(...shape.size);
    case "sphere":
      return new THREE.SphereGeometry(shape.radius, 24, 16);
    case "cylinder":
      // URDF's cylinders stand along z, three.js's along y.
      return new THREE.CylinderGeometry(shape.radius, shape.radius, shape.length, 28).rotateX(Math.PI / 2);
    case "mesh": {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(shape.vertices, 3));
      geometry.setIndex(new THREE.BufferAttribute(shape.triangles, 1));
      // Corners of their own: edges of machine parts stay sharp.
      const flat = geometry.toNonIndexed();
      flat.computeVertexNormals();
      return flat;
    }
  }
}
