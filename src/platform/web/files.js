// Files: kept in the browser, dropped in, downloaded, and scenes as links.

const HOME = '/home/web_user', SCENES = '/usr/share/wiggly/scenes', MODELS = '/usr/share/wiggly/models';
const LARGEST_LINK = 32000;
const wait = 500; // milliseconds from a change until it is kept

const sync = (FS, fromBrowser) => new Promise(done => FS.syncfs(fromBrowser, done));

/// Mounts the user's folder, kept in the browser's storage, and the program's own. A file that is put there by the user's wish, which is not
/// a hidden one, is also downloaded.
export async function keep(FS) {
  for (const path of [SCENES, MODELS, '/usr/bin']) FS.mkdirTree(path);
  FS.writeFile('/usr/bin/wiggly', '');
  FS.symlink('/usr/bin/wiggly', '/proc/self/exe');
  FS.mount(FS.filesystems.IDBFS, {}, HOME);
  await sync(FS, true);
  FS.chdir(HOME);
  let timer, busy;
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(async () => {
      if (busy) return later();
      busy = true;
      await sync(FS, false);
      busy = false;
    }, wait);
  };
  const { rename, unlink } = FS;
  FS.rename = (from, to) => {
    rename(from, to);
    later();
    const path = FS.lookupPath(to).path;
    if (path.startsWith(HOME) && !path.includes('/.')) download(FS, path);
  };
  FS.unlink = path => {
    unlink(path);
    later();
  };
}

/// Fetches the characters of the built-in scenes, but for the fox, which the program holds.
export const fetchModels = FS => Promise.all(['dog.glb', 'creature.glb'].map(async name => {
  const answer = await fetch(`models/${name}`);
  if (answer.ok) FS.writeFile(`${MODELS}/${name}`, new Uint8Array(await answer.arrayBuffer()));
}));

function download(FS, path) {
  const link = document.createElement('a');
  link.download = path.slice(path.lastIndexOf('/') + 1);
  link.href = URL.createObjectURL(new Blob([FS.readFile(path)]));
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// Puts files into the user's folder and opens the first that is a scene or a character.
export async function receive(app, files) {
  const paths = [];
  for (const file of files) {
    const path = `${HOME}/${file.name}`;
    app.FS.writeFile(path, new Uint8Array(await file.arrayBuffer()));
    paths.push(path);
  }
  const first = paths.find(path => /\.(json|glb|gltf)$/i.test(path)) ?? paths[0];
  if (first) app.ccall('web_drop', null, ['string'], [first]);
}

// Links: the scene's JSON without spaces, deflated, in base64 for addresses.

const through = (bytes, stream) => new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer();

/// Of a scene's JSON. A RangeError says why there is none.
export async function writeLink(scene) {
  const text = JSON.stringify(JSON.parse(scene));
  const [, own] = /"((?!\.\.\/models\/)[^"]*\.(?:glb|gltf|obj))"/i.exec(text) ?? [];
  if (own) throw new RangeError(`A link holds no characters: send ${own.slice(own.lastIndexOf('/') + 1)} and the saved scene instead.`);
  const bytes = new Uint8Array(await through(new TextEncoder().encode(text), new CompressionStream('deflate-raw')));
  const link = '#' + btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join('')).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
  if (link.length > LARGEST_LINK) throw new RangeError('The scene is too large for a link: save it and send the file.');
  return link;
}

/// Writes a link's scene beside the built-in ones, whose characters it may name; its path, or null without a scene.
export async function readLink(FS, link) {
  if (link.length < 2) return null;
  try {
    const bytes = Uint8Array.from(atob(link.slice(1).replace(/-/g, '+').replace(/_/g, '/')), c => c.charCodeAt(0));
    const scene = await through(bytes, new DecompressionStream('deflate-raw'));
    FS.writeFile(`${SCENES}/link.json`, new Uint8Array(scene));
  } catch {
    throw new Error('The link is cut off or changed: ask for it again.');
  }
  return `${SCENES}/link.json`;
}
