import * as THREE from "three";
import { cameraPose } from "../data/kinematics.ts";
import type { Timeline } from "../data/timeline.ts";
import type { View } from "../data/messages.ts";
import type { Layers } from "../layers.ts";
import type { Palette, Theme } from "../theme.ts";
import { BlockCloud } from "./block_cloud.ts";
import { SurfacePoints } from "./fruit_points.ts";
import { FruitShapes } from "./fruit_shapes.ts";
import { Frustum, PictureSheet, shoulder } from "./frustum.ts";
import { GraphLines } from "./graph_lines.ts";
import { Ground } from "./ground.ts";
import { Paths } from "./paths.ts";
import { boxOf, RegionBoxes } from "./region_boxes.ts";
import { RobotModel } from "./robot_model.ts";
import { Stage } from "./stage.ts";
import { TrueFruits } from "./true_fruits.ts";
import { type TruthDetail, TruthModel } from "./truth_model.ts";
import { markedLooks, markedViews, ViewMarks } from "./view_marks.ts";
import { cloudUniforms, mapLook, targetLook } from "./voxel_looks.ts";

/** Everything in the 3D picture, at one moment of the run. */
export class World {
  readonly robot = new RobotModel();
  readonly frustum = new Frustum(0.3);
  readonly chosenFrustum = new Frustum(0.4);
  readonly sheet = new PictureSheet(0.3);
  readonly fruits = new FruitShapes();
  readonly points = new SurfacePoints();
  private chosen = -1;
  private step = -1;
  readonly graph = new GraphLines();
  readonly marks = new ViewMarks(markedViews);
  readonly looks = new ViewMarks(markedLooks);
  readonly truth = new TruthModel();
  readonly trueFruits = new TrueFruits();
  private readonly mapUniforms = cloudUniforms();
  private readonly targetUniforms = cloudUniforms();
  readonly map = new BlockCloud(mapLook(this.mapUniforms));
  readonly targets = new BlockCloud(targetLook(this.targetUniforms));
  private readonly paths = new Paths();
  private readonly boxes = new RegionBoxes();
  private readonly ground = new Ground();
  private timeline: Timeline | null = null;
  private known = { robot: false, truth: false, segments: -1 };
  private follow = false;
  /** Frames that had been drawn when the still parts of the run had come. */
  furnishedAt = Infinity;
  /** The mission the eye was brought to. */
  private framed: string | null = null;

  constructor(
    readonly stage: Stage,
    private readonly layers: Layers,
    theme: Theme,
  ) {
    if (stage.slow) this.map.cubeLimit = 12000;
    stage.scene.add(
      this.ground.group, this.truth.plants, this.truth.around, this.trueFruits.group, this.robot.group,
      this.map.group, this.targets.group, this.graph.group, this.paths.driven,
      this.paths.planned, this.fruits.group, this.points.group, this.marks.group, this.looks.group, this.boxes.group,
      this.frustum.group, this.chosenFrustum.group, this.sheet.group,
    ); // prettier-ignore
    this.chosenFrustum.group.visible = false;
    theme.use((palette) => this.paint(palette));
    layers.listen(() => this.applyLayers());
    stage.beforeFrame(() => this.beforeFrame());
  }

  /** Another run, or the same one from its beginning. */
  load(timeline: Timeline): void {
    this.timeline = timeline;
    this.known = { robot: false, truth: false, segments: -1 };
    this.map.reset(timeline.hello?.resolution ?? 0.01);
    this.targets.reset(timeline.hello?.resolution ?? 0.01);
    for (const part of [this.fruits, this.graph, this.marks, this.looks, this.paths]) part.reset();
    for (const part of [this.robot, this.truth, this.trueFruits, this.frustum, this.sheet]) part.clear();
    this.chooseView(null);
  }

  /** Shows the run after this step, the robot as it stands at t. */
  show(t: number, step: number): void {
    const timeline = this.timeline;
    if (!timeline) return;
    this.step = step;
    this.takeStill(timeline);
    this.map.show(timeline.map, step);
    if (this.layers.isOn("frontiers")) this.targets.show(timeline.targets, step);
    if (this.layers.isOn("graph")) this.graph.show(timeline, step);
    this.fruits.show(timeline.fruits, step);
    this.points.show(timeline.surfaceOf(this.chosen, step));
    this.marks.show(timeline, t);
    this.looks.show(timeline, t);
    this.boxes.show(timeline.segmentAt(t));
    this.paths.show(timeline, t, step);
    if (timeline.robot) {
      const at = timeline.tracks.at(t);
      this.robot.move(at);
      const T = cameraPose(timeline.robot, at);
      this.frustum.set(timeline.cameraOf(timeline.viewAt(t)) ?? timeline.robot.camera);
      this.frustum.move(T);
      if (this.follow) {
        const { position, target } = shoulder(T);
        this.stage.camera.position.copy(position);
        this.stage.controls.target.copy(target);
      }
    }
    this.stage.ask();
  }

  /** Marks a view, or none. */
  chooseView(view: View | null): void {
    const camera = view && this.timeline?.cameraOf(view);
    this.chosenFrustum.group.visible = Boolean(camera);
    if (camera) {
      this.chosenFrustum.set(camera);
      this.chosenFrustum.move(view.T_world_camera);
    }
    this.stage.ask();
  }

  /** Hangs a picture up where it was taken; null: none. */
  hangPicture(image: ImageBitmap | null, view: View | null): void {
    const camera = view && this.timeline?.cameraOf(view);
    if (image && camera) this.sheet.show(image, camera, view.T_world_camera);
    else this.sheet.clear();
    this.stage.ask();
  }

  /** −1: none. */
  chooseFruit(id: number): void {
    this.chosen = id;
    this.points.show(this.timeline?.surfaceOf(id, this.step) ?? null);
    this.fruits.select(id);
    this.stage.ask();
  }

  /** Looks over the camera's shoulder from now on, or no more. */
  setFollow(on: boolean): void {
    this.follow = on;
  }

  /** All there is, or the place the robot is at. */
  frame(whole: boolean, t: number): void {
    const box = this.bounds(whole, t);
    const center = box.getCenter(new THREE.Vector3());
    const direction = new THREE.Vector3(0.62, -1.1, 0.72).normalize();
    const distance = fittingDistance(box, direction, this.stage.camera);
    this.stage.flyTo(center.clone().addScaledVector(direction, distance), center);
  }

  /** Looks at a place from nearby. */
  lookAt(point: readonly [number, number, number], distance: number): void {
    const target = new THREE.Vector3(...point);
    const away = this.stage.camera.position.clone().sub(target).setLength(distance);
    this.stage.flyTo(target.clone().add(away), target);
  }

  /** What there is of a robot, plants and places. */
  private takeStill(timeline: Timeline): void {
    if (timeline.robot && !this.known.robot) {
      this.robot.set(timeline.robot);
      this.known.robot = true;
    }
    if (timeline.truth && !this.known.truth) {
      this.truth.set(timeline.truth);
      this.trueFruits.set(timeline.truth);
      this.known.truth = true;
    }
    if (timeline.segments.length !== this.known.segments) {
      this.known.segments = timeline.segments.length;
      this.ground.cover(this.bounds(true, 0));
      const mission = timeline.hello?.mission ?? "";
      if (this.framed !== mission && timeline.robot && timeline.segments.length > 0) {
        this.framed = mission;
        this.furnishedAt = this.stage.frames;
        this.stage.furnish();
        this.frame(false, timeline.newest);
      }
    }
  }

  private bounds(whole: boolean, t: number): THREE.Box3 {
    const box = new THREE.Box3();
    const timeline = this.timeline;
    const now = timeline?.segmentAt(t) ?? timeline?.segments[0];
    for (const segment of whole ? (timeline?.segments ?? []) : now ? [now] : []) {
      box.union(boxOf(segment.workspace)).union(boxOf(segment.region));
    }
    const plants = this.trueFruits.box();
    const size = plants.getSize(new THREE.Vector3());
    if (!plants.isEmpty() && (whole || Math.max(size.x, size.y) < 8)) box.union(plants.expandByScalar(0.35));
    if (box.isEmpty()) box.set(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1.5));
    box.expandByPoint(new THREE.Vector3(box.min.x, box.min.y, 0));
    return box;
  }

  private paint(palette: Palette): void {
    this.stage.setBackground(palette.background);
    this.mapUniforms.colorA.value.set(palette.voxel);
    this.mapUniforms.colorB.value.set(palette.roi);
    this.mapUniforms.colorC.value.set(palette.floorVoxel);
    this.targetUniforms.colorA.value.set(palette.roi);
    this.targetUniforms.colorB.value.set(palette.occupied);
    this.targetUniforms.colorC.value.set(palette.border);
    for (const part of [
      this.ground, this.robot, this.frustum, this.fruits, this.points, this.graph,
      this.marks, this.looks, this.truth, this.trueFruits, this.paths, this.boxes,
    ]) part.paint(palette); // prettier-ignore
    this.chosenFrustum.paint(palette, palette.accent);
    this.stage.ask();
  }

  private applyLayers(): void {
    const on = (id: Parameters<Layers["isOn"]>[0]) => this.layers.isOn(id);
    this.robot.group.visible = on("robot");
    this.frustum.group.visible = on("camera");
    this.sheet.group.visible = on("camera");
    this.mapUniforms.shown.value.set(on("occupied") ? 1 : 0, on("roi") ? 1 : 0, 0);
    this.map.group.visible = on("occupied") || on("roi");
    this.targets.group.visible = on("frontiers");
    this.graph.group.visible = on("graph");
    this.paths.planned.visible = on("planned");
    this.paths.driven.visible = on("driven");
    this.fruits.group.visible = this.points.group.visible = on("fruits");
    this.truth.plants.visible = on("plants");
    this.truth.around.visible = on("around");
    this.trueFruits.group.visible = on("trueFruits");
    this.marks.group.visible = on("views");
    this.looks.group.visible = on("onTheWay");
    this.boxes.group.visible = on("boxes");
    const kind = (k: "roi" | "occupied" | "border") => (this.layers.isKindOn(k) ? 1 : 0);
    this.targetUniforms.shown.value.set(kind("roi"), kind("occupied"), kind("border"));
    this.stage.ask();
  }

  /** Plants matter less than the map. */
  private truthDetail(pixels: number, budget_ms: number): TruthDetail {
    const { coarse, cellPixels } = this.stage;
    return { pixels, cellPixels: coarse ? 3 * cellPixels : 1, coarse, budget_ms };
  }

  private beforeFrame(): boolean {
    const { camera, renderer } = this.stage;
    const height = renderer.domElement.height;
    const pixels = height / (2 * Math.tan((camera.fov * Math.PI) / 360));
    this.mapUniforms.pixels.value = pixels;
    this.targetUniforms.pixels.value = pixels;
    this.graph.setPixels(pixels, renderer.getPixelRatio());
    // Pixels a voxel has at one metre. Cubes where it is larger than five, coarse where it is hardly one.
    const voxel = this.mapUniforms.size.value * pixels;
    const detail = {
      cubesWithin: voxel / 5,
      coarseBeyond: voxel / this.stage.cellPixels,
      budget_ms: Math.min(60, Math.max(12, this.stage.frame_ms)),
    };
    this.fruits.setCoarse(this.stage.coarse);
    const moreTruth = this.truth.update(camera, this.truthDetail(pixels, detail.budget_ms));
    const more = this.map.update(camera, detail);
    const moreTargets = this.layers.isOn("frontiers") && this.targets.update(camera, detail);
    return more || moreTruth || moreTargets;
  }
}

/** How far away the camera must be to have the middles of a box' edges in the picture: its corners are empty. */
function fittingDistance(
  box: THREE.Box3,
  direction: THREE.Vector3,
  camera: THREE.PerspectiveCamera,
): number {
  const right = new THREE.Vector3(0, 0, 1).cross(direction).normalize();
  const up = direction.clone().cross(right);
  const slope = Math.tan((camera.fov * Math.PI) / 360);
  const half = box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
  let distance = 0.5;
  for (const side of edgeMiddles()) {
    const point = side.multiply(half);
    const across = Math.max(Math.abs(point.dot(right)) / (slope * camera.aspect), Math.abs(point.dot(up)) / slope);
    distance = Math.max(distance, across + point.dot(direction));
  }
  return distance;
}

/** Of the cube ±1. */
function edgeMiddles(): THREE.Vector3[] {
  const signs = [-1, 0, 1];
  const all = signs.flatMap((x) => signs.flatMap((y) => signs.map((z) => new THREE.Vector3(x, y, z))));
  return all.filter((point) => point.lengthSq() === 2);
}
