// Checks GLB and glTF files with the Khronos validator: any error or warning fails.
//
//     node validate.js FILE|FOLDER...
//
// The validator cannot look into views compressed with EXT_meshopt_compression. Files that have some are checked as
// they are and once more with these views unpacked by meshoptimizer's own decoder.

import { readFile, readdir, stat } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { validateBytes } from "gltf-validator";
import { MeshoptDecoder } from "meshoptimizer";

import { parseGlb, writeGlb } from "./glb.js";
import { isCompressed, unpack } from "./meshopt.js";

const ERROR = 0;
const WARNING = 1;
const SEVERITIES = ["error", "warning", "info", "hint"];

/** All errors and warnings of one file, as texts. */
export async function faults(bytes, folder) {
  const found = await report(bytes, folder);
  const { json, bin } = await open(bytes, folder);
  if (json && isCompressed(json)) {
    try {
      await MeshoptDecoder.ready;
      const plain = unpack(json, bin, MeshoptDecoder);
      found.push(...(await report(writeGlb(plain.json, plain.bin), folder)).map((text) => `unpacked: ${text}`));
    } catch (problem) {
      found.push(`unpacking: ${problem.message}`);
    }
  }
  return found;
}

/** The JSON and the first buffer of a GLB or glTF; nothing for what cannot be read. */
async function open(bytes, folder) {
  try {
    const glb = parseGlb(bytes);
    if (glb) return glb;
    const json = JSON.parse(new TextDecoder().decode(bytes));
    const uri = json.buffers?.[0]?.uri;
    return { json, bin: uri ? await readFile(path.join(folder, decodeURIComponent(uri))) : new Uint8Array() };
  } catch {
    return {};
  }
}

async function report(bytes, folder) {
  const options = {
    maxIssues: 0,
    severityOverrides: { ACCESSOR_INDEX_TRIANGLE_DEGENERATE: ERROR },
    externalResourceFunction: async (uri) => new Uint8Array(await readFile(path.join(folder, decodeURIComponent(uri)))),
  };
  // The validator throws what it cannot recognize at all.
  const { issues } = await validateBytes(new Uint8Array(bytes), options).catch((problem) => ({
    issues: { messages: [{ severity: ERROR, code: "UNREADABLE", message: problem.message ?? problem }] },
  }));
  return issues.messages
    .filter((issue) => issue.severity <= WARNING)
    .map((issue) => `${SEVERITIES[issue.severity]} ${issue.code} ${issue.pointer ?? ""} ${issue.message}`);
}

/** The files that the arguments name: themselves, or what folders hold at any depth. */
async function files(names) {
  const found = [];
  for (const name of names) {
    const isFolder = await stat(name).then((entry) => entry.isDirectory(), () => false);
    if (!isFolder) {
      found.push(name);
      continue;
    }
    const entries = await readdir(name, { recursive: true });
    found.push(...entries.filter((entry) => /\.(glb|gltf)$/i.test(entry)).sort().map((entry) => path.join(name, entry)));
  }
  return found;
}

async function check(file) {
  return faults(await readFile(file), path.dirname(file));
}

async function main(names) {
  if (names.length === 0) {
    console.error("usage: node validate.js FILE|FOLDER...");
    return 2;
  }
  let passed = 0;
  let failed = 0;
  for (const file of await files(names)) {
    const found = await check(file).catch((problem) => [problem.message ?? problem]);
    found.length === 0 ? passed++ : failed++;
    for (const text of found.slice(0, 20)) console.log(`${file}: ${text}`);
    if (found.length > 20) console.log(`${file}: and ${found.length - 20} more`);
  }
  console.log(`${passed} passed, ${failed} failed`);
  return failed > 0 || passed === 0 ? 1 : 0;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  process.exitCode = await main(process.argv.slice(2));
}
