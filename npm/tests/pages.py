"""Opens the example pages in Chromium and compares how far each box goes with the spring: pages.py FOLDER, with the package beside it"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "web"))
import chromium
from serve import Server

PROBE = """
const seen = window.seen = []
let last
window.gap = 0 // the longest between two frames that differ, s
requestAnimationFrame(function look(now) {
  const output = document.querySelector('output'), box = document.querySelector('#box'), style = box && getComputedStyle(box)
  const [before] = seen.slice(-1)
  if (output?.value) seen.push(+output.value)
  else if (box) seen.push(new DOMMatrix(style.transform).e + (parseFloat(style.translate) || 0))
  if (seen.length > 1 && seen.at(-1) !== before) gap = Math.max(gap, (now - last) / 1000)
  last = now
  requestAnimationFrame(look)
})
"""
PEAK, LAST = 293.25, 60  # of the spring of every page, px
BEND = 14700  # how fast it turns back at the peak, px/s²
# How far the browser's easing is from the spring, px.
EASING = """(async () => {
  const { spring } = await import(new URL('../wiggly/index.js', location))
  const s = spring({ keys: [[0, 0], [0.4, 200], [1.2, 60]], frequency: 2, damping: 0.2 })
  const [animation] = document.getAnimations(), box = document.querySelector('#box')
  if (!animation) return 1e9
  animation.pause()
  animation.currentTime = 0
  let worst = 0, from = box.getBoundingClientRect().x
  for (let t = 0; t < s.duration; t += 0.01) {
    animation.currentTime = 1000 * t
    worst = Math.max(worst, Math.abs(box.getBoundingClientRect().x - from - s.at(t)))
  }
  animation.play()
  return worst
})()"""
wrong = 0


def check(name, good, seen=""):
    global wrong
    wrong += not good
    print(f"ok - {name}" if good else f"not ok - {name}: {seen}", flush=True)


def settled(page, goal):
    return page.until(f"the box at {goal}", f"seen.length > 10 && seen.slice(-10).every((x) => Math.abs(x - {goal}) < 1)")


with Server(Path(sys.argv[1]).parent) as server, chromium.Chromium() as browser:
    page = browser.page(800, 400)
    page.call("Page.addScriptToEvaluateOnNewDocument", source=PROBE)

    def opened(name):
        page.open(f"{server.url}{Path(sys.argv[1]).name}/{name}")
        page.until(f"the box of {name}", "globalThis.seen?.length")

    def three_times(name, attempt):  # on a busy machine the motion may be over before anything is asked
        for _ in range(3):
            good, seen = attempt()
            if good:
                break
        check(name, good, seen)

    def eased():
        opened("waapi.html")
        off = page.evaluate(EASING)
        return off < 0.3, f"off by {off} px"

    def passes(name):
        opened(name)
        settled(page, LAST)
        peak, gap = page.evaluate("[Math.max(...seen), gap]")
        missed = BEND * (gap / 2) ** 2 / 2  # where the peak lies between two frames
        return PEAK - 6 - missed < peak < PEAK + 6, f"{peak}, not {PEAK}; {gap} s without a frame"

    three_times("waapi.html has the spring's easing", eased)
    page.drag((450, 200), (450, 200))
    check("and the box goes where one clicks", settled(page, 400))
    for name in ("motion", "react-spring", "remotion", "three"):
        three_times(f"{name}'s page passes the peak and settles at the last key", lambda name=name: passes(f"page.html?{name}"))
    problems = [problem for problem in page.problems() if "favicon.ico" not in problem]
    check("nothing complains", not problems, problems)
sys.exit(wrong)
