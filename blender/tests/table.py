"""What the extension promises, as measured by measure.py, as a table with a column for each Blender.

Usage: python table.py tests/README.md python...          measures with each of these Pythons, and writes the table into the page
       python table.py --check tests/README.md python     compares the page with the Blender of this Python
"""
import json
import math
import os
import subprocess
import sys
import tempfile

ROWS = (  # key, name, promise
    ('order', '1,000 frames in random order', 0), ('backwards', '1,000 frames backwards', 0),
    ('reload', 'reloaded without the extension, untrusted', 0), ('keys', 'keys are missed by', 1e-5), ('bake', 'baked', 1e-5),
    ('seam', 'last frame of a loop, from its first', 1e-6), ('rates', '24, 25, 30 and 60 frames a second', 0.01),
    ('renders', 'rendered frame by frame, not as an animation', 0), ('chain', 'a chain with 240 frames, KB in a compressed file', 10),
    ('plain', 'in one that is not compressed', None), ('sample', 'bytes of each frame of it', 300),
    ('frame', '50 chains of 8 bones, ms a frame', None), ('edit', 'edited keys, ms a chain', None),
    ('edit one', 'one edited key in 50 chains, ms', None))
VARY = 'chain', 'plain', 'frame', 'edit', 'edit one'  # from run to run
HEAD, END = '<!-- made by `make blender-proof` -->\n', '\n<!-- -->'


def shown(name, value):
    if value is None:
        return ''
    if name in VARY:
        return f'{value:.1f}'
    if name == 'rates':
        return f'{100 * value:.1g} %'
    return '0' if value == 0 else f'{value:.2g}' if value >= 1e-3 else f'< 1e{math.floor(math.log10(value)) + 1}'


def worse(found):
    return [f'{name} {shown(key, found[key])}, promised {most:g}' for key, name, most in ROWS if most is not None and not found[key] <= most]


def table(all_found):
    """Of several Blenders, with a column of what the handler does in the last."""
    lines = [['', *(f'Blender {found["version"]}' for found in all_found), 'a handler'], ['---'] * (len(all_found) + 2)]
    for key, name, _ in ROWS:
        lines.append([name, *(shown(key, found[key]) for found in all_found), shown(key, all_found[-1].get('handler ' + key))])
    return '\n'.join('| ' + ' | '.join(line) + ' |' for line in lines)


def run(python):
    with tempfile.TemporaryDirectory() as folder:
        said = subprocess.run([python, os.path.join(os.path.dirname(__file__), 'measure.py')], capture_output=True, text=True,
                              env={**os.environ, 'TMPDIR': folder, 'PYTHONDONTWRITEBYTECODE': '1'})
    line = next((line for line in said.stdout.splitlines() if line.startswith('measured ')), None)
    if not line:
        sys.exit(f'{python}: {said.stderr.strip() or said.stdout.strip()}')
    return json.loads(line[9:])


def committed(page):
    """The page's numbers: (version, name) → text."""
    rows = [[cell.strip() for cell in line.strip('|').split('|')] for line in page.split(HEAD)[1].split(END)[0].splitlines()]
    return {(version.removeprefix('Blender '), row[0]): cell for row in rows[2:] for version, cell in zip(rows[0][1:], row[1:])}


def main(arguments):
    check = arguments[0] == '--check'
    path, *pythons = arguments[check:]
    page = open(path).read()
    all_found = [run(python) for python in pythons]
    print(table(all_found))
    problems = [f'Blender {found["full"]}: {problem}' for found in all_found for problem in worse(found)]
    if check:
        said, version = committed(page), all_found[0]['version']
        for key, name, _ in ROWS if any(of == version for of, _ in said) else ():
            now = shown(key, all_found[0][key])
            if said.get((version, name)) != now and not (key in VARY and (version, name) in said):
                problems.append(f'{path} says {said.get((version, name))} of "{name}", Blender {version} has {now}: run make blender-proof')
    elif not problems:
        before, rest = page.split(HEAD)
        open(path, 'w').write(before + HEAD + table(all_found) + END + rest.split(END, 1)[1])
    sys.exit('\n'.join(problems) or 0)


main(sys.argv[1:])
