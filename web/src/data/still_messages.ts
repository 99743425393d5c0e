import type { Fields } from "./fields.ts";
import type { Camera, Link, Robot, Shape, Truth } from "./messages.ts";
import type { Octets } from "./octets.ts";

// The messages that come once, and what others share with them.

/** The robot's links and their shapes. */
export function readRobot(f: Fields, o: Octets): Robot {
  const links = f.list("links");
  const vertices = o.float32(3 * f.countOr("vertices", 0));
  const triangles = o.uint32(o.left >> 2);
  const robot: Robot = {
    type: "robot",
    links: links.map((l, i) => readLink(l, i, vertices, triangles)),
    T_world_root: f.pose("T_world_root"),
    cameraLink: f.count("camera_link"),
    camera: readCamera(f.object("camera")),
  };
  if (robot.cameraLink >= links.length) throw f.wrong("camera_link", "no such link");
  return robot;
}

/** A camera's pixels and focal lengths. */
export function readCamera(f: Fields): Camera {
  const camera = {
    width: f.count("width"),
    height: f.count("height"),
    fx: f.number("fx"),
    fy: f.number("fy"),
    cx: f.number("cx"),
    cy: f.number("cy"),
  };
  if (!(camera.fx > 0 && camera.fy > 0)) throw f.wrong("fx", "no focal length");
  return camera;
}

function readLink(f: Fields, i: number, vertices: Float32Array, triangles: Uint32Array): Link {
  const parent = f.integer("parent");
  if (parent >= i || parent < -1) throw f.wrong("parent", "does not come before its child");
  const type = f.text("type");
  const source = f.textOr("source", "still");
  return {
    name: f.textOr("name", ""),
    parent,
    type: type === "revolute" || type === "prismatic" ? type : "fixed",
    origin: f.pose("origin"),
    axis: f.has("axis") ? f.vector("axis") : [0, 0, 1],
    source: source === "arm" || source === "travel" || source === "lift" ? source : "still",
    index: f.countOr("index", 0),
    multiplier: f.numberOr("multiplier", 1),
    offset: f.numberOr("offset", 0),
    shapes: f.listOr("shapes").map((s) => readShape(s, vertices, triangles)),
  };
}

function readShape(f: Fields, vertices: Float32Array, triangles: Uint32Array): Shape {
  const pose = f.pose("pose");
  const kind = f.text("kind");
  switch (kind) {
    case "box":
      return { kind, size: f.vector("size"), pose };
    case "cylinder":
      return { kind, radius: f.number("radius"), length: f.number("length"), pose };
    case "sphere":
      return { kind, radius: f.number("radius"), pose };
    case "mesh": {
      const [v, nv, t, nt] = ["vertex", "vertices", "triangle", "triangles"].map((n) => f.count(n));
      if (3 * (v + nv) > vertices.length || 3 * (t + nt) > triangles.length)
        throw f.wrong("kind", "a mesh beyond the octets");
      const corners = triangles.slice(3 * t, 3 * (t + nt));
      checkCorners(corners, nv, f);
      return { kind, vertices: vertices.slice(3 * v, 3 * (v + nv)), triangles: corners, pose };
    }
    default:
      throw f.wrong("kind", "unknown shape");
  }
}

function checkCorners(corners: Uint32Array, vertices: number, f: Fields): void {
  for (const corner of corners)
    if (corner >= vertices) throw f.wrong("triangles", "a corner beyond the vertices");
}

/** The true plants and fruits. */
export function readTruth(f: Fields, o: Octets): Truth {
  const count = f.count("vertices");
  const vertices = o.float32(3 * count);
  const triangles = o.uint32(o.left >> 2);
  checkCorners(triangles, count, f);
  return {
    type: "truth",
    vertices,
    triangles,
    parts: f.listOr("parts").map((p) => {
      const part = {
        what: p.textOr("what", "other"),
        color: p.vector("color"),
        first: p.count("triangle"),
        triangles: p.count("triangles"),
      };
      if (3 * (part.first + part.triangles) > triangles.length)
        throw p.wrong("triangles", "beyond the octets");
      return part;
    }),
    fruits: f.listOr("fruits").map((t) => ({
      id: t.integer("id"),
      centre: t.vector("centre"),
      radius: t.number("radius"),
      counted: t.flagOr("counted", true),
    })),
  };
}
