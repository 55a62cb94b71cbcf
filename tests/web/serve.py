"""A folder by HTTP on a free port of this machine, as a static host serves it."""
import functools
import http.server
import threading


class Handler(http.server.SimpleHTTPRequestHandler):
    protocol_version = 'HTTP/1.1'
    extensions_map = {
        '': 'application/octet-stream', '.css': 'text/css', '.html': 'text/html', '.js': 'text/javascript',
        '.json': 'application/json', '.mjs': 'text/javascript', '.svg': 'image/svg+xml', '.wasm': 'application/wasm'}

    def do_GET(self):
        if self.server.is_stopped:  # a connection that was opened before
            self.close_connection = True
        else:
            super().do_GET()

    def log_message(self, *_):
        pass


class Server:
    """with Server('build/web') as server: … server.url …"""

    def __init__(self, folder):
        self.http = http.server.ThreadingHTTPServer(('127.0.0.1', 0), functools.partial(Handler, directory=str(folder)))
        self.http.daemon_threads = True
        self.http.is_stopped = False
        self.url = f'http://localhost:{self.http.server_port}/'
        self.thread = threading.Thread(target=self.http.serve_forever, args=(0.05,), daemon=True)
        self.thread.start()

    def stop(self):
        """From now on nobody answers at the address."""
        self.http.is_stopped = True
        if self.thread.is_alive():
            self.http.shutdown()
            self.thread.join()
            self.http.server_close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()
