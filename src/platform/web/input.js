// Mouse, pen, fingers and keys, as the app's events (platform.c's web_… functions).
import { tell } from './files.js';

const SHIFT = 1, CTRL = 2, ALT = 4, SUPER = 8, FINGER = 16;
const RELEASE = 0, PRESS = 1, REPEAT = 2;
const LEFT = 0, RIGHT = 1, MIDDLE = 2;
const TURN = 0.08, ZOOM = 0.12; // of the stage for a notch of the wheel: radians, and a power of e
const STILL = 6; // logical pixels that a finger may shake
const LONGEST_TEXT = 17 << 20; // letters, more than the app takes: it says so
const BUTTONS = [LEFT, MIDDLE, RIGHT]; // by the browser's numbers
const NAMES = { ' ': 'Space', ArrowLeft: 'Left', ArrowRight: 'Right', ArrowUp: 'Up', ArrowDown: 'Down' };
const isMac = /Mac|iPhone|iPad/.test(navigator.platform);

/// Command stands for Ctrl on a Mac.
function modsOf(event) {
  const meta = event.metaKey ? (isMac ? CTRL : SUPER) : 0;
  return (event.shiftKey && SHIFT) | (event.ctrlKey && CTRL) | (event.altKey && ALT) | meta;
}

/// As the app names keys: letters and signs by their print, digits by their place, letters too where the layout has no Latin ones.
function nameOf(event) {
  const [, digit] = /^(?:Digit|Numpad)(\d)$/.exec(event.code) ?? [];
  const [, letter] = /^Key([A-Z])$/.exec(event.code) ?? [];
  const printed = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const isLatin = printed.length === 1 && printed > ' ' && printed <= '~';
  return NAMES[event.key] ?? digit ?? (letter && !isLatin ? letter : printed);
}

export function listen(canvas, app) {
  const key = (name, action, mods = 0) => tell(app, 'web_key', name, action, mods);
  const type = text => { for (const c of text) app._web_text(c.codePointAt(0)); };
  const tap = (name, mods = 0) => { key(name, PRESS, mods); key(name, RELEASE, mods); };
  const place = event => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) * app.page.unit, (event.clientY - box.top) * app.page.unit];
  };

  // Mouse and pen.
  const isFinger = event => event.pointerType === 'touch';
  const focus = () => { if (document.activeElement !== canvas) canvas.focus({ preventScroll: true }); };
  canvas.addEventListener('pointerdown', event => {
    focus();
    try {
      canvas.setPointerCapture(event.pointerId);
    } catch { /* it was lifted already */ }
  });
  for (const [name, action] of [['mousedown', PRESS], ['mouseup', RELEASE]])
    canvas.addEventListener(name, event => { if (event.button < 3) app._web_button(BUTTONS[event.button], action, modsOf(event), event.timeStamp, ...place(event)); });
  canvas.addEventListener('mousemove', event => app._web_pointer(...place(event), modsOf(event)));
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const notch = [100, 3, 1][event.deltaMode];
    const sideways = event.shiftKey && !event.deltaY; // browsers turn the wheel with Shift
    app._web_wheel(sideways ? 0 : -event.deltaX / notch, -(sideways ? event.deltaX : event.deltaY) / notch, modsOf(event), ...place(event));
  }, { passive: false });

  // Fingers: one is the left button, once it has moved or is lifted; two pan as the middle button, zoom as the wheel, and turn as the wheel sideways.
  const fingers = new Map();
  let held = null; // LEFT, MIDDLE or null
  let waits = null; // where a single finger was put down, until it is the left button
  const middle = () => { const all = [...fingers.values()]; return [0, 1].map(k => all.reduce((sum, at) => sum + at[k], 0) / all.length); };
  const press = (button, at, time) => { [held, waits] = [button, null]; app._web_button(button, PRESS, FINGER, time, ...at); };
  const release = at => { if (held !== null) app._web_button(held, RELEASE, FINGER, 0, ...at); held = null; };
  const spread = () => { const [a, b] = [...fingers.values()]; return [Math.hypot(b[0] - a[0], b[1] - a[1]), Math.atan2(b[1] - a[1], b[0] - a[0])]; };
  canvas.addEventListener('pointerdown', event => {
    if (!isFinger(event) || fingers.size === 2) return;
    event.preventDefault(); // no mouse events besides
    if (held === LEFT) tap('Escape'); // a second finger takes back what the first began
    if (fingers.size) release(middle());
    fingers.set(event.pointerId, place(event));
    app._web_pointer(...middle(), FINGER);
    if (fingers.size === 1) waits = middle();
    else press(MIDDLE, middle(), event.timeStamp);
  });
  canvas.addEventListener('pointermove', event => {
    if (!fingers.has(event.pointerId)) return;
    const two = fingers.size === 2, before = two && spread();
    fingers.set(event.pointerId, place(event));
    const at = middle();
    if (waits && Math.hypot(at[0] - waits[0], at[1] - waits[1]) < STILL) return;
    if (waits) press(LEFT, waits, event.timeStamp);
    app._web_pointer(...at, FINGER);
    if (!two) return;
    const [distance, angle] = spread();
    const turned = Math.atan2(Math.sin(angle - before[1]), Math.cos(angle - before[1]));
    app._web_wheel(turned / TURN, Math.log(distance / before[0]) / ZOOM, 0, ...middle());
  });
  for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, event => {
    if (!fingers.has(event.pointerId)) return;
    const at = middle();
    fingers.delete(event.pointerId);
    if (waits && name === 'pointerup') press(LEFT, waits, event.timeStamp);
    waits = null;
    release(at); // a finger that stays does nothing more
  });

  // Keys. What is typed arrives after its key, as from a window.
  const down = new Map();
  addEventListener('keydown', event => {
    if (!event.key) return; // a browser's own filling in of a form
    if (event.target.closest?.('#bar, dialog')) return; // a button's
    const name = nameOf(event), mods = modsOf(event);
    const typed = event.key.length === 1 && (event.getModifierState('AltGraph') || !(mods & (CTRL | ALT | SUPER)));
    if (event.isComposing || event.key === 'Unidentified' || event.key === 'F12') return; // input events follow, or the browser's tools
    if (!typed && !tell(app, 'web_keeps', name, mods)) return; // the browser's: Tab at the last field, F5, Ctrl+F
    if (!(mods & CTRL && name === 'V')) event.preventDefault(); // else no paste event comes
    down.set(event.code, name);
    key(name, event.repeat ? REPEAT : PRESS, mods);
    if (typed) type(event.key);
  });
  addEventListener('keyup', event => {
    if (!event.key) return;
    key(down.get(event.code) ?? nameOf(event), RELEASE, modsOf(event));
    down.delete(event.code);
  });
  addEventListener('blur', () => {
    for (const name of down.values()) key(name, RELEASE);
    down.clear();
  });
  addEventListener('paste', event => tell(app, 'web_clipboard', (event.clipboardData?.getData('text') ?? '').slice(0, LONGEST_TEXT)));

  // A keyboard on the screen types into a field that nobody sees.
  const field = document.getElementById('typed');
  field.addEventListener('beforeinput', event => {
    event.preventDefault();
    if (event.inputType.startsWith('delete')) tap('Backspace');
    else if (event.inputType === 'insertLineBreak') tap('Enter');
    else type(event.data ?? '');
  });
  const bar = document.getElementById('bar');
  bar.addEventListener('pointerdown', event => event.preventDefault()); // the canvas keeps the focus
  bar.addEventListener('click', event => { // not earlier: a finger may scroll the bar
    const { key: name, mods, does } = event.target.closest('button')?.dataset ?? {};
    if (name) tap(name, Number(mods ?? 0));
    if (does) field.focus();
  });
  focus();
}
