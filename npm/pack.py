"""Writes builds of the solver as one module of text, packed as one, for they hardly differ: pack.py OUT.js UNPACK.wasm WASM..."""

import base64
import lzma
import sys
from pathlib import Path

out, unpacker, *builds = map(Path, sys.argv[1:])
data = [build.read_bytes() for build in builds]
settings = {"id": lzma.FILTER_LZMA1, "lc": 3, "lp": 0, "pb": 0, "dict_size": 1 << 20, "nice_len": 273, "depth": 1000}
packed = lzma.compress(b"".join(data), format=lzma.FORMAT_RAW, filters=[settings])
out.write_text(
    f"export const lengths = {[len(build) for build in data]}\n"
    f"export const unpacker = '{base64.b64encode(unpacker.read_bytes()).decode()}'\n"
    f"export const packed = '{base64.b64encode(packed).decode()}'\n"
)
