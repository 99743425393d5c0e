import assert from "node:assert/strict";
import test from "node:test";
import * as THREE from "three";
import type { Truth } from "../src/data/messages.ts";
import { hull } from "../src/panels/outline.ts";
import { formatPlace, parsePlace } from "../src/place.ts";
import { viridis } from "../src/pictures/false_color.ts";
import { chunkVoxels, coarser, kChunk } from "../src/scene/block_bits.ts";
import { FarPoints } from "../src/scene/far_points.ts";
import { simplify } from "../src/scene/simplify.ts";
import { partsByTile, tileMesh } from "../src/scene/truth_tiles.ts";
import { surface, surfacePoint } from "../src/scene/superellipsoid.ts";
import { brief, clock, shortClock } from "../src/ui/format.ts";
import { random } from "./made/frames.ts";

/** Blocks of one set by their place in the chunk. */
function blocksOf(voxels: [number, number, number][]): (x: number, y: number, z: number) => Uint8Array | undefined {
  const blocks = new Map<string, Uint8Array>();
  for (const [x, y, z] of voxels) {
    const key = [x >> 3, y >> 3, z >> 3].join();
    const block = blocks.get(key) ?? new Uint8Array(128);
    blocks.set(key, block);
    block[(y & 7) + 8 * (z & 7)] |= 1 << (x & 7);
  }
  return (x, y, z) => blocks.get([x, y, z].join());
}

test("bits of a block are the voxels x = bit, y = octet mod 8, z = octet div 8", () => {
  const { count, cells } = chunkVoxels(blocksOf([[3, 12, 9]]), 2, true);
  assert.equal(count, 1);
  assert.deepEqual([...cells], [3, 12, 9, 1]);
});

test("voxels with six neighbours are hidden, across chunks too", () => {
  const cube: [number, number, number][] = [];
  for (let x = 0; x < 3; ++x) for (let y = 0; y < 3; ++y) for (let z = 0; z < 3; ++z) cube.push([x, y, z]);
  assert.equal(chunkVoxels(blocksOf(cube), 2, true).count, 26);
  assert.equal(chunkVoxels(blocksOf(cube), 2, false).count, 27);
  const around = cube.map(([x, y, z]): [number, number, number] => [x - 1, y + 1, z + 1]);
  const { cells } = chunkVoxels(blocksOf(around), 2, true);
  assert.ok(![...Array(cells.length / 4).keys()].some((i) => cells[4 * i] === 0 && cells[4 * i + 1] === 2 && cells[4 * i + 2] === 2));
});

test("the surface of a slab faces up and down", () => {
  const slab: [number, number, number][] = [];
  for (let x = 0; x < 8; ++x) for (let y = 0; y < 8; ++y) for (let z = 4; z < 6; ++z) slab.push([x, y, z]);
  const { cells, normals, count } = chunkVoxels(blocksOf(slab), 2, true);
  for (let i = 0; i < 4 * count; i += 4)
    if (cells[i] === 4 && cells[i + 1] === 4) assert.equal(normals[i + 2], cells[i + 2] === 5 ? 127 : -127);
});

test("larger cells hold all flags of their voxels, each once", () => {
  const next = random(4);
  const voxels = Array.from({ length: 500 }, (): [number, number, number] => [0, 0, 0].map(() => Math.floor(kChunk * next())) as [number, number, number]);
  const fine = chunkVoxels(blocksOf(voxels), 2, false);
  const large = coarser(fine);
  const keys = new Set(voxels.map((v) => v.map((x) => x >> 1).join()));
  assert.equal(large.count, keys.size);
  for (let i = 0; i < 4 * large.count; i += 4) assert.ok(keys.has([...large.cells.subarray(i, i + 3)].join()));
});

test("points of a superellipsoid fulfil its equation", () => {
  const shape = { semiAxes: [0.03, 0.04, 0.05] as [number, number, number], e1: 0.7, e2: 1.3 };
  const inside = ([x, y, z]: number[]) =>
    (Math.abs(x / 0.03) ** (2 / 1.3) + Math.abs(y / 0.04) ** (2 / 1.3)) ** (1.3 / 0.7) + Math.abs(z / 0.05) ** (2 / 0.7);
  const next = random(9);
  for (let i = 0; i < 200; ++i) {
    const point = surfacePoint(shape, Math.PI * (next() - 0.5), 2 * Math.PI * next());
    assert.ok(Math.abs(inside(point) - 1) < 1e-9);
  }
});

test("its surface is closed and faces outwards", () => {
  const { points, triangles } = surface({ semiAxes: [1, 1, 1], e1: 1, e2: 1 }, 30, 60);
  let volume = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = triangles.slice(i, i + 3).map((k) => points.subarray(3 * k, 3 * k + 3));
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  assert.ok(Math.abs(volume - (4 / 3) * Math.PI) < 0.04);
});

test("a simplified mesh has fewer triangles, none of them flat", () => {
  const n = 20;
  const vertices: number[] = [];
  const triangles: number[] = [];
  for (let y = 0; y <= n; ++y) for (let x = 0; x <= n; ++x) vertices.push(x / n, y / n, 0);
  for (let y = 0; y < n; ++y)
    for (let x = 0; x < n; ++x) {
      const a = y * (n + 1) + x;
      triangles.push(a, a + 1, a + n + 1, a + 1, a + n + 2, a + n + 1);
    }
  const mesh = { vertices: Float32Array.from(vertices), colors: new Float32Array(vertices.length), triangles: Uint32Array.from(triangles) };
  const small = simplify(mesh, 0.25);
  assert.ok(small.triangles.length > 0 && small.triangles.length < triangles.length / 4);
  for (let i = 0; i < small.triangles.length; i += 3)
    assert.equal(new Set(small.triangles.subarray(i, i + 3)).size, 3);
});

test("tiles have all triangles, each once, where they were", () => {
  const next = random(7);
  const truth: Truth = {
    type: "truth",
    vertices: Float32Array.from({ length: 3 * 300 }, () => 4 * next() - 2),
    triangles: Uint32Array.from({ length: 3 * 200 }, () => Math.floor(300 * next())),
    parts: Array.from({ length: 20 }, (_, i) => ({ what: "leaf", color: [i, 100, 50], first: 10 * i, triangles: 10 })),
    fruits: [],
  };
  const corners = ({ vertices, triangles }: { vertices: Float32Array; triangles: Uint32Array }) =>
    Array.from({ length: triangles.length / 3 }, (_, i) =>
      [...triangles.subarray(3 * i, 3 * i + 3)].map((v) => vertices.subarray(3 * v, 3 * v + 3).join()).join(";"));
  const tiles = partsByTile(truth, truth.parts);
  assert.ok(tiles.length > 4);
  assert.deepEqual(tiles.flatMap((parts) => corners(tileMesh(truth, parts))).sort(), corners(truth).sort());
});

test("cells of several chunks are drawn where they are, below zero too", () => {
  const cells = { count: 1, cells: Uint8Array.of(1, 2, 3, 1), normals: Int8Array.of(0, 0, 127, 0) };
  const far = new FarPoints(new THREE.Material());
  far.set([{ cells, begin: [8, 0, -8] }, { cells, begin: [-800, 16, 0] }]);
  assert.deepEqual([...far.points.geometry.getAttribute("cell").array], [9, 2, -5, 1, -799, 18, 3, 1]);
  far.set([]);
  assert.ok(!far.points.visible);
});

test("places in links are read and written", () => {
  assert.deepEqual(parsePlace("#view=12"), { view: 12 });
  assert.deepEqual(parsePlace("#t=33.5&fruit=2"), { t: 33.5, fruit: 2 });
  assert.deepEqual(parsePlace("#view=-1&t=x&fruit=1.5"), {});
  assert.deepEqual(parsePlace(""), {});
  assert.equal(formatPlace({ view: 12, t: 3 }), "#view=12");
  assert.equal(formatPlace({ t: 33.456, fruit: 4 }), "#t=33.46&fruit=4");
});

test("figures are short and do not jump", () => {
  assert.equal(clock(75.34), "1:15.3");
  assert.equal(clock(59.99), "0:59.9");
  assert.equal(shortClock(600), "10:00");
  assert.deepEqual([null, 7, 1500, 458880, 1.25e6].map(brief), ["–", "7", "1.5k", "459k", "1.3M"]);
});

test("the hull of a square with a point inside is the square", () => {
  assert.equal(hull([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]]).length, 4);
});

test("near is bright, far is dark", () => {
  const sum = (c: number[]) => c[0] + c[1] + c[2];
  assert.ok(sum(viridis(1)) > sum(viridis(0.5)) && sum(viridis(0.5)) > sum(viridis(0)));
});
