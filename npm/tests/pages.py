"""Opens the examples' page in Chromium and compares how far each box goes with the spring: pages.py FOLDER, with the package beside it"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "web"))
import chromium
from serve import Server

PEAK, LAST = 293, 60  # of the spring of every page, px
# The page's clock goes frame by frame, and animations with it. play() tells where the box was last, where it was farthest, and how far an
# animation was from the spring.
CLOCK = """{
  let now = 1, number = 0, frames = new Map()
  performance.now = Date.now = () => now
  requestAnimationFrame = (run) => (frames.set(++number, run), number)
  cancelAnimationFrame = (one) => frames.delete(one)
  if (location.search === '?motion') delete Element.prototype.animate // its own frames, not the browser's clock
  window.play = async (seconds) => {
    const { spring } = await import('/wiggly/index.js'), s = spring({ keys: [[0, 0], [0.4, 200], [1.2, 60]], frequency: 2, damping: 0.2 })
    let last = 0, most = 0, off = 0
    while (!document.querySelector('#box, output')) await new Promise((done) => setTimeout(done)) // React takes its time
    for (const end = now + 1000 * seconds; now < end; now += 1000 / 60) {
      const runs = [...frames.values()], animations = document.getAnimations()
      frames.clear()
      for (const run of runs) run(now)
      await new Promise((done) => setTimeout(done))
      const output = document.querySelector('output'), box = document.querySelector('#box'), style = box && getComputedStyle(box)
      if (output?.value) last = +output.value
      else if (box) last = new DOMMatrix(style.transform).e + (parseFloat(style.translate) || 0)
      most = Math.max(most, last)
      for (const animation of animations) {
        animation.pause()
        off = Math.max(off, Math.abs(last - s.at(animation.currentTime / 1000)))
        const next = animation.currentTime + 1000 / 60
        if (next < animation.effect.getComputedTiming().endTime) animation.currentTime = next
        else animation.finish()
      }
    }
    return [last, most, off]
  }
}"""
results = []


def check(name, good, seen=""):
    results.append(good)
    print(f"ok - {name}" if good else f"not ok - {name}: {seen}", flush=True)


with Server(Path(sys.argv[1]).parent) as server, chromium.Chromium() as browser:
    page = browser.page(800, 400)
    page.call("Page.addScriptToEvaluateOnNewDocument", source=CLOCK)
    for name in ("motion", "react-spring", "remotion", "three", "waapi"):
        page.open(f"{server.url}{Path(sys.argv[1]).name}/index.html?{name}")
        last, most, off = seen = page.evaluate("play(7)", 120)
        check(f"{name}'s box passes the peak and settles at the last key", abs(most - PEAK) < 1 and abs(last - LAST) < 0.5, seen)
    check("waapi's has the spring's easing", off < 0.3, seen)
    page.drag((450, 200), (450, 200))
    check("and goes where one clicks", abs((seen := page.evaluate("play(5)", 120))[0] - 400) < 0.5, seen)
    problems = [problem for problem in page.problems() if "favicon.ico" not in problem]
    check("nothing complains", not problems, problems)
sys.exit(not all(results))
