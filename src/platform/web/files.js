// Files: dropped in, downloaded, and scenes as links.
import { HOME, keep, put } from './store.js';

const SCENES = '/usr/share/wiggly/scenes', MODELS = '/usr/share/wiggly/models';
const LARGEST_LINK = 32000, LARGEST_SCENE = 4 << 20; // characters; bytes
const PIECE = 1024; // bytes that are inflated at a time, to 1 MB at most
const LONGEST_NAME = 255; // letters

/// Makes the program's folders and the user's. A file that is put into the user's by the user's wish, which is not a hidden one, is also
/// downloaded.
export async function makeFolders(FS, onRefused) {
  for (const path of [SCENES, MODELS, '/usr/bin']) FS.mkdirTree(path);
  FS.writeFile('/usr/bin/wiggly', '');
  FS.symlink('/usr/bin/wiggly', '/proc/self/exe');
  await keep(FS, path => path.includes('/.') || download(FS, path), onRefused);
}

// The built-in scenes' characters are fetched when a scene shows them. The fox is in the program.
const coming = new Set(), refused = new Set(); // paths
export const isFetching = () => coming.size > 0;

/// Lets a service worker keep the page, where the browser has one. On a first visit characters come before the worker does: they are
/// fetched again, so that it keeps them.
export async function keepPage() {
  try {
    navigator.serviceWorker.addEventListener('controllerchange', () => performance.getEntriesByType('resource')
      .forEach(({ name }) => name.endsWith('.glb') && fetch(name).catch(() => {})));
    await navigator.serviceWorker.register('sw.js');
  } catch { /* the page needs a network each time */ }
}

/// Whether a file is on its way. One that does not come is asked for again the next time.
export function fetches(FS, path, say) {
  if (coming.has(path)) return true;
  if (!path.startsWith(MODELS) || FS.analyzePath(path).exists || refused.delete(path)) return false;
  const name = path.slice(MODELS.length + 1);
  const bring = async () => {
    const answer = await fetch(`models/${name}`);
    if (!answer.ok) throw new Error(answer.statusText);
    FS.writeFile(path, new Uint8Array(await answer.arrayBuffer()));
    say('');
  };
  coming.add(path);
  say(`Fetching ${name} …`);
  bring().catch(() => {
    refused.add(path);
    say(`${name} could not be fetched: open the scene again when you have a network.`);
  }).finally(() => coming.delete(path));
  return true;
}

export function download(FS, path, name = path.slice(path.lastIndexOf('/') + 1)) {
  const link = document.createElement('a');
  link.download = name;
  link.href = URL.createObjectURL(new Blob([FS.readFile(path)]));
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// Calls one of platform.c's functions with a text of any length.
export function tell(app, call, text, ...more) {
  const copy = app.allocateUTF8(text);
  return copy ? app[`_${call}`](copy, ...more) : app.page.say('There is not enough memory for that.');
}

/// A file that was dropped or chosen. Its name is valid UTF-8 and one part of a path.
async function take(file) {
  try {
    const name = new TextDecoder().decode(new TextEncoder().encode(file.name)).replace(/[/\0]/g, '_') || 'file';
    return { name: Array.from(name).slice(-LONGEST_NAME).join(''), bytes: new Uint8Array(await file.arrayBuffer()) };
  } catch {
    throw new Error(`${file.name} could not be read: a folder, or too large a file.`);
  }
}

/// `name`, or with a number if another file has it.
function freePath(FS, { name, bytes }) {
  const [, stem, end] = /^(.+?)(\.[^.]*)?$/s.exec(name);
  for (let n = 1; ; n++) {
    const path = `${HOME}/${n > 1 ? `${stem}-${n}${end ?? ''}` : name}`, { exists, object } = FS.analyzePath(path);
    const there = exists && bytes && FS.isFile(object.mode) ? FS.readFile(path) : null;
    if (!exists || (there?.length === bytes?.length && there?.every((byte, k) => byte === bytes[k]))) return path;
  }
}

/// Puts files into the user's folder and opens the first that is a scene or a character. They replace no file: one alone gets a free name,
/// several, which may name each other, a folder of their own.
export async function receive(app, files) {
  const { FS } = app, taken = await Promise.all(Array.from(files, take));
  if (!taken.length) return;
  const first = taken.find(({ name }) => /\.(json|glb|gltf)$/i.test(name)) ?? taken[0];
  let paths = taken.map(file => freePath(FS, file));
  if (taken.length > 1 && taken.some(({ name }, n) => paths[n] !== `${HOME}/${name}`)) {
    const folder = freePath(FS, { name: first.name.replace(/(.)\.[^.]*$/, '$1') });
    paths = taken.map(({ name }) => `${folder}/${name}`);
    FS.mkdir(folder);
  }
  taken.forEach(({ bytes }, n) => {
    FS.writeFile(paths[n], bytes);
    put(paths[n]);
  });
  tell(app, 'web_drop', paths[taken.indexOf(first)]);
}

// Links: the scene's JSON without spaces, deflated, in base64 for addresses.

/// What a stream makes of bytes. It stops beyond `most` bytes, of which a small link can hold any number.
async function through(bytes, stream, most = Infinity) {
  const source = new ReadableStream({
    start(to) {
      for (let at = 0; at < bytes.length; at += PIECE) to.enqueue(bytes.subarray(at, at + PIECE));
      to.close();
    },
  });
  const reader = source.pipeThrough(stream).getReader(), parts = [];
  for (let size = 0, part; !(part = await reader.read()).done;) {
    parts.push(part.value);
    size += part.value.length;
    if (size <= most) continue;
    reader.cancel().catch(() => {});
    throw new RangeError('too large');
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/// Of a scene's JSON. A RangeError says why there is none.
export async function writeLink(scene) {
  const text = JSON.stringify(JSON.parse(scene));
  const [, own] = /"((?!\.\.\/models\/)[^"]*\.(?:glb|gltf|obj))"/i.exec(text) ?? [];
  if (own) throw new RangeError(`A link holds no characters: send ${own.slice(own.lastIndexOf('/') + 1)} and the saved scene instead.`);
  const all = new TextEncoder().encode(text), bytes = await through(all, new CompressionStream('deflate-raw'));
  const link = '#' + btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join('')).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
  if (all.length > LARGEST_SCENE || link.length > LARGEST_LINK) throw new RangeError('The scene is too large for a link: save it and send the file.');
  return link;
}

/// Writes a link's scene beside the built-in ones, whose characters it may name; its path, or null without a scene.
export async function readLink(FS, link) {
  if (link.length < 2) return null;
  try {
    const bytes = Uint8Array.from(atob(link.slice(1).replace(/-/g, '+').replace(/_/g, '/')), c => c.charCodeAt(0));
    FS.writeFile(`${SCENES}/link.json`, await through(bytes, new DecompressionStream('deflate-raw'), LARGEST_SCENE));
  } catch (error) {
    throw new Error(error instanceof RangeError ? 'The link holds more than 4 MB, too much for a scene.'
      : 'The link is cut off or changed: ask for it again.');
  }
  return `${SCENES}/link.json`;
}
