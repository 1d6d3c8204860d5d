// EXT_meshopt_compression: files without it, by meshoptimizer's own decoder.

const NAME = "EXT_meshopt_compression";

export function isCompressed(json) {
  return (json.bufferViews ?? []).some((view) => view.extensions?.[NAME]);
}

/**
 * The same document with every view unpacked and the extension gone: one buffer.
 *
 * Throws where a view does not unpack, or does not agree with what the extension asks of it.
 */
export function unpack(json, bin, decoder) {
  const plain = structuredClone(json);
  const pieces = [];
  let length = 0;
  for (const [i, view] of plain.bufferViews.entries()) {
    const data = unpackView(view, i, json, bin, decoder);
    view.buffer = 0;
    view.byteOffset = length;
    delete view.extensions;
    pieces.push([length, data]);
    length = Math.ceil((length + data.length) / 4) * 4;
  }
  const whole = new Uint8Array(length);
  for (const [at, data] of pieces) whole.set(data, at);
  plain.buffers = [{ byteLength: length }];
  for (const list of ["extensionsUsed", "extensionsRequired"]) {
    plain[list] = plain[list].filter((name) => name !== NAME);
    if (plain[list].length === 0) delete plain[list];
  }
  return { json: plain, bin: whole };
}

function unpackView(view, i, json, bin, decoder) {
  const packed = view.extensions?.[NAME];
  if (!packed) {
    if (view.buffer !== 0) throw new Error(`view ${i} is not compressed and not in the first buffer`);
    return bin.subarray(view.byteOffset ?? 0, (view.byteOffset ?? 0) + view.byteLength);
  }
  const fallback = json.buffers[view.buffer];
  const size = packed.count * packed.byteStride;
  if (packed.buffer !== 0 || !fallback?.extensions?.[NAME]?.fallback || fallback.uri) {
    throw new Error(`view ${i} has its buffers wrong`);
  }
  if (view.byteLength !== size || (view.byteStride ?? packed.byteStride) !== packed.byteStride) {
    throw new Error(`view ${i} and its extension disagree about its size`);
  }
  if ((view.byteOffset ?? 0) + size > fallback.byteLength) throw new Error(`view ${i} exceeds its fallback buffer`);
  const source = bin.subarray(packed.byteOffset ?? 0, (packed.byteOffset ?? 0) + packed.byteLength);
  const data = new Uint8Array(size);
  decoder.decodeGltfBuffer(data, packed.count, packed.byteStride, source, packed.mode, packed.filter);
  return data;
}
