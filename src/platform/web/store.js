// The user's folder, which the browser keeps and all tabs share. Recovery files are each tab's own, as they are each program's on a desktop.

export const HOME = '/home/web_user';
const RECOVERY = `${HOME}/.local/state/wiggly/recovery-`;
const PATIENCE = 1000; // milliseconds until a tab that was closed is seen to be gone
const tab = `wiggly ${Date.now()} ${Math.random()}`; // a lock of this name ends with the tab
const nameOf = path => (path.startsWith(RECOVERY) ? `${tab}/${path.slice(RECOVERY.length)}` : path);
const others = new BroadcastChannel('wiggly');
const locked = (name, options, then) => navigator.locks?.request(name, options, then) ?? then();
let database, complain = () => {};

const result = request => new Promise((done, failed) => {
  request.onsuccess = () => done(request.result);
  request.onerror = () => failed(request.error);
});

/// In a new transaction.
function files() {
  const transaction = database.transaction('files', 'readwrite');
  transaction.onabort = complain;
  return transaction.objectStore('files');
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
  const opening = indexedDB.open('wiggly', 1);
  opening.onupgradeneeded = () => opening.result.createObjectStore('files');
  database = await result(opening);
  await new Promise(held => locked(tab, {}, () => (held(), navigator.locks && new Promise(() => {}))));
  return locked('wiggly', {}, read); // one tab after another
})().catch(() => null);

function place(FS, path, { bytes, time }) {
  FS.mkdirTree(path.slice(0, path.lastIndexOf('/')));
  FS.writeFile(path, bytes);
  FS.utime(path, time, time);
}

/// Keeps a file as it is now.
export function put(FS, path) {
  const file = { bytes: FS.readFile(path), time: Date.now() };
  if (database) {
    const all = files();
    all.put(file, nameOf(path));
    all.transaction.commit(); // at once, for the tab may be closing
  }
  if (!path.startsWith(RECOVERY)) others.postMessage({ path, file });
}

/// Brings the folder back, and keeps what the app puts there: it writes a file beside, which it renames.
export async function keep(FS, onWritten, onRefused) {
  FS.mkdirTree(HOME);
  FS.chdir(HOME);
  const { rename, unlink } = FS;
  FS.rename = (from, to) => {
    rename(from, to);
    const { path } = FS.lookupPath(to);
    if (!path.startsWith(HOME)) return;
    put(FS, path);
    onWritten(path);
  };
  FS.unlink = file => {
    const { path } = FS.lookupPath(file);
    unlink(file);
    if (database && path.startsWith(RECOVERY)) files().delete(nameOf(path));
  };
  others.onmessage = ({ data }) => place(FS, data.path, data.file);
  complain = onRefused;
  const found = await reading;
  found ? found.forEach((file, path) => place(FS, path, file)) : complain();
}
