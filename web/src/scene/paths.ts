import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { cameraPose } from "../data/kinematics.ts";
import { Trail } from "../data/trail.ts";
import type { Timeline } from "../data/timeline.ts";
import type { Palette } from "../theme.ts";

/** Of the way driven in one segment, so many pieces are drawn at most. */
const kPieces = 20000;

/** The way the camera went in this segment, and the way it is to go. */
export class Paths {
  readonly driven = new THREE.Group();
  readonly planned = new THREE.Group();
  private trail = new Trail();
  private readonly drivenMaterial = new LineMaterial({ linewidth: 2.5 });
  private readonly plannedMaterial = new LineMaterial({
    linewidth: 2.5,
    dashed: true,
    dashSize: 0.03,
    gapSize: 0.02,
  });
  private drivenLine = line([], this.drivenMaterial);
  private plannedLine = line([], this.plannedMaterial);
  private plannedAs = "";
  /** The first piece that is drawn: of the present segment. */
  private first = 0;

  constructor() {
    this.driven.add(this.drivenLine);
    this.planned.add(this.plannedLine);
  }

  show(timeline: Timeline, t: number, step: number): void {
    const grown = this.trail.extend(timeline);
    const first = this.trail.countAt(timeline.segmentAt(t)?.t ?? 0);
    if (grown || first !== this.first) {
      this.first = first;
      const points = this.trail.points.slice(6 * first, 6 * (first + kPieces));
      this.drivenLine = replace(this.driven, this.drivenLine, points, this.drivenMaterial);
    }
    const count = this.trail.countAt(t) - first;
    this.drivenLine.geometry.instanceCount = count;
    this.drivenLine.visible = count > 0;
    this.showPlan(timeline, t, step);
  }

  paint(palette: Palette): void {
    this.drivenMaterial.color.set(palette.driven);
    this.plannedMaterial.color.set(palette.planned);
  }

  reset(): void {
    this.trail = new Trail();
    this.plannedAs = "";
    this.drivenLine = replace(this.driven, this.drivenLine, [], this.drivenMaterial);
  }

  /** The rest of the motion under way, as the arm will drive it; then straight from view to view. */
  private showPlan(timeline: Timeline, t: number, step: number): void {
    const plan = timeline.planAt(step);
    const motion = timeline.tracks.motionAt(t);
    const as = `${plan?.t} ${plan?.path.join()} ${motion?.motion.t} ${motion ? t.toFixed(1) : ""}`;
    if (as === this.plannedAs) return;
    this.plannedAs = as;
    const corners: number[][] = [];
    const { robot, tracks } = timeline;
    const here = (at: number) => {
      if (!robot) return;
      const T = cameraPose(robot, tracks.at(at));
      corners.push([T[3], T[7], T[11]]);
    };
    here(t);
    let path = plan?.path ?? [];
    if (motion) {
      for (let at = t + 0.1; at < motion.end; at += 0.1) here(at);
      here(motion.end - 1e-6);
      path = path.slice(1);
    }
    for (const id of path) {
      const node = timeline.nodes.at(id, step);
      if (node) corners.push([...node.position]);
    }
    const points: number[] = [];
    for (let i = 1; i < corners.length; ++i) points.push(...corners[i - 1], ...corners[i]);
    this.plannedLine = replace(this.planned, this.plannedLine, points, this.plannedMaterial);
  }
}

function line(points: number[], material: LineMaterial): LineSegments2 {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(points.length > 0 ? points : [0, 0, 0, 0, 0, 0]);
  const segments = new LineSegments2(geometry, material);
  segments.computeLineDistances();
  segments.frustumCulled = false;
  segments.visible = points.length > 0;
  return segments;
}

function replace(group: THREE.Group, old: LineSegments2, points: number[], material: LineMaterial): LineSegments2 {
  group.remove(old);
  old.geometry.dispose();
  const made = line(points, material);
  group.add(made);
  return made;
}
