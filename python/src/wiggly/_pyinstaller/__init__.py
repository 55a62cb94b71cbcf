"""For PyInstaller, which finds it by an entry point: where the hook is."""

from pathlib import Path


def folders() -> list[str]:
    return [str(Path(__file__).parent)]
