// Runs the Khronos validator over files and folders: `node validate.js PATH...`.
// Exit 1 where a file has an error or a warning, or where there is no file at all.
import { readFileSync, readdirSync, statSync } from "node:fs";
import { dirname, extname, join } from "node:path";
import { validateBytes } from "gltf-validator";

// A triangle without area is worth a note to the validator; it is a defect here.
const severityOverrides = { ACCESSOR_INDEX_TRIANGLE_DEGENERATE: 1 };
const SEVERITIES = ["error", "warning"];

function files(path) {
  if (!statSync(path).isDirectory()) return [path];
  return readdirSync(path)
    .sort()
    .flatMap((name) => files(join(path, name)))
    .filter((name) => [".glb", ".gltf"].includes(extname(name)));
}

async function problems(path) {
  const options = {
    uri: path,
    maxIssues: 100,
    severityOverrides,
    externalResourceFunction: async (uri) =>
      new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri)))),
  };
  try {
    const report = await validateBytes(new Uint8Array(readFileSync(path)), options);
    return report.issues.messages.filter((message) => message.severity < SEVERITIES.length);
  } catch (error) {
    return [{ severity: 0, code: "UNREADABLE", pointer: "", message: String(error) }];
  }
}

const paths = process.argv.slice(2).flatMap(files);
let bad = 0;
for (const path of paths) {
  const found = await problems(path);
  if (found.length > 0) bad += 1;
  for (const { severity, code, pointer, message } of found) {
    console.log(`${path}: ${SEVERITIES[severity]} ${code} ${pointer}: ${message}`);
  }
}
console.log(`${paths.length} files, ${bad} with errors or warnings`);
process.exit(paths.length > 0 && bad === 0 ? 0 : 1);
