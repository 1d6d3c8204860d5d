// A check that cannot fail checks nothing: good files pass, and each fault is found.

import assert from "node:assert/strict";
import test from "node:test";

import { MeshoptEncoder } from "meshoptimizer";

import { writeGlb } from "./glb.js";
import { faults } from "./validate.js";

const POSITIONS = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);

/** A document of one triangle. */
function triangle() {
  return {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, type: "VEC3", count: 3, min: [0, 0, 0], max: [1, 1, 0] },
      { bufferView: 1, componentType: 5123, type: "SCALAR", count: 3 },
    ],
    bufferViews: [
      { buffer: 0, byteLength: 36, target: 34962 },
      { buffer: 0, byteOffset: 36, byteLength: 6, target: 34963 },
    ],
    buffers: [{ byteLength: 44 }],
  };
}

function data(indices = [0, 1, 2]) {
  const bytes = new Uint8Array(44);
  bytes.set(new Uint8Array(POSITIONS.buffer), 0);
  bytes.set(new Uint8Array(new Uint16Array(indices).buffer), 36);
  return bytes;
}

/** The same with its positions compressed. */
async function compressed() {
  await MeshoptEncoder.ready;
  const json = triangle();
  const packed = MeshoptEncoder.encodeGltfBuffer(new Uint8Array(POSITIONS.buffer), 3, 12, "ATTRIBUTES", 0);
  const bin = new Uint8Array(8 + packed.length);
  bin.set(data().subarray(36), 0);
  bin.set(packed, 8);
  json.bufferViews[0].buffer = 1;
  json.bufferViews[0].extensions = {
    EXT_meshopt_compression: {
      buffer: 0, byteOffset: 8, byteLength: packed.length, byteStride: 12, count: 3, mode: "ATTRIBUTES",
    },
  };
  json.bufferViews[1].byteOffset = 0;
  json.buffers = [
    { byteLength: bin.length },
    { byteLength: 36, extensions: { EXT_meshopt_compression: { fallback: true } } },
  ];
  json.extensionsUsed = json.extensionsRequired = ["EXT_meshopt_compression"];
  return { json, bin };
}

test("a good file has no faults", async () => {
  assert.deepEqual(await faults(writeGlb(triangle(), data()), "."), []);
});

test("a wrong bound is a fault", async () => {
  const json = triangle();
  json.accessors[0].max = [1, 1, 1];
  assert.match((await faults(writeGlb(json, data()), ".")).join(), /ACCESSOR_MAX_MISMATCH/);
});

test("a triangle without three corners is a fault", async () => {
  const found = await faults(writeGlb(triangle(), data([0, 1, 1])), ".");
  assert.match(found.join(), /ACCESSOR_INDEX_TRIANGLE_DEGENERATE/);
});

test("what is no glTF is a fault", async () => {
  assert.notEqual((await faults(new TextEncoder().encode("solid cube"), ".")).length, 0);
});

test("a good compressed file has no faults", async () => {
  const { json, bin } = await compressed();
  assert.deepEqual(await faults(writeGlb(json, bin), "."), []);
});

test("compressed views are looked into", async () => {
  const { json, bin } = await compressed();
  json.accessors[0].max = [1, 1, 1];
  assert.match((await faults(writeGlb(json, bin), ".")).join(), /unpacked: .*ACCESSOR_MAX_MISMATCH/);
});

test("a compressed view that does not unpack is a fault", async () => {
  const { json, bin } = await compressed();
  bin[8] = 0;
  assert.match((await faults(writeGlb(json, bin), ".")).join(), /unpacking: /);
});
