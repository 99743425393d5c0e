import { Fields, FrameError } from "./fields.ts";
import type {
  Fruit,
  GraphNode,
  Hello,
  Kind,
  Look,
  MapChange,
  Message,
  Motion,
  Picture,
  Plan,
  Surface,
  Targets,
  View,
} from "./messages.ts";
import { Octets } from "./octets.ts";
import { readCamera, readRobot, readTruth } from "./still_messages.ts";

/** The protocol this page reads. */
export const kProtocol = 1;

/** Far above what a run sends. */
const kMaxHeadOctets = 64 << 20;

const kNodeKinds: Kind[] = ["none", "roi", "occupied", "border"];

/** The types this page knows, each with its reader. */
const kReaders: Record<string, (f: Fields, o: Octets) => Message> = {
  reader: (f) => ({
    type: "reader",
    live: f.flagOr("live", false),
    controls: f.flagOr("controls", false),
    frames: f.countOr("frames", 0),
  }),
  hello: readHello,
  robot: readRobot,
  truth: readTruth,
  segment: (f) => ({
    type: "segment",
    segment: f.count("segment"),
    name: f.textOr("name", ""),
    t: f.number("t_s"),
    region: f.numbersOr("region", []),
    workspace: f.numbersOr("workspace", []),
    travel: f.numberOr("travel", 0),
    lift: f.numberOr("lift", 0),
  }),
  trolley: (f) => ({
    type: "trolley",
    t: f.number("t_s"),
    duration: f.number("duration_s"),
    travel: f.number("travel"),
    lift: f.number("lift"),
  }),
  view: readView,
  look: (f): Look => ({
    type: "look",
    segment: f.count("segment"),
    t: f.number("t_s"),
    during: f.textOr("during", ""),
    at: f.vector("at"),
    direction: f.vector("direction"),
    blur: f.numberOr("blur_px", 0),
    realised: f.numberOr("realised", 0),
    fruits: f.numberOr("fruits", 0),
  }),
  picture: readPicture,
  map: (f, o): MapChange => ({
    type: "map",
    view: f.count("view"),
    t: f.number("t_s"),
    blocks: o.blocks(f.count("blocks"), 128),
  }),
  targets: (f, o): Targets => ({
    type: "targets",
    view: f.count("view"),
    blocks: o.blocks(f.count("blocks"), 192),
  }),
  plan: readPlan,
  motion: readMotion,
  motion_end: (f) => ({
    type: "motion_end",
    t: f.number("t_s"),
    ended: f.textOr("ended", "arrived"),
    why: f.textOr("why", ""),
    collision: f.flagOr("collision", false),
    plantContact: f.flagOr("plant_contact", false),
  }),
  fruits: (f) => ({
    type: "fruits",
    view: f.integer("view"),
    t: f.number("t_s"),
    changed: f.listOr("changed").map(readFruit),
    gone: f.numbersOr("gone", []),
  }),
  surface: readSurface,
  log: (f) => ({
    type: "log",
    t: f.number("t_s"),
    level: f.textOr("level", "info"),
    text: f.text("text"),
    word: f.textOr("word", ""),
  }),
  pace: (f) => ({ type: "pace", factor: f.number("factor") }),
  work: (f) => ({
    type: "work",
    work: f.list("work").map((w) => ({
      name: w.text("name"),
      count: w.numberOr("count", 0),
      seconds: w.number("seconds"),
    })),
  }),
  end: (f) => ({ type: "end", t: f.number("t_s"), interrupted: f.flagOr("interrupted", false) }),
  lost: (f) => ({ type: "lost", frames: f.count("frames") }),
};

const kSurfaceStep_m = 1e-4;

function readSurface(f: Fields, o: Octets): Surface {
  const fruits = f.list("fruits").map((fruit) => {
    const origin = fruit.vector("origin");
    const steps = o.int16(3 * fruit.count("points"));
    const points = Float32Array.from(steps, (step, i) => origin[i % 3] + kSurfaceStep_m * step);
    return { id: fruit.integer("id"), points };
  });
  return { type: "surface", t: f.number("t_s"), fruits };
}

/**
 * Reads one frame: a line of JSON, then octets. Nothing where its type is unknown; throws
 * FrameError where it is malformed.
 */
export function readFrame(frame: Uint8Array): Message | null {
  const lineEnd = frame.indexOf(10);
  if (lineEnd < 0) throw new FrameError("a frame without a line end");
  if (lineEnd > kMaxHeadOctets) throw new FrameError("a frame whose first line is too long");
  let json: unknown;
  try {
    json = JSON.parse(new TextDecoder().decode(frame.subarray(0, lineEnd)));
  } catch {
    throw new FrameError("a frame whose first line is no JSON");
  }
  const fields = new Fields(json, "frame");
  const type = fields.text("type");
  const octets = frame.subarray(lineEnd + 1);
  const said = fields.countOr("bytes", 0);
  if (said !== octets.length)
    throw new FrameError(`${type}: ${octets.length} octets where ${said} were announced`);
  if (!Object.hasOwn(kReaders, type)) return null;
  const payload = new Octets(octets, type);
  const message = kReaders[type](new Fields(json, type), payload);
  payload.finish();
  return message;
}

/** Cuts a file of [uint32 length][frame] into frames; a torn end is left out. */
export function* splitFrames(file: Uint8Array): Generator<Uint8Array> {
  const numbers = new DataView(file.buffer, file.byteOffset, file.byteLength);
  for (let at = 0; at + 4 <= file.length; ) {
    const end = at + 4 + numbers.getUint32(at, true);
    if (end > file.length) return;
    yield file.subarray(at + 4, end);
    at = end;
  }
}

function readHello(f: Fields): Hello {
  return {
    type: "hello",
    protocol: f.integer("protocol"),
    simulated: f.flagOr("simulated", false),
    mission: f.textOr("mission", ""),
    planner: f.textOr("planner", ""),
    seed: String(f.numberOr("seed", "")),
    canopeer: f.textOr("canopeer", ""),
    segments: f.countOr("segments", 0),
    segmentTime: f.numberOr("segment_time_s", 0),
    resolution: f.numberOr("resolution_m", 0.01),
  };
}

function readView(f: Fields): View {
  return {
    type: "view",
    view: f.count("view"),
    segment: f.count("segment"),
    t: f.number("t_s"),
    q: f.numbers("q"),
    travel: f.numberOr("travel", 0),
    lift: f.numberOr("lift", 0),
    T_world_camera: f.pose("T_world_camera"),
    camera: f.has("camera") ? readCamera(f.object("camera")) : null,
    kind: f.textOr("kind", "none"),
    predicted: f.numberOr("predicted", null),
    realised: f.numberOr("realised", null),
    points: f.numberOr("points", 0),
    roiVoxels: f.numberOr("roi_voxels", 0),
    planning: f.numberOr("planning_s", 0),
    motion: f.numberOr("motion_s", 0),
    nodes: f.numberOr("nodes", 0),
    edges: f.numberOr("edges", 0),
    fruits: f.numberOr("fruits", 0),
  };
}

function readPicture(f: Fields, o: Octets): Picture {
  return {
    type: "picture",
    view: f.count("view"),
    what: f.text("what"),
    width: f.count("width"),
    height: f.count("height"),
    mime: f.text("mime"),
    min: f.numberOr("min_m", 0),
    max: f.numberOr("max_m", 0),
    data: o.take(o.left),
  };
}

function readPlan(f: Fields, o: Octets): Plan {
  const nodes: GraphNode[] = [];
  for (let i = f.countOr("views", 0); i > 0; --i) {
    const [id] = o.int32(1);
    const [x, y, z, dx, dy, dz] = o.float32(6);
    const [kind] = o.take(1);
    nodes.push({
      id,
      position: [x, y, z],
      direction: [dx, dy, dz],
      kind: kNodeKinds[kind] ?? "none",
    });
  }
  return {
    type: "plan",
    t: f.number("t_s"),
    segment: f.countOr("segment", 0),
    fresh: f.flagOr("fresh", false),
    nodes,
    edges: o.int32(2 * f.countOr("edges", 0)),
    goneEdges: o.int32(2 * f.countOr("gone_edges", 0)),
    goneNodes: o.int32(f.countOr("gone_views", 0)),
    path: f.numbersOr("path", []),
    at: f.numberOr("at", -1),
    visited: f.numbersOr("visited", []),
  };
}

function readMotion(f: Fields, o: Octets): Motion {
  const joints = f.count("joints");
  const points = f.count("points");
  const rate = f.number("rate_hz");
  if (!(rate > 0)) throw f.wrong("rate_hz", "not above 0");
  return {
    type: "motion",
    kind: f.textOr("kind", "view"),
    segment: f.countOr("segment", 0),
    t: f.number("t_s"),
    duration: f.number("duration_s"),
    rate,
    joints,
    points,
    positions: o.float32(joints * points),
  };
}

function readFruit(f: Fields): Fruit {
  return {
    id: f.integer("id"),
    centre: f.vector("centre"),
    semiAxes: f.vector("semi_axes"),
    e1: f.numberOr("e1", 1),
    e2: f.numberOr("e2", 1),
    rpy: f.has("rpy") ? f.vector("rpy") : [0, 0, 0],
    volume: f.numberOr("volume_cm3", 0),
    confidence: f.numberOr("confidence", 1),
    ripeness: f.has("ripeness") ? readRipeness(f) : "",
    color: f.has("color") ? f.vector("color") : [200, 60, 40],
    points: f.numberOr("points", 0),
    views: f.numberOr("views", 0),
    seenShare: f.numberOr("seen_share", 0),
    first: f.numberOr("first_s", 0),
    last: f.numberOr("last_s", 0),
  };
}

/** A word, or a share from 0 to 1. */
function readRipeness(f: Fields): string {
  try {
    return f.text("ripeness");
  } catch {
    return f.number("ripeness").toFixed(2);
  }
}
