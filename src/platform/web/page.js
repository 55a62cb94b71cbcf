// Starts the app in its page, and does what it asks of a browser (platform.c's page_… functions).
import { listen } from './input.js';
import { fetches, isFetching, keepPage, makeFolders, readLink, receive, tell, writeLink } from './files.js';
import { isStopped, stop } from './stopped.js';
import { isRefusing } from './store.js';

const canvas = document.getElementById('canvas');
const prefers = what => matchMedia(`(prefers-${what})`).matches;
const SETTINGS = '/home/web_user/.config/wiggly/settings';

let app, timer, lastError = '';
/// Says something above the canvas for a while, which begins with the first frame.
function say(text) {
  document.getElementById('said').textContent = text;
  clearTimeout(timer);
  const end = () => app?.isShown && !isFetching() && (document.getElementById('said').textContent = '');
  timer = setTimeout(end, 4000);
}

/// Of an error that nobody expected: the program may be wrong from here on.
function fall(error) {
  if (isStopped() || /-extension:/.test(error?.stack)) return;
  const isOutside = error?.stack && !error.stack.includes('wasm');
  try {
    if (isOutside) app?._web_hidden(); // the program itself is well
  } catch { /* what was kept last stays */ }
  stop(app, 'wiggly has stopped', { cause: error?.name === 'ExitStatus' ? lastError : `${error}` });
}
addEventListener('error', event => event.error && fall(event.error)); // without one: a resize that takes two frames, another site's script
addEventListener('unhandledrejection', event => fall(event.reason));
addEventListener('beforeunload', event => isRefusing() && document.title.startsWith('*') && event.preventDefault());

// The canvas's size in device pixels, which a frame takes over just before it is drawn. On a phone, all of the app is smaller.
const LEAST = { width: 360, height: 380 }; // logical pixels
const sized = (width, height) => ({ width, height, scale: Math.min(devicePixelRatio, width / LEAST.width, height / LEAST.height) });
const measured = ({ width, height }) => sized(...[width, height].map(side => Math.max(1, Math.round(side * devicePixelRatio))));
let ratio = devicePixelRatio, wanted = measured(canvas.getBoundingClientRect());
new ResizeObserver(([entry]) => {
  const exact = entry.devicePixelContentBoxSize?.[0], rough = measured(entry.contentRect);
  const isNear = exact && Math.abs(exact.inlineSize - rough.width) < 2; // not where a browser only acts as if it had another display
  wanted = isNear ? sized(exact.inlineSize, exact.blockSize) : rough;
}).observe(canvas);

const page = {
  size() {
    [canvas.width, canvas.height] = [wanted.width, wanted.height];
    page.unit = devicePixelRatio / wanted.scale; // logical pixels per pixel of the page
    return wanted;
  },
  resize() {
    if (ratio !== devicePixelRatio) wanted = measured(canvas.getBoundingClientRect()); // on another display now
    ratio = devicePixelRatio;
    if (canvas.width === wanted.width && canvas.height === wanted.height && page.scale === wanted.scale) return;
    page.scale = wanted.scale;
    const { width, height, scale } = page.size();
    app._web_size(width, height, scale);
  },
  title(title) {
    document.title = title;
    canvas.setAttribute('aria-label', title);
  },
  describe: text => (document.getElementById('scene').textContent = text),
  cursor: name => (canvas.style.cursor = name),
  copy: text => navigator.clipboard?.writeText(text).catch(() => say('The browser refused the clipboard.')),
  async fullscreen() {
    try {
      await (document.fullscreenElement ? document.exitFullscreen() : document.body.requestFullscreen());
    } catch { /* a phone may have none */ }
  },
  shown() {
    app.isShown = true;
    say(timer ? document.getElementById('said').textContent : ''); // "Loading …" goes
    performance.mark('first frame');
    keepPage();
  },
  fetches: path => fetches(app.FS, path, say),
  say,
  waits: () => isFetching() || isStopped(),
  stopped: () => stop(app, 'wiggly has ended'),
  choose: () => Object.assign(document.createElement('input'), {
    type: 'file', multiple: true, accept: '.json,.glb,.gltf,.bin,.png,.jpg,.obj',
    onchange() { receive(app, this.files).catch(error => say(error.message)); },
  }).click(),
  async share(scene) {
    let link;
    try {
      link = await writeLink(scene);
      history.replaceState(null, '', link);
      await navigator.clipboard?.writeText(location.href);
      say(navigator.clipboard ? 'The link is copied.' : 'The link is in the address bar.');
    } catch (error) {
      const why = error instanceof RangeError ? error.message : 'The scene cannot be a link: save it and send the file.';
      say(link ? 'The link is in the address bar.' : why);
    }
  },
};

/// A message of the command line, for a page.
const plain = text => text.replace(/\S*\/link\.json:(\d+: )?/, 'the link holds no scene: ')
  .replace(/^wiggly(?: live)?: (.)/, (_, first) => first.toUpperCase()).replace(/[^.]$/, '$&.');

/// The command line: the user's theme if none was chosen, stillness if the system asks for it, and what the link holds.
function commandLine(FS, linked) {
  const chosen = FS.analyzePath(SETTINGS).exists && /theme/.test(FS.readFile(SETTINGS, { encoding: 'utf8' }));
  const line = ['live'];
  if (!chosen && prefers('color-scheme: light')) line.push('--theme', 'light');
  if (prefers('reduced-motion: reduce')) line.push('--still');
  return linked ? [...line, linked] : line;
}

function complain(text) {
  console.warn(text);
  lastError = plain(text);
  say(lastError);
}

app = await createWiggly({ canvas, page, print: text => console.log(text), printErr: complain, onAbort: fall }).catch(error => {
  stop(app, 'wiggly could not start', { note: 'It needs a browser from 2023 or later, and a network at the first visit.', cause: `${error}` });
  throw error;
});
globalThis.wiggly = app;
await makeFolders(app.FS, () => say('The browser keeps no more files: save your work before you leave.'));
const findLinked = () => readLink(app.FS, location.hash).catch(error => (say(error.message), null));
const linked = await findLinked();
listen(canvas, app);
for (const type of ['dragover', 'drop']) addEventListener(type, event => event.preventDefault());
addEventListener('drop', event => receive(app, event.dataTransfer.files).catch(error => say(error.message)));
addEventListener('hashchange', async () => {
  const path = await findLinked();
  if (path) tell(app, 'web_drop', path);
});
addEventListener('visibilitychange', () => document.hidden && !isStopped() && app._web_hidden());
canvas.addEventListener('webglcontextlost', () => {
  if (!isStopped()) app._web_hidden();
  stop(app, 'The graphics driver was reset');
});
app.callMain(commandLine(app.FS, linked));
