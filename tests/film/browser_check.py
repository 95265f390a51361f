#!/usr/bin/python3
"""Plays a film in headless Chromium and seeks in it: browser_check.py MOVIE WIDTH HEIGHT SECONDS

Exit status 0 if it plays, has that size and length, and every seek arrives; a line on standard error otherwise.
"""
import pathlib
import sys
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

PAGE = """<!doctype html><meta charset="utf-8"><video id="v" muted preload="auto" src="%s"></video>"""

PLAY_AND_SEEK = """
const done = arguments[arguments.length - 1], v = document.getElementById('v'), log = {seeks: []};
const until = name => new Promise((ok, no) => {
  v.addEventListener(name, ok, {once: true});
  setTimeout(() => no(name + ' never came'), 10000);
});
(async () => {
  if (v.readyState < 2) await until('loadeddata');
  Object.assign(log, {width: v.videoWidth, height: v.videoHeight, duration: v.duration});
  await v.play();
  await new Promise(r => setTimeout(r, 1000));
  v.pause();
  log.played = v.currentTime;
  for (const share of [0.9, 0.1, 0.5, 0.99]) {
    const shown = new Promise((ok, no) => {
      v.requestVideoFrameCallback((now, frame) => ok(frame.mediaTime));
      setTimeout(() => no('no frame at ' + share), 10000);
    });
    v.currentTime = share * v.duration;
    log.seeks.push(Math.abs(await shown - v.currentTime));  // of the picture itself, not of the clock
  }
  log.error = v.error ? v.error.message : null;
  done(log);
})().catch(e => done({error: String(e) + (v.error ? ': ' + v.error.message : '')}));
"""


def main() -> str:
    movie, width, height, seconds = pathlib.Path(sys.argv[1]).resolve(), *map(float, sys.argv[2:5])
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder, "film.html")
        page.write_text(PAGE % movie.as_uri())
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                         "--disable-dev-shm-usage", "--disable-background-networking", "--disable-component-update",
                         "--disable-sync", f"--user-data-dir={folder}/profile"):
            options.add_argument(argument)
        browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        try:
            browser.set_script_timeout(60)
            browser.get(page.as_uri())
            log = browser.execute_async_script(PLAY_AND_SEEK)
        finally:
            browser.quit()
    print(log)
    if log.get("error"):
        return log["error"]
    if (log["width"], log["height"]) != (width, height) or abs(log["duration"] - seconds) > 0.05:
        return f"expected {width:.0f} x {height:.0f} and {seconds} s"
    if not 0.3 < log["played"] <= seconds:
        return "it does not play"
    if max(log["seeks"]) > 0.05:
        return "a seek ended elsewhere"
    return ""


if complaint := main():
    sys.exit(f"browser_check.py: {sys.argv[1]}: {complaint}")
