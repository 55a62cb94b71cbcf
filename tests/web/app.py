"""The app's page as a user meets it: python3 app.py FOLDER OUT, a built page and a folder for screenshots and downloads. Each case says
"ok - what" or "not ok - what". SESSION=20 watches for 20 s, not 5, how fast it is."""
import base64
import json
import os
import pathlib
import re
import signal
import sys
import time
import traceback
import zlib

import chromium
import firefox
import serve
from wait import until

FOLDER, OUT = map(pathlib.Path, sys.argv[1:3])
MODELS = pathlib.Path(__file__).parents[2] / 'assets/models'
STILL = {'color_scheme': 'light', 'reduced_motion': 'reduce'}
KNOT, LOWER = (244, 449), (244, 530)  # the first knot of "sway" at 1280 × 720
FOUND, PANELS = (150, 210), (60, 300, 250, 420)  # on a phone of 390 × 844: the first command found; x, y, width, height of the curves and settings
HOME, RECOVERY = '/home/web_user', '/home/web_user/.local/state/wiggly/recovery-1'
STAGE = (340, 20, 650, 370)  # x, y, width, height: beside the card
FIRST_FRAME = "performance.getEntriesByName('first frame')[0]?.startTime"
STORED = '''new Promise(done => (indexedDB.open('wiggly').onsuccess = ({ target: { result: database } }) => {
    database.transaction('files').objectStore('files').getAllKeys().onsuccess = ({ target }) => done(target.result.length > 2);
}))'''
FETCHED = "performance.getEntriesByType('resource').some(({ name }) => name.endsWith('.glb'))"
# All that is said from now on, however briefly.
HEAR = '''globalThis.heard = [], new MutationObserver(() => heard.push(document.getElementById('said').textContent))
    .observe(document.getElementById('said'), { childList: true })'''
# How many pixels of the canvas differ from the last look at it.
LOOK = '''(([x, y, width, height]) => {
    const [canvas, copy] = [document.getElementById('canvas'), new OffscreenCanvas(width, height)];
    const scale = canvas.width / canvas.clientWidth, context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, x * scale, y * scale, width * scale, height * scale, 0, 0, width, height);
    const before = globalThis.lastLook, now = globalThis.lastLook = context.getImageData(0, 0, width, height).data;
    return before?.length === now.length ? now.reduce((sum, value, k) => sum + (k % 4 === 1 && Math.abs(value - before[k]) > 16), 0) : -1;
})'''


def look(page, box=STAGE):
    return page.evaluate(f'{LOOK}({list(box)})')


def frames(page, count=3):
    """Waits until the app has drawn what it was told."""
    page.evaluate(f'(async () => {{ for (let n = 0; n < {count}; n++) await new Promise(requestAnimationFrame); }})()')


def opened(browser, url, fresh=True, size=(1280, 720, 1), fingers=False, **media):
    page = browser.page(*size, fresh=fresh)
    page.prefer(**{**STILL, **media})
    if fingers:
        page.fingers()
    return reopened(page, url)


def reopened(page, url):
    page.open(url)
    page.until('the first frame', FIRST_FRAME)
    frames(page)
    return page


def share(page):
    """The link's part behind #, from its #."""
    page.evaluate("history.replaceState(null, '', location.pathname)")
    page.key('Ctrl+Shift+L')
    return page.until('a link', 'location.hash')


def scene(page):
    text = share(page)[1:]
    return json.loads(zlib.decompress(base64.urlsafe_b64decode(text + '=' * (-len(text) % 4)), -15))


def title(page):
    return page.evaluate('document.title')


def described(page):
    """What a screen reader says of the canvas."""
    return page.evaluate("document.getElementById(document.getElementById('canvas').getAttribute('aria-describedby')).textContent")


def said(page):
    return page.evaluate("document.getElementById('said').textContent")


def stored(page, path):
    """The first knot's value of a scene in the page's files, or None."""
    return page.evaluate(f'''wiggly.FS.analyzePath('{path}').exists &&
        JSON.parse(wiggly.FS.readFile('{path}', {{ encoding: 'utf8' }})).splines[0].knots[0].value''')


def told(page, what, condition):
    until(what, lambda: condition(title(page)))


def changed(page):
    """The scene once its first knot is dragged down."""
    page.drag(KNOT, LOWER)
    told(page, 'a star in the title', lambda text: text.startswith('*'))
    return scene(page)


def expect(value, what):
    if not value:
        raise AssertionError(what)


def starts(browser, url):
    page = browser.page(fresh=True)
    page.open(url)
    took = page.until('the first frame', FIRST_FRAME)
    print(f'first frame after {took / 1000:.2f} s')
    frames(page)
    look(page)
    until('a fox that moves', lambda: look(page) > 500)
    name, role = page.evaluate("(canvas => [canvas.ariaLabel, canvas.getAttribute('role')])(document.getElementById('canvas'))")
    expect('untitled' in name and role == 'application', f'the canvas is called {name}, a {role}')
    expect('curves over time' in described(page), f'a paragraph says what the page is: {described(page)}')
    expect('On the stage: tail. Splines: sway, up, breath, blink. It plays.' in described(page), f'and what is shown: {described(page)}')
    time.sleep(2)  # what is done once is over
    seconds = int(os.environ.get('SESSION', 5))
    page.evaluate('longTasks.length = 0')
    count = page.evaluate(f'''new Promise(done => {{
        const start = performance.now();
        let count = 0;
        requestAnimationFrame(function next(now) {{
            now - start < {seconds * 1000} ? (count++, requestAnimationFrame(next)) : done(count);
        }});
    }})''')
    long = [round(took) for _, took in page.evaluate('longTasks')]
    print(f'{count / seconds:.0f} frames a second, tasks longer than 50 ms in {seconds} s: {len(long)} {sorted(long)[-5:]}')
    expect(not (found := page.problems()), f'the console says {found}')
    page.close()


def command(page, *words):
    page.key('F3')
    for word in words:
        page.type(word)
        page.key('Enter')


def edits(browser, url):
    page = opened(browser, url)
    look(page)
    time.sleep(0.5)
    expect(look(page) == 0, 'with reduced motion the fox stands still at first')
    start = scene(page)
    moved = changed(page)
    values = [one['splines'][0]['knots'][0]['value'] for one in (start, moved)]
    expect(values[1] < values[0] - 0.3, f'a knot that is dragged down goes from {values[0]} to {values[1]}')
    expect(look(page) > 500, 'the tail follows the knot')
    page.key('Ctrl+Z')
    told(page, 'a title without a star', lambda text: not text.startswith('*'))
    expect(scene(page) == start, 'undo brings the scene back')
    page.key('Ctrl+Shift+Z')
    told(page, 'a star again', lambda text: text.startswith('*'))
    expect(scene(page) == moved, 'redo brings the change back')
    page.key('I')
    frames(page)
    expect(len(scene(page)['splines'][0]['knots']) == 5, 'the key I inserts a knot')
    look(page)
    page.key('Space')
    until('a fox that moves', lambda: look(page) > 500)
    page.key('Space')
    page.wheel(600, 200, -300)
    frames(page)
    expect(look(page) > 500, 'the wheel zooms')
    expect(not (found := page.problems()), f'the console says {found}')
    page.close()


def link_of(data):
    """Bytes as a link's part behind #."""
    deflate = zlib.compressobj(9, wbits=-15)
    return '#' + base64.urlsafe_b64encode(deflate.compress(data) + deflate.flush()).decode().rstrip('=')


def links(browser, url):
    page = opened(browser, url)
    link = share(page)
    print(f'the link of the start scene: {len(link)} bytes')
    expect(len(link) <= 2048, 'the link of the start scene has at most 2 KB')
    sent, link = changed(page), page.evaluate('location.hash')
    page.close()
    other = opened(browser, url + link)
    expect(scene(other) == sent, 'a link holds the scene, for a stranger, too')
    reopened(other, url + link[:-20])
    expect('cut off' in said(other), f'a broken link is said to be one: {said(other)}')
    for words, data in (('holds no scene: splines[0].name: expected', b'{"wiggly": 1, "frames": [0, 9], "splines": [{"name": 3}]}'),
                        ('holds no scene: splines[0]: expected', b'{"wiggly": 1, "frames": [0, 9], "splines": [{"na'),
                        ('holds no scene: scene: expected', b'x'), ('holds more than 4 MB', b' ' * (300 << 20))):
        reopened(other, url + link_of(data))
        expect(words in said(other), f'a broken scene is said to be one: {said(other)}')
        expect(scene(other)['splines'][0]['name'] == 'sway', 'and the start scene is there')
    other.close()


def shared(browser, url):
    page = opened(browser, url)
    link, start = share(page), scene(page)
    page.drag(KNOT, LOWER)
    until('the newer work in a recovery file', lambda: stored(page, RECOVERY))
    reopened(page, url + link)
    expect(not title(page).startswith('*'), "the link's scene is there at first")
    page.key('Enter')
    told(page, 'the work that is newer than the link', lambda text: text.startswith('*'))
    expect(scene(page) != start, 'it is another scene')
    page.close()


def kept(browser, url):
    page = opened(browser, url)
    work = changed(page)
    until('a recovery file with the work', lambda: stored(page, RECOVERY) == work['splines'][0]['knots'][0]['value'])
    reopened(page, url)
    page.key('Enter')
    told(page, 'the work as it was before the reload', lambda text: text.startswith('*'))
    expect(scene(page) == work, 'it is the same scene')
    page.close()


def tabs(browser, url):
    one = opened(browser, url)
    work = changed(one)
    one.key('Ctrl+Z')
    told(one, 'a title without a star', lambda text: not text.startswith('*'))
    time.sleep(1)  # so that the drag's begin is kept at once, but not its end
    one.drag(KNOT, LOWER)
    told(one, 'a star again', lambda text: text.startswith('*'))
    other = browser.page(beside=one)
    other.prefer(**STILL)
    reopened(other, url)
    other.key('Enter')
    frames(other)
    expect(title(other) == 'untitled — wiggly', f"another tab's work is not offered: {title(other)}")
    other.key('Ctrl+S')
    frames(other)
    other.key('Enter')
    told(other, "the scene's name", lambda text: text.startswith('untitled.json'))
    one.until('the scene that the other tab saved', "wiggly.FS.analyzePath('/home/web_user/untitled.json').exists")
    one.close()
    reopened(other, url)
    other.key('Enter')
    told(other, 'the work of the tab that was closed', lambda text: text.startswith('*untitled —'))
    expect(scene(other) == work, 'it is the same scene')
    expect(other.evaluate("wiggly.FS.analyzePath('/home/web_user/untitled.json').exists"), 'and the saved scene is there')
    other.close()


def files(browser, url):
    page = opened(browser, url)
    folder = OUT / 'downloads'
    folder.mkdir()
    page.downloads(folder.resolve())
    for kind, beginning in ('glb', b'glTF'), ('csv', b'frame'), ('csv', b'frame'), ('gif', b'GIF89a'):
        page.key('Ctrl+E')
        frames(page)
        page.type(f'fox.{kind}')
        page.key('Enter')
        file = folder / f'fox.{kind}'
        until(f'the download of {file.name}', file.exists)
        expect(file.read_bytes().startswith(beginning), f'{file.name} begins as such files do')
        file.unlink()
    page.drag(KNOT, LOWER)
    saved = scene(page)
    page.key('Ctrl+S')
    frames(page)
    page.key('Enter')
    file = folder / 'untitled.json'
    until('the download of the scene', file.exists)
    expect(json.loads(file.read_text())['splines'] == saved['splines'], 'the scene that is saved is the one that is shown')
    told(page, "the scene's name", lambda text: text.startswith('untitled.json'))
    command(page, 'new')
    told(page, 'a new scene', lambda text: text == 'untitled — wiggly')
    until('words on the new scene', lambda: 'It is paused' in described(page) and 'breath' not in described(page))
    expect(len(scene(page)['splines'][0]['knots']) == 1, 'a new scene has one knot')
    look(page)
    page.drop(600, 200, file)
    told(page, 'the scene that was dropped', lambda text: text.startswith('untitled.json'))
    frames(page)
    expect(scene(page) == saved, 'the scene that was dropped is the one that was saved')
    expect(not (found := page.problems()), f'the console says {found}')
    page.close()


def save_as(page, name):
    page.key('Ctrl+Shift+S')
    frames(page)
    page.key('Ctrl+A')
    page.type(name)
    page.key('Enter')
    told(page, 'the new name', lambda text: text.startswith(name))


def received(browser, url):
    page = opened(browser, url)
    page.downloads(OUT)
    page.drag(KNOT, LOWER)
    save_as(page, 'walk.json')
    mine = stored(page, f'{HOME}/walk.json')
    page.key('I')
    told(page, 'unsaved work', lambda text: text.startswith('*walk.json'))
    theirs = OUT / 'received' / 'walk.json'
    theirs.parent.mkdir()
    theirs.write_bytes((MODELS.parent / 'scenes/tail.json').read_bytes())
    page.drop(600, 200, theirs)
    until('the file that was dropped', lambda: stored(page, f'{HOME}/walk-2.json'))
    expect(stored(page, f'{HOME}/walk.json') == mine, 'the scene that was saved is as it was')
    frames(page)
    page.key('Escape')
    frames(page)
    expect(title(page).startswith('*walk.json'), f'the work stays: {title(page)}')
    page.key('Ctrl+S')
    told(page, 'the saved scene', lambda text: text.startswith('walk.json'))
    mine = stored(page, f'{HOME}/walk.json')
    page.drop(600, 200, theirs)
    told(page, 'the dropped scene by a free name', lambda text: text.startswith('walk-2.json'))
    expect(stored(page, f'{HOME}/walk.json') == mine, 'and under its own the first one is')

    glb = (MODELS / 'dog.glb').read_bytes()
    length = int.from_bytes(glb[12:16], 'little')
    gltf = json.loads(glb[20:20 + length])
    gltf['buffers'][0]['uri'] = 'dog.bin'
    (theirs.parent / 'dog.gltf').write_text(json.dumps(gltf))
    (theirs.parent / 'dog.bin').write_bytes(glb[28 + length:])
    page.evaluate(f"wiggly.FS.writeFile('{HOME}/dog.bin', 'other')")
    look(page)
    page.drop(600, 200, theirs.parent / 'dog.bin', theirs.parent / 'dog.gltf')
    until('the character whose buffer had the name of another file', lambda: look(page) > 5000)
    expect(page.evaluate(f"wiggly.FS.readFile('{HOME}/dog.bin').length") == 5, 'and that file is as it was')

    page.evaluate('''(data => {
        data.items.add(new File(['{}'], 'x'.repeat(1.5e6) + '.json'));
        document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, dataTransfer: data }));
    })(new DataTransfer())''')
    page.until('a file whose name is larger than the stack', f"wiggly.FS.readdir('{HOME}').some(name => name.length === 255)")
    frames(page)
    expect(not (found := page.problems()), f'the console says {found}')
    page.close()


def cleared(browser, url):
    page = opened(browser, url)
    page.downloads(OUT)
    page.key('I')
    until('a recovery file', lambda: stored(page, RECOVERY))
    browser.call('Storage.clearDataForOrigin', session=page.session, origin=url.rstrip('/'), storageTypes='all')
    page.key('Ctrl+Z')
    work = changed(page)
    until('the work in a recovery file', lambda: stored(page, RECOVERY) == work['splines'][0]['knots'][0]['value'])
    save_as(page, 'cleared.json')
    until('its download', (OUT / 'cleared.json').exists)
    page.drag(LOWER, KNOT)
    told(page, 'a star', lambda text: text.startswith('*'))
    frames(page)
    page.until('files in a new database', STORED)
    reopened(page, url)
    expect(stored(page, f'{HOME}/cleared.json'), 'the saved scene is kept')
    page.key('Enter')
    told(page, 'the work since', lambda text: text.startswith('*cleared.json'))

    page.evaluate("new Promise(done => (indexedDB.deleteDatabase('wiggly').onsuccess = done))")  # another page of the same host
    page.evaluate("IDBFactory.prototype.open = () => { throw new Error('no') }")
    save_as(page, 'refused.json')
    until('the download of what is not kept', (OUT / 'refused.json').exists)
    page.until('a word that nothing is kept', "/keeps no more files/.test(document.getElementById('said').textContent)")
    frames(page)
    page.drag(KNOT, LOWER)
    told(page, 'a program that goes on', lambda text: text.startswith('*refused.json'))
    expect(not (found := page.problems()), f'the console says {found}')
    page.close()


def stops(browser, url):
    for number, (what, ends) in enumerate((('an error', "setTimeout(() => { throw new Error('for the test') })"),
                                           ('a promise', "void Promise.reject(new Error('for the test'))"),
                                           ('the program', "wiggly.page.title = () => { throw new Error('for the test') }"))):
        page = browser.page(fresh=True)
        if number:
            page.resize(390, 844, mobile=True)
        page.prefer(color_scheme='dark' if number == 1 else 'light', reduced_motion='reduce')
        reopened(page, url)
        page.downloads(OUT)
        page.key('I')
        value = scene(page)['splines'][0]['knots'][0]['value']
        until('the work in a recovery file', lambda: stored(page, RECOVERY) == value)
        page.evaluate(ends)
        if what == 'the program':
            page.key('Ctrl+Z')  # the title changes
        text = page.until(f'words on {what}', "document.querySelector('dialog[open]')?.innerText")
        page.screenshot(OUT / f'stopped-{number}.png')
        expect('wiggly has stopped' in text and 'is kept as of' in text and 'for the test' in text, f'it says so: {text}')
        page.key('Escape')
        page.until('the words again', "document.querySelector('dialog[open]') && document.activeElement.id === 'again'")
        page.evaluate("document.getElementById('work').click()")
        file = OUT / 'untitled.recovered.json'
        until('the download of the work', file.exists)
        expect(json.loads(file.read_text())['splines'][0]['knots'][0]['value'] == value, 'it is the work')
        file.unlink()
        page.evaluate("longTasks.isOld = true")
        page.key('Space')
        page.until('a reload by the button', f'!longTasks.isOld && {FIRST_FRAME}')
        frames(page)
        page.key('Enter')
        told(page, 'the work', lambda text: text.startswith('*'))
        page.close()


def characters(browser, url):
    page = opened(browser, url)
    look(page)
    page.drop(600, 200, MODELS / 'dog.glb')
    until('the character that was dropped', lambda: look(page) > 5000)
    page.screenshot(OUT / 'dropped.png')
    page.key('Ctrl+Shift+L')
    page.until('a word that no link holds it', "/no characters/.test(document.getElementById('said').textContent)")
    reopened(page, url)
    expect(not page.evaluate(FETCHED), 'no character is fetched before it is shown')
    look(page)
    page.call('Network.emulateNetworkConditions', offline=False, latency=1000, downloadThroughput=-1, uploadThroughput=-1)
    page.evaluate(HEAR)
    command(page, 'examples', 'dog')
    page.until('a word that it is fetched', "heard.includes('Fetching dog.glb …')")
    until('the dog', lambda: look(page) > 5000)
    frames(page)
    page.screenshot(OUT / 'dog.png')
    expect('dog.glb' in json.dumps(scene(page)), 'the scene with the dog is shared by its name')
    link = page.evaluate('location.hash')
    page.close()
    page = opened(browser, url + link)
    expect(page.evaluate(FETCHED), "a link's character is there in the first frame")
    expect(not (found := page.problems()), f'the console says {found}')
    page.close()


def keeps(browser, url):
    page = opened(browser, url)
    for key, code, held, kept in (('F5', 'F5', '', False), ('r', 'KeyR', 'ctrl', False), ('l', 'KeyL', 'ctrl', False), ('f', 'KeyF', 'ctrl', False),
                                  ('p', 'KeyP', 'ctrl', False), ('ArrowLeft', 'ArrowLeft', 'alt', False), ('z', 'KeyZ', 'ctrl', True), ('F1', 'F1', '', True)):
        event = f"new KeyboardEvent('keydown', {{ key: '{key}', code: '{code}', {held}{'Key: true,' if held else ''} bubbles: true, cancelable: true }})"
        expect(page.evaluate(f"document.getElementById('canvas').dispatchEvent({event})") != kept, f'{held} {key}: kept is not {kept}')
        frames(page)
    page.key('Escape')
    for fields in range(100):
        if page.evaluate("document.activeElement.id !== 'canvas'"):
            break
        page.key('Tab')
        frames(page, 1)
    expect(5 < fields < 99, f'Tab leaves the page after {fields} fields')
    page.close()


def swipe(page, start, by=(0, 0)):
    """By one finger; without a way a tap."""
    page.touch('touchStart', start)
    for n in range(1, 9) if any(by) else ():
        page.touch('touchMove', tuple(a + b * n / 8 for a, b in zip(start, by)))
        frames(page, 1)
    page.touch('touchEnd')
    frames(page)


def touches(browser, url):
    page = opened(browser, url, size=(1280, 772, 1), fingers=True)  # the bar takes 52
    bar = page.evaluate("[...document.querySelectorAll('#bar button')].map(button => button.offsetHeight)")
    expect(len(bar) == 11 and min(bar) > 40, f'the bar has eleven keys for fingers: {bar}')
    start = scene(page)
    look(page)
    page.touch('touchStart', (500, 200), (700, 200))
    for n in range(8):
        page.touch('touchMove', (500 - 8 * n, 200 - 5 * n), (700 + 8 * n, 200 + 5 * n))
        frames(page, 1)
    page.touch('touchEnd')
    frames(page)
    expect(look(page) > 2000, 'two fingers zoom and turn')
    page.touch('touchStart', (500, 200), (700, 200))
    for n in range(8):
        page.touch('touchMove', (500 + 8 * n, 200), (700 + 8 * n, 200))
        frames(page, 1)
    page.touch('touchEnd')
    frames(page)
    expect(look(page) > 2000, 'two fingers pan')
    expect(scene(page) == start, 'and change nothing of the scene')
    expect(not (found := page.problems()), f'the console says {found}')
    page.screenshot(OUT / 'fingers.png')
    page.close()


def phone(browser, url):
    page = browser.page(fresh=True)
    page.resize(390, 844, mobile=True)
    page.fingers()
    page.prefer(**STILL)
    reopened(page, url)
    start = scene(page)
    more, undo, type_key = (page.evaluate(f'''(box => [box.x + box.width / 2, box.y + box.height / 2])(
        document.querySelector('#bar [data-{which}]').getBoundingClientRect())''') for which in ('key=F3', 'key=Z', 'does=type'))
    for what, place, by in (('a knot', (107, 328), (0, 40)), ('the tail', (182, 128), (-40, 30)), ('the body', (258, 160), (-40, 0))):
        swipe(page, place, by)
        told(page, f'{what} dragged by a finger', lambda text: text.startswith('*'))
        swipe(page, undo)
        told(page, 'Undo by the bar', lambda text: not text.startswith('*'))
    expect(scene(page) == start, 'all of it is undone')

    swipe(page, more)
    swipe(page, type_key)
    page.until('the field that is typed into', "document.activeElement.id === 'typed'")
    page.call('Input.insertText', text='pin the point')
    frames(page)
    swipe(page, FOUND)
    told(page, 'a pin put by a finger', lambda text: text.startswith('*'))
    pin = scene(page)['rigs'][0]['pins'][0]
    swipe(page, (171, 114), (-40, 30))
    until('the pin dragged by a finger', lambda: scene(page)['rigs'][0]['pins'][0]['to'] != pin['to'])

    look(page, PANELS)
    page.evaluate('globalThis.before = lastLook')
    same = 'lastLook.reduce((sum, value, k) => sum + (Math.abs(value - before[k]) > 16), 0) < 500'
    page.key('F1')
    frames(page)
    expect(look(page, PANELS) > 2000, 'F1 shows all keys')
    swipe(page, (195, 500), (0, -200))
    expect(look(page, PANELS) > 2000, 'a finger scrolls them')
    swipe(page, (300, 782))
    until('a tap beside them that hides them', lambda: look(page, PANELS) == 0 and page.evaluate(same))
    expect(not (found := page.problems()), f'the console says {found}')
    page.close()


def pastes(browser, url):
    pages = [opened(browser, url) for _ in range(2)]
    for page in pages:
        browser.call('Browser.grantPermissions', permissions=['clipboardReadWrite', 'clipboardSanitizedWrite'], **page.context)
    pages[0].key('Ctrl+A')
    pages[0].key('Ctrl+C')
    pages[0].until('knots in the clipboard', "navigator.clipboard.readText().then(text => text.includes('frame'))")
    pages[1].key('Ctrl+V')
    told(pages[1], 'knots from the other page', lambda text: text.startswith('*'))
    expect(len(scene(pages[1])['splines'][0]['knots']) == 8, 'four more')
    for length in 1_400_000, 20_000_000:  # more than the stack, more than the app takes
        pages[1].evaluate(f'''(data => {{
            data.setData('text/plain', 'x'.repeat({length}));
            dispatchEvent(new KeyboardEvent('keydown', {{ key: 'v', code: 'KeyV', ctrlKey: true }}));
            dispatchEvent(new ClipboardEvent('paste', {{ clipboardData: data }}));
        }})(new DataTransfer())''')
        frames(pages[1])
    pages[1].key('Ctrl+Z')
    told(pages[1], 'a program that goes on', lambda text: not text.startswith('*'))
    for page in pages:
        expect(not (found := page.problems()), f'the console says {found}')
        page.close()


def offline(browser, url):
    page = browser.page(fresh=True)
    page.prefer(**STILL)
    with serve.Server(FOLDER) as server:
        reopened(page, server.url)
        page.until('a service worker', 'navigator.serviceWorker.ready.then(() => true)')
        page.until('its cache', '''caches.keys().then(names => names.length && caches.open(names[0])).then(cache => cache && cache.keys())
            .then(files => files && files.some(file => file.url.endsWith('wiggly.wasm')))''')
        look(page)
        command(page, 'examples', 'dog')
        until('the dog', lambda: look(page) > 5000)
    reopened(page, server.url)
    look(page)
    command(page, 'examples', 'phases')
    page.until('a word that a character does not come', "/creature.glb could not/.test(document.getElementById('said').textContent)")
    until('the scene without it', lambda: look(page) > 5000)
    command(page, 'examples', 'dog')
    until('the dog, which was kept', lambda: look(page) > 5000)
    page.close()


def sizes(browser, url):
    page = opened(browser, url, size=(900, 600, 2))
    canvas = "(canvas => [canvas.width, canvas.height])(document.getElementById('canvas'))"
    expect(page.evaluate(canvas) == [1800, 1200], f'two pixels of the canvas per pixel of the page: {page.evaluate(canvas)}')
    page.screenshot(OUT / 'twice.png')
    page.resize(1000, 700)
    until('a canvas of the new size', lambda: page.evaluate(canvas) == [1000, 700])
    page.resize(390, 760, 2, mobile=True)
    frames(page)
    page.screenshot(OUT / 'phone.png')
    expect(page.evaluate('document.documentElement.scrollWidth <= innerWidth'), 'nothing sticks out of a phone')
    page.close()


def themes(browser, url):
    bright = {}
    for name in ('light', 'dark'):
        page = opened(browser, url, color_scheme=name)
        look(page, (1010, 600, 80, 40))
        bright[name] = page.evaluate('lastLook[1]')
        page.screenshot(OUT / f'{name}.png')
        page.close()
    expect(bright['light'] > 200 and bright['dark'] < 80, f'the theme is the system\'s: green is {bright}')


def without_webgl(_, url):
    with chromium.Chromium('--disable-3d-apis') as browser:
        page = browser.page()
        page.open(url)
        says = "/no WebGL 2/.test(document.getElementById('said')?.textContent)"
        page.until('a word on WebGL', says)
        text = page.evaluate("document.getElementById('said').textContent")
        expect(text.startswith('This browser') and text.endswith('.'), f'it is a plain sentence: {text}')
        time.sleep(4.5)  # other words go after 4
        expect(page.evaluate(says), 'the word stays')


def in_firefox(_, url):
    with firefox.Firefox(1280, 806) as browser:
        browser.open(url)
        browser.until('the first frame', FIRST_FRAME)
        height = browser.evaluate("document.getElementById('canvas').clientHeight")
        expect(height == 720, f'the canvas has {height} pixels')
        browser.drag(KNOT, LOWER)
        browser.screenshot(OUT / 'firefox.png')
        until('a star in the title', lambda: browser.evaluate('document.title').startswith('*'))
        browser.key('z', ctrl=True)
        until('a title without a star', lambda: not browser.evaluate('document.title').startswith('*'))


CASES = [
    ('the page starts without a complaint, plays, and says what it is', starts),
    ('mouse and keys edit the scene, and undo', edits),
    ('a link holds the scene', links),
    ('after a reload of the link, work that is newer is offered', shared),
    ('unsaved work is offered again after a reload', kept),
    ('each tab keeps its own work, and all share what is saved', tabs),
    ('exports and scenes are downloads, and scenes come back by a drop', files),
    ('files that come replace none', received),
    ('without a database it goes on, and downloads what is saved', cleared),
    ('where it stops it says so, and offers what is kept', stops),
    ('a character is dropped in, and the built-in dog opens', characters),
    ('the browser keeps its keys, and Tab leaves the page', keeps),
    ('two fingers pan, zoom and turn', touches),
    ('on a phone a finger drags, pins and reads the help', phone),
    ('knots are pasted from page to page', pastes),
    ('without a network it opens again', offline),
    ('the canvas follows the size and the display', sizes),
    ('the theme is the system\'s', themes),
    ('without WebGL it says so', without_webgl),
    ('Firefox loads it and drags', in_firefox),
]


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    only = re.compile(sys.argv[3] if len(sys.argv) > 3 else '')
    failed = 0
    with serve.Server(FOLDER) as server, chromium.Chromium() as browser:
        for what, case in CASES:
            if not only.search(case.__name__):
                continue
            if case is in_firefox and not firefox.find():
                print('skip - firefox is not installed')
                continue
            start = time.monotonic()
            try:
                case(browser, server.url)
                print(f'ok - {what} ({time.monotonic() - start:.1f} s)', flush=True)
            except Exception:
                failed += 1
                traceback.print_exc(file=sys.stdout)
                print(f'not ok - {what}', flush=True)
                for number, page in enumerate(browser.pages.copy().values()):
                    page.screenshot(OUT / f'{case.__name__}-{number}.png')
                    page.close()
    sys.exit(failed > 0)


main()
