// A point cache of ours (.pc2): where vertex v is in frame f.
import { readFileSync } from 'fs';

export function readCache(path) {
  const bytes = readFileSync(path);
  const vertices = bytes.readInt32LE(16), frames = bytes.readInt32LE(28);
  const at = (f, v) => [0, 1, 2].map((k) => bytes.readFloatLE(32 + 4 * (3 * (f * vertices + v) + k)));
  return { vertices, frames, at };
}
