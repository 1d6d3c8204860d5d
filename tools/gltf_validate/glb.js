// The GLB container (glTF 2.0, "GLB File Format").

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;

/** The JSON and the binary chunk of a GLB; nothing if it is none. */
export function parseGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.byteLength < 12 || view.getUint32(0, true) !== MAGIC) return undefined;
  let json;
  let bin = new Uint8Array();
  for (let at = 12; at + 8 <= bytes.byteLength; ) {
    const length = view.getUint32(at, true);
    const chunk = new Uint8Array(bytes.buffer, bytes.byteOffset + at + 8, length);
    const kind = view.getUint32(at + 4, true);
    if (kind === JSON_CHUNK) json = JSON.parse(new TextDecoder().decode(chunk));
    if (kind === BIN_CHUNK) bin = chunk;
    at += 8 + length;
  }
  return { json, bin };
}

/** A GLB of some JSON and its binary chunk. */
export function writeGlb(json, bin) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const textLength = Math.ceil(text.length / 4) * 4;
  const binLength = Math.ceil(bin.length / 4) * 4;
  const total = 12 + 8 + textLength + 8 + binLength;
  const bytes = new Uint8Array(total);
  const view = new DataView(bytes.buffer);
  const header = [MAGIC, 2, total, textLength, JSON_CHUNK];
  header.forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.fill(0x20, 20, 20 + textLength);
  bytes.set(text, 20);
  view.setUint32(20 + textLength, binLength, true);
  view.setUint32(24 + textLength, BIN_CHUNK, true);
  bytes.set(bin, 28 + textLength);
  return bytes;
}
