// The user's folder, which the browser keeps and all tabs share. Recovery files are each tab's own, as they are each program's on a desktop.
// A browser may refuse to keep files, and may close the database at any time. The program goes on without it: nothing here throws into it.

export const HOME = '/home/web_user';
const RECOVERY = `${HOME}/.local/state/wiggly/recovery-`;
const PATIENCE = 1000; // milliseconds until a tab that was closed is seen to be gone, and until a closed database is opened again
const tab = `wiggly ${Date.now()} ${Math.random()}`; // a lock of this name ends with the tab
const nameOf = path => (path.startsWith(RECOVERY) ? `${tab}/${path.slice(RECOVERY.length)}` : path);
const locked = async (name, options, then) => (navigator.locks ? navigator.locks.request(name, options, then) : then());
const paths = new Set(); // of all files that the database should hold
const unkept = new Set(); // those that changed, or went, since it last held them
let FS, others, database, opening, isRefused = false, complain = () => {};

const result = request => new Promise((done, failed) => {
  request.onsuccess = () => done(request.result);
  request.onerror = () => failed(request.error);
});

const files = () => database.transaction('files', 'readwrite').objectStore('files');

/// Once, until it works again.
function refuse() {
  if (!isRefused) complain();
  isRefused = true;
}

/// Whether files were not kept the last time.
export const isRefusing = () => isRefused;

async function open() {
  const request = indexedDB.open('wiggly', 1);
  request.onupgradeneeded = () => request.result.createObjectStore('files');
  const opened = database = await result(request);
  opened.onclose = opened.onversionchange = () => { // "Clear site data", a fault of the disk
    opened.close();
    setTimeout(reopen, PATIENCE);
  };
}

/// Keeps what the database lacks, too, which may be a new one.
function reopen() {
  opening ??= (async () => {
    await open();
    const names = new Set(await result(files().getAllKeys()));
    [...paths, ...unkept].filter(path => unkept.has(path) || !names.has(nameOf(path))).forEach(update);
  })().catch(refuse).finally(() => (opening = null));
}

/// Makes the database hold a file as it is now, or no longer. At once, for the tab may be closing.
function update(path) {
  const isThere = paths.has(path);
  unkept.add(path);
  try {
    const all = files(); // throws if it is closed
    isThere ? all.put({ bytes: FS.readFile(path), time: FS.stat(path).mtime.getTime() }, nameOf(path)) : all.delete(nameOf(path));
    all.transaction.onabort = () => {
      unkept.add(path);
      refuse();
    };
    all.transaction.oncomplete = () => {
      unkept.delete(path);
      isRefused = false;
    };
    all.transaction.commit();
  } catch {
    reopen();
  }
}

const isLeft = name => !name.startsWith('/') &&
  locked(name.split('/')[0], { signal: AbortSignal.timeout(PATIENCE) }, () => true).catch(() => false);

/// All files by path. Of the recovery files whose tabs are gone, the newest becomes this tab's.
async function read() {
  const all = files(), [names, kept] = await Promise.all([result(all.getAllKeys()), result(all.getAll())]);
  const left = await Promise.all(names.map(isLeft)), newest = Math.max(...kept.filter((_, n) => left[n]).map(file => file.time));
  const found = new Map(), mine = names.findIndex((_, n) => left[n] && kept[n].time === newest);
  names.forEach((name, n) => name.startsWith('/') && found.set(name, kept[n]));
  if (mine < 0) return found;
  const path = `${RECOVERY}1`, again = files();
  again.put(kept[mine], nameOf(path));
  again.delete(names[mine]);
  return found.set(path, kept[mine]);
}

/// Begins while the program is still fetched.
const reading = (async () => {
  others = new BroadcastChannel('wiggly');
  await open();
  await new Promise((held, failed) => locked(tab, {}, () => (held(), navigator.locks && new Promise(() => {}))).catch(failed));
  return locked('wiggly', {}, read); // one tab after another
})().catch(() => null);

function place(path, { bytes, time }) {
  try {
    FS.mkdirTree(path.slice(0, path.lastIndexOf('/')));
    FS.writeFile(path, bytes);
    FS.utime(path, time, time);
    paths.add(path);
  } catch { /* a folder is there, or it is too large: all others come */ }
}

/// Keeps a file as it is now.
export function put(path) {
  paths.add(path);
  if (!path.includes('/.')) isRefused = false; // the user's own, about which the user hears each time
  update(path);
  try {
    if (!path.startsWith(RECOVERY)) others?.postMessage({ path, file: { bytes: FS.readFile(path), time: Date.now() } });
  } catch { /* the other tabs see it at their next start */ }
}

/// The newest recovery file: { path, time }, or undefined without unsaved work.
export function newestWork() {
  const times = [...paths].filter(path => path.startsWith(RECOVERY)).map(path => ({ path, time: FS.stat(path).mtime }));
  return times.sort((a, b) => b.time - a.time)[0];
}

/// Brings the folder back, and keeps what the app puts there: it writes a file beside, which it renames. `onWritten` comes first.
export async function keep(system, onWritten, onRefused) {
  [FS, complain] = [system, onRefused];
  FS.mkdirTree(HOME);
  FS.chdir(HOME);
  const { rename, unlink } = FS;
  FS.rename = (from, to) => {
    rename(from, to);
    const { path } = FS.lookupPath(to);
    if (!path.startsWith(HOME)) return;
    try {
      onWritten(path);
    } catch {
      complain();
    }
    put(path);
  };
  FS.unlink = file => {
    const { path } = FS.lookupPath(file);
    unlink(file);
    if (paths.delete(path) && path.startsWith(RECOVERY)) update(path);
  };
  const found = await reading;
  found ? found.forEach((file, path) => place(path, file)) : refuse();
  if (others) others.onmessage = ({ data }) => place(data.path, data.file);
}
