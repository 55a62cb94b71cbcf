"""Firefox without a window, by Marionette: JSON with its length in front, over TCP. Its WebGL needs an X server all the same."""
import base64
import contextlib
import json
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile

from wait import LIMIT, start, stop, until

PREFERENCES = '''user_pref("marionette.port", 0);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("webgl.force-enabled", true);
user_pref("network.captive-portal-service.enabled", false);
'''


def find():
    """The program's path, or None, also where there is no Xvfb."""
    return shutil.which('Xvfb') and next(filter(None, map(shutil.which, ('firefox-esr', 'firefox'))), None)


class Firefox:
    """with Firefox(1280, 720) as firefox: firefox.open(url)"""

    def __init__(self, width=1280, height=720):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        folder = pathlib.Path(self.profile.name)
        (folder / 'user.js').write_text(PREFERENCES)
        self.server = start(['Xvfb', '-displayfd', '1', '-nolisten', 'tcp'], stdout=subprocess.PIPE)
        display = self.server.stdout.readline().decode().strip()
        self.process = start([find(), '--headless', '--marionette', '--no-remote', '--profile', self.profile.name,
                              '--width', str(width), '--height', str(height)],
                             env={**os.environ, 'DISPLAY': f':{display}', 'HOME': self.profile.name})
        self.socket, self.number = None, 0
        try:
            file = folder / 'MarionetteActivePort'
            port = until("Firefox's port", lambda: file.exists() and file.read_text().strip())
            self.socket = socket.create_connection(('127.0.0.1', int(port)), LIMIT)
            self.stream = self.socket.makefile('rb')
            self.read('a greeting')
            self.call('WebDriver:NewSession', capabilities={})
        except BaseException:
            self.__exit__()
            raise

    def read(self, what):
        try:
            length = b''
            while (byte := self.stream.read(1)) != b':':
                if not byte:
                    raise RuntimeError(f'Firefox ended while it was asked for {what}')
                length += byte
            return json.loads(self.stream.read(int(length)))
        except TimeoutError:
            raise TimeoutError(f'waited {LIMIT} s for {what}') from None

    def call(self, command, **parameters):
        self.number += 1
        text = json.dumps([0, self.number, command, parameters])
        self.socket.sendall(f'{len(text.encode())}:{text}'.encode())
        _, _, error, result = self.read(f'an answer to {command}')
        if error:
            raise RuntimeError(f'{command}: {error["message"]}')
        return result

    def open(self, url):
        self.call('WebDriver:Navigate', url=url)

    def evaluate(self, expression):
        """Of JavaScript; waits for a promise's value."""
        return self.call('WebDriver:ExecuteScript', script=f'return {expression}', args=[], sandbox=None)['value']

    def until(self, what, expression, limit=LIMIT):
        """The first true value of JavaScript."""
        return until(what, lambda: self.evaluate(expression), limit)

    def actions(self, kind, actions, **more):
        self.call('WebDriver:PerformActions', actions=[{'type': kind, 'id': kind, 'actions': actions, **more}])

    def drag(self, begin, end, steps=8):
        def move(k):
            x, y = (round(a + (b - a) * k) for a, b in zip(begin, end))
            return {'type': 'pointerMove', 'x': x, 'y': y, 'duration': 30, 'origin': 'viewport'}
        self.actions('pointer', [move(0), {'type': 'pointerDown', 'button': 0}, *(move(n / steps) for n in range(1, steps + 1)),
                                 {'type': 'pointerUp', 'button': 0}], parameters={'pointerType': 'mouse'})

    def key(self, key, ctrl=False):
        held = '\ue009'
        presses = [*([held] if ctrl else []), key]
        self.actions('key', [*({'type': 'keyDown', 'value': k} for k in presses), *({'type': 'keyUp', 'value': k} for k in reversed(presses))])

    def screenshot(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.call('WebDriver:TakeScreenshot', full=False)['value']))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(RuntimeError, OSError, AttributeError):
            self.call('Marionette:Quit', flags=['eForceQuit'])
        stop(self.process)
        stop(self.server, 0)
        self.server.stdout.close()
        if self.socket:
            self.socket.close()
        self.profile.cleanup()
