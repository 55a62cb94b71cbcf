// What is said over the page when the program has ended, and the offer of what is kept.
import { download } from './files.js';
import { isRefusing, newestWork } from './store.js';

const byId = id => document.getElementById(id);
let isOver = false;

/// Whether no more frames may be drawn and nothing be kept: the program's memory may be wrong.
export const isStopped = () => isOver;

/// What became of the work, as one sentence or two.
function fate(work, hasStar) {
  if (!work) return hasStar ? 'What you did since the last save could not be kept.' : 'All your work is saved.';
  return `Your unsaved work is kept as of ${work.time.toLocaleString([], { dateStyle: 'medium', timeStyle: 'medium' })}. ` +
    (isRefusing() ? 'But the browser keeps no more files: download it before you reload.' : 'It is offered when you reload, or download it now.');
}

/// Ends the program, of which `app` may be undefined: it never began.
export function stop(app, title, { note, cause = '' } = {}) {
  if (isOver) return;
  isOver = true;
  const [, star, scene] = /^(\*?)(.*?)(?:\.json)? — wiggly$/.exec(document.title) ?? [];
  const work = newestWork();
  byId('said').textContent = '';
  byId('why').textContent = title;
  byId('fate').textContent = note ?? fate(work, star);
  byId('cause').textContent = cause;
  byId('work').hidden = !work;
  byId('work').onclick = () => download(app.FS, work.path, `${scene ?? 'scene'}.recovered.json`);
  byId('again').onclick = () => {
    if (!app?.isShown) history.replaceState(null, '', location.pathname + location.search); // not the same link again
    location.reload();
  };
  const dialog = byId('stopped');
  dialog.addEventListener('close', () => dialog.showModal()); // by Escape: there is nothing behind it to go back to
  dialog.addEventListener('keydown', event => event.stopPropagation()); // the program's keys are the browser's again
  dialog.showModal();
}
