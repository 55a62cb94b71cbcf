"""Compiles the C library into the wheel, with CC (cc), CPPFLAGS, CFLAGS and LDFLAGS.

WIGGLY_PLATFORM names the platform of the wheel where CC compiles for another machine, as `make wheel` does.
"""

import os
import shlex
import shutil
import subprocess
import sysconfig
import tempfile
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

# As in the Makefile, after the user's: no fused multiply-add, so that every machine has the same bits.
FLAGS = "-std=c11 -fPIC -fno-fast-math -ffp-contract=off -fno-math-errno -fno-trapping-math -fvisibility=hidden -D_GNU_SOURCE"


class LibraryHook(BuildHookInterface):
    def initialize(self, version, build_data):
        if version == "editable":  # finds the library in the tree's build folder
            return
        here = Path(self.root)
        tree = here / "c" if (here / "c").exists() else here.parent  # an sdist, or a clone
        platform = os.environ.get("WIGGLY_PLATFORM") or sysconfig.get_platform().replace("-", "_").replace(".", "_")
        name = "wiggly.dll" if platform.startswith("win") else "libwiggly.dylib" if platform.startswith("macosx") else "libwiggly.so"
        self.folder = tempfile.TemporaryDirectory()
        library = Path(self.folder.name) / name
        sources = [*sorted((tree / "src").glob("spline/*.c")), *sorted((tree / "src").glob("maths/*.c")), tree / "src" / "base" / "status.c"]
        compiler, preprocess, compile_, link = (shlex.split(os.environ.get(name, "")) for name in ("CC", "CPPFLAGS", "CFLAGS", "LDFLAGS"))
        compiler = compiler or ["cc"]
        if not shutil.which(compiler[0]):
            raise SystemExit(f"wiggly is written in C, and the compiler {compiler[0]!r} was not found: install one, or set CC to yours")
        done = subprocess.run(
            [*compiler, "-O3", *preprocess, *compile_, *FLAGS.split(), "-include", here / "exports.h", "-I", tree / "include", "-I", tree / "src",
             "-shared", "-s", *link, *sources, "-o", library, "-lm", *([] if platform.startswith("win") else ["-lpthread"])])  # fmt: skip
        if done.returncode:
            raise SystemExit(f"{compiler[0]} could not compile wiggly; its messages are above")
        build_data["force_include"] = {str(library): f"wiggly/{name}", str(tree / "LICENSE"): "wiggly/LICENSE"}
        build_data["pure_python"], build_data["tag"] = False, f"py3-none-{platform}"
