"""Chromium without a window, by its own protocol over two pipes (--remote-debugging-pipe)."""
import base64
import contextlib
import json
import os
import select
import shutil
import tempfile
import time

from wait import LIMIT, start, stop, until

ALT, CTRL, META, SHIFT = 1, 2, 4, 8
MODS = {'Alt': ALT, 'Ctrl': CTRL, 'Meta': META, 'Shift': SHIFT}
CODES = {'Backspace': 8, 'Tab': 9, 'Enter': 13, 'Escape': 27, 'End': 35, 'Home': 36, 'ArrowLeft': 37, 'ArrowUp': 38,
         'ArrowRight': 39, 'ArrowDown': 40, 'Delete': 46, **{f'F{n}': 111 + n for n in range(1, 13)}}
LONG_TASKS = '''globalThis.longTasks = []; new PerformanceObserver(list => {
    for (const { startTime, duration } of list.getEntries()) longTasks.push([startTime, duration]);
}).observe({ type: 'longtask', buffered: true })'''


def find():
    """The program's path, or None."""
    return next(filter(None, map(shutil.which, ('chromium', 'chromium-browser', 'google-chrome'))), None)


class Chromium:
    """with Chromium() as chromium: page = chromium.page()"""

    def __init__(self, *arguments):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        reads, self.out = os.pipe()
        self.into, writes = os.pipe()
        line = [find(), '--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
                '--disable-background-networking', '--disable-component-update', '--disable-dev-shm-usage', '--disable-quic',
                '--disable-sync', '--no-first-run', '--mute-audio', '--remote-debugging-pipe', f'--user-data-dir={self.profile.name}']
        shell = ['bash', '-c', 'exec "${@:3}" 3<&$1 4>&$2', 'bash', str(reads), str(writes)]
        self.process = start([*shell, *line, *arguments], pass_fds=(reads, writes))
        os.close(reads)
        os.close(writes)
        self.rest, self.number, self.answers, self.pages = b'', 0, {}, {}

    def take(self, what, end, limit):
        """Reads one message: an answer, or a page's event."""
        while b'\0' not in self.rest:
            if not select.select([self.into], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError(f'waited {limit} s for {what}')
            more = os.read(self.into, 1 << 20)
            if not more:
                raise RuntimeError(f'Chromium ended while it was asked for {what}')
            self.rest += more
        text, self.rest = self.rest.split(b'\0', 1)
        message = json.loads(text)
        if 'id' in message:
            self.answers[message['id']] = message
        elif message.get('sessionId') in self.pages:
            self.pages[message['sessionId']].events.append(message)

    def call(self, method, session=None, limit=LIMIT, **parameters):
        self.number += 1
        number = self.number
        message = {'id': number, 'method': method, 'params': parameters, **({'sessionId': session} if session else {})}
        os.write(self.out, json.dumps(message).encode() + b'\0')
        end = time.monotonic() + limit
        while number not in self.answers:
            self.take(f'an answer to {method}', end, limit)
        answer = self.answers.pop(number)
        if 'error' in answer:
            raise RuntimeError(f'{method}: {answer["error"]["message"]}')
        return answer['result']

    def page(self, width=1280, height=720, scale=1, fresh=False, beside=None):
        """`fresh`: with a profile of its own, that holds nothing yet. `beside`: with that page's."""
        context = {'browserContextId': self.call('Target.createBrowserContext')['browserContextId']} if fresh else {}
        context = beside.context if beside else context
        target = self.call('Target.createTarget', url='about:blank', **context)['targetId']
        return Page(self, target, context, (width, height, scale))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(RuntimeError, TimeoutError, OSError):
            self.call('Browser.close', limit=10)
        stop(self.process)
        os.close(self.out)
        os.close(self.into)
        self.profile.cleanup()


class Page:
    def __init__(self, chromium, target, context, size):
        self.chromium, self.target, self.context, self.events = chromium, target, context, []
        self.session = chromium.call('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        chromium.pages[self.session] = self
        for domain in ('Page', 'Runtime', 'Log', 'Network'):
            self.call(f'{domain}.enable')
        self.call('Page.addScriptToEvaluateOnNewDocument', source=LONG_TASKS)
        self.resize(*size)

    def call(self, method, **parameters):
        return self.chromium.call(method, self.session, **parameters)

    def close(self):
        self.chromium.call('Target.closeTarget', targetId=self.target)
        del self.chromium.pages[self.session]

    def evaluate(self, expression, limit=LIMIT):
        """Of JavaScript; waits for a promise's value."""
        answer = self.call('Runtime.evaluate', expression=expression, awaitPromise=True, returnByValue=True, limit=limit)
        if 'exceptionDetails' in answer:
            what = answer['exceptionDetails']
            raise RuntimeError(f'{what.get("exception", {}).get("description", what["text"])}, in: {expression}')
        return answer['result'].get('value')

    def until(self, what, expression, limit=LIMIT):
        """The first true value of JavaScript."""
        return until(what, lambda: self.evaluate(expression), limit)

    def open(self, url):
        """Always loads, even where only the part behind # is another."""
        self.call('Page.navigate', url='about:blank')
        answer = self.call('Page.navigate', url=url)
        if 'errorText' in answer:
            raise RuntimeError(f'{url}: {answer["errorText"]}')

    def problems(self):
        """What the page complained of since the last call: exceptions, console errors and warnings, failed requests."""
        found = []
        for event in self.events:
            kind, what = event['method'], event['params']
            if kind == 'Runtime.exceptionThrown':
                details = what['exceptionDetails']
                found.append(details.get('exception', {}).get('description') or details['text'])
            elif kind == 'Runtime.consoleAPICalled' and what['type'] in ('error', 'warning', 'assert'):
                found.append(' '.join(str(arg.get('value', arg.get('description'))) for arg in what['args']))
            elif kind == 'Log.entryAdded' and what['entry']['level'] == 'error':
                found.append(f'{what["entry"]["text"]} {what["entry"].get("url", "")}')
        self.events.clear()
        return found

    def screenshot(self, path):
        data = self.call('Page.captureScreenshot', format='png')['data']
        with open(path, 'wb') as file:
            file.write(base64.b64decode(data))

    # What the system tells a page.

    def resize(self, width, height, scale=1, mobile=False):
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=scale, mobile=mobile)

    def prefer(self, **features):
        """prefer(color_scheme='light', reduced_motion='reduce')"""
        self.call('Emulation.setEmulatedMedia',
                  features=[{'name': 'prefers-' + name.replace('_', '-'), 'value': value} for name, value in features.items()])

    def fingers(self):
        self.call('Emulation.setTouchEmulationEnabled', enabled=True, maxTouchPoints=5)

    def downloads(self, folder):
        self.chromium.call('Browser.setDownloadBehavior', behavior='allow', downloadPath=str(folder), **self.context)

    # What a hand does. Positions are pixels of the page.

    def mouse(self, kind, x, y, button='none', mods=0, **more):
        self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, button=button, modifiers=mods,
                  buttons={'none': 0, 'left': 1, 'right': 2, 'middle': 4}[button], **more)

    def drag(self, start, end, steps=8, button='left', mods=0):
        self.mouse('mouseMoved', *start, mods=mods)
        self.mouse('mousePressed', *start, button, mods, clickCount=1)
        for n in range(1, steps + 1):
            self.mouse('mouseMoved', *(a + (b - a) * n / steps for a, b in zip(start, end)), button, mods)
        self.mouse('mouseReleased', *end, button, mods, clickCount=1)

    def wheel(self, x, y, dy, dx=0, mods=0):
        self.mouse('mouseWheel', x, y, mods=mods, deltaX=dx, deltaY=dy)

    def key(self, name):
        """key('Ctrl+Shift+L'), key('Space'), key('F1')"""
        *held, name = name.split('+')
        mods = sum(MODS[mod] for mod in held)
        code, number = name, CODES.get(name, ord(name[0]))
        if len(name) == 1:
            code = ('Key' if name.isalpha() else 'Digit') + name
            name = name if mods & SHIFT else name.lower()
        elif name == 'Space':
            name, number = ' ', 32
        typed = {'text': name} if len(name) == 1 and not mods & (ALT | CTRL | META) else {}
        what = {'key': name, 'code': code, 'modifiers': mods, 'windowsVirtualKeyCode': number}
        edits = {'commands': ['paste']} if code == 'KeyV' and held == ['Ctrl'] else {}
        self.call('Input.dispatchKeyEvent', type='keyDown', **what, **typed, **edits)
        self.call('Input.dispatchKeyEvent', type='keyUp', **what)

    def type(self, text):
        for letter in text:
            self.key(letter)

    def touch(self, kind, *points):
        """touch('touchStart', (x, y), …), touch('touchMove', …), touch('touchEnd')"""
        self.call('Input.dispatchTouchEvent', type=kind,
                  touchPoints=[{'x': x, 'y': y, 'id': n} for n, (x, y) in enumerate(points)])

    def drop(self, x, y, *paths):
        data = {'items': [], 'files': [os.path.abspath(path) for path in paths], 'dragOperationsMask': 1}
        for kind in ('dragEnter', 'dragOver', 'drop'):
            self.call('Input.dispatchDragEvent', type=kind, x=x, y=y, data=data)
