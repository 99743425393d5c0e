import type { Pose } from "./fields.ts";

// The messages of docs/live-view.md, as the page holds them. Metres, radians, seconds of mission
// time; world is z up.

export type Vec3 = [number, number, number];

/** What a view, a node of the graph or a target is after. */
export type Kind = "none" | "home" | "roi" | "occupied" | "border" | "random";

/** What the server says to this page alone, before all else. */
export interface Reader {
  type: "reader";
  live: boolean;
  /** This page may steer. */
  controls: boolean;
  /** So many frames are there already. */
  frames: number;
}

export interface Hello {
  type: "hello";
  protocol: number;
  simulated: boolean;
  mission: string;
  planner: string;
  seed: string;
  canopeer: string;
  segments: number;
  segmentTime: number;
  resolution: number;
}

export type Shape =
  | { kind: "box"; size: Vec3; pose: Pose }
  | { kind: "cylinder"; radius: number; length: number; pose: Pose }
  | { kind: "sphere"; radius: number; pose: Pose }
  | { kind: "mesh"; vertices: Float32Array; triangles: Uint32Array; pose: Pose };

export interface Link {
  name: string;
  parent: number;
  type: "fixed" | "revolute" | "prismatic";
  origin: Pose;
  axis: Vec3;
  source: "arm" | "travel" | "lift" | "still";
  index: number;
  multiplier: number;
  offset: number;
  shapes: Shape[];
}

export interface Camera {
  width: number;
  height: number;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

export interface Robot {
  type: "robot";
  links: Link[];
  T_world_root: Pose;
  cameraLink: number;
  camera: Camera;
}

export interface TruthPart {
  what: string;
  color: Vec3;
  first: number;
  triangles: number;
}

export interface TrueFruit {
  id: number;
  centre: Vec3;
  radius: number;
  counted: boolean;
}

export interface Truth {
  type: "truth";
  vertices: Float32Array;
  triangles: Uint32Array;
  parts: TruthPart[];
  fruits: TrueFruit[];
}

export interface Segment {
  type: "segment";
  segment: number;
  name: string;
  t: number;
  region: number[];
  workspace: number[];
  travel: number;
  lift: number;
}

export interface Trolley {
  type: "trolley";
  t: number;
  duration: number;
  travel: number;
  lift: number;
}

export interface View {
  type: "view";
  view: number;
  segment: number;
  t: number;
  q: number[];
  travel: number;
  lift: number;
  T_world_camera: Pose;
  /** From this view on; null: as before, at first that of the robot. */
  camera: Camera | null;
  kind: string;
  predicted: number | null;
  realised: number | null;
  points: number;
  roiVoxels: number;
  planning: number;
  motion: number;
  nodes: number;
  edges: number;
  fruits: number;
}

/** A frame taken on the way, while the arm or the trolley moved. */
export interface Look {
  type: "look";
  segment: number;
  t: number;
  /** The kind of the motion. */
  during: string;
  at: Vec3;
  /** Where the camera looked. */
  direction: Vec3;
  blur: number; // px
  realised: number;
  fruits: number;
}

export interface Picture {
  type: "picture";
  view: number;
  what: string;
  width: number;
  height: number;
  mime: string;
  min: number;
  max: number;
  data: Uint8Array;
}

/** Blocks of 8 × 8 × 8 voxels: the block at `index[3 i …]` has the `each` octets from `each` · i on. */
export interface Blocks {
  index: Int32Array;
  octets: Uint8Array;
  each: number;
}

export interface MapChange {
  type: "map";
  view: number;
  t: number;
  blocks: Blocks; // 64 octets occupied, 64 octets ROI
}

export interface Targets {
  type: "targets";
  view: number;
  blocks: Blocks; // 64 octets each: roi, occupied, border
}

export interface GraphNode {
  id: number;
  position: Vec3;
  direction: Vec3;
  kind: Kind;
}

export interface Plan {
  type: "plan";
  t: number;
  segment: number;
  fresh: boolean;
  nodes: GraphNode[];
  edges: Int32Array; // pairs
  goneEdges: Int32Array; // pairs
  goneNodes: Int32Array; // ids
  path: number[];
  at: number;
  visited: number[];
}

export interface Motion {
  type: "motion";
  kind: string;
  segment: number;
  t: number;
  duration: number;
  rate: number;
  joints: number;
  points: number;
  positions: Float32Array;
}

export interface MotionEnd {
  type: "motion_end";
  t: number;
  ended: string;
  why: string;
  collision: boolean;
  plantContact: boolean;
}

export interface Fruit {
  id: number;
  centre: Vec3;
  semiAxes: Vec3;
  e1: number;
  e2: number;
  rpy: Vec3;
  volume: number; // cm³
  confidence: number;
  ripeness: string;
  color: Vec3;
  points: number;
  views: number;
  seenShare: number;
  first: number;
  last: number;
}

export interface Fruits {
  type: "fruits";
  view: number; // −1: of none
  t: number;
  changed: Fruit[];
  gone: number[];
}

/** Points of a fruit's surface, world. */
export interface FruitPoints {
  id: number;
  points: Float32Array; // x y z
}

export interface Surface {
  type: "surface";
  t: number;
  fruits: FruitPoints[];
}

export interface Log {
  type: "log";
  t: number;
  level: string;
  text: string;
  word: string; // that somebody steered by; empty: none
}

/** How fast simulated time goes, as somebody set it. */
export interface Pace {
  type: "pace";
  factor: number; // 0: as fast as it goes
}

export interface WorkEntry {
  name: string;
  count: number;
  seconds: number;
}

export interface Work {
  type: "work";
  work: WorkEntry[];
}

export interface End {
  type: "end";
  t: number;
  interrupted: boolean;
}

export interface Lost {
  type: "lost";
  frames: number;
}

export type Message =
  | Reader
  | Hello
  | Robot
  | Truth
  | Segment
  | Trolley
  | View
  | Look
  | Picture
  | MapChange
  | Targets
  | Plan
  | Motion
  | MotionEnd
  | Fruits
  | Surface
  | Log
  | Pace
  | Work
  | End
  | Lost;
