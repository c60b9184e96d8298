# SPDX-License-Identifier: GPL-2.0-or-later
"""The site as a reader sees it, in headless Chromium on a narrow and on a wide screen: pages show something, nothing
makes them scroll sideways, nothing is loaded from elsewhere, and the search finds words. Screenshots are kept in
GRAINSCOPE_SCREENSHOTS where that is set."""
import base64
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
import io
import os
from pathlib import Path
import threading

import matplotlib.image
import numpy as np
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.chrome.service import Service

from case import main, require
from run import wait_until
from site_of_pages import built, scratch

PAGES = {
    "front": "index.html",
    "start": "doc/getting_started.html",
    "questions": "doc/how_do_i.html",
    "answers": "doc/measure_contacts.html",
    "reference": "doc/compute_stress_contact.html",
    "gallery": "doc/gallery.html",
    "tutorial": "doc/tutorial_silo.html",
    "example": "examples/drum/index.html",
    "faq": "doc/faq.html",
    "glossary": "doc/glossary.html",
    "data": "doc/stability_control.html",
}
WIDTHS = (390, 1280)
# Elements that stick out of the page although nothing around them scrolls.
TOO_WIDE = """
const wide = document.documentElement.clientWidth + 1, out = [];
for (const one of document.querySelectorAll('.md-content *')) {
  let scrolls = false;
  for (let up = one; up && up !== document.body; up = up.parentElement)
    scrolls = scrolls || ['auto', 'scroll', 'hidden'].includes(getComputedStyle(up).overflowX);
  if (!scrolls && one.getBoundingClientRect().right > wide) out.push(one.outerHTML.slice(0, 80));
}
return out;
"""


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class Browser:
    """Chromium, and the site at an address of this machine."""

    def __init__(self, site):
        self.server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(site)))
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.address = f"http://127.0.0.1:{self.server.server_port}/"
        options = webdriver.ChromeOptions()
        profile = scratch() / "profile"
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"):
            options.add_argument(word)
        options.add_argument(f"--user-data-dir={profile}")
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()
        self.server.shutdown()

    def show(self, page, width):
        size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        self.driver.get(self.address + page)
        wait_until(lambda: self.ask("return document.readyState") == "complete", f"{page} to be loaded")

    def ask(self, script):
        return self.driver.execute_script(script)

    def screenshot(self, name):
        """An array of pixels; the picture is kept."""
        png = base64.b64decode(self.driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"])
        folder = Path(os.environ.get("GRAINSCOPE_SCREENSHOTS", scratch()))
        (folder / f"{name}.png").write_bytes(png)
        return matplotlib.image.imread(io.BytesIO(png))[..., :3]


def opened():
    code, words = built(scratch() / "site")
    require(code == 0, f"mkdocs ended with {code}:\n{words[-4000:]}")
    return Browser(scratch() / "site")


def pages_fit(ranks):
    with opened() as browser:
        for name, page in PAGES.items():
            for width in WIDTHS:
                browser.show(page, width)
                across, shown = browser.ask("const d = document.documentElement; return [d.scrollWidth, d.clientWidth]")
                require(shown == width, f"{page} is shown {shown} pixels wide, not {width}")
                require(across <= shown, f"{page} scrolls sideways at {width} pixels: it is {across} wide")
                out = browser.ask(TOO_WIDE)
                require(not out, f"{page} at {width} pixels, sticking out: {out[:5]}")
                pixels = browser.screenshot(f"{name}-{width}")
                inked = np.mean(np.abs(pixels - pixels[-1, -1]).max(axis=2) > 0.2)
                require(0.02 < inked, f"{page} at {width} pixels is empty: {inked:.4f} of it is not background")
                missing = browser.ask("return [...document.images].filter(i => !i.naturalWidth).map(i => i.src)")
                require(not missing, f"{page}: pictures that are not shown: {missing}")
                loaded = browser.ask("return performance.getEntriesByType('resource').map(e => e.name)")
                foreign = [url for url in loaded if not url.startswith((browser.address, "data:"))]
                require(loaded and not foreign, f"{page} loads from elsewhere: {foreign}")


def search_finds(ranks):
    with opened() as browser:

        def results():
            links = browser.driver.find_elements(By.CSS_SELECTOR, ".md-search-result__link")
            return [link.get_attribute("href") for link in links]

        def told():
            return browser.ask("return document.querySelector('.md-search-result__meta').innerText")

        for word, wanted in (("mobilisation", "contact_local"), ("Janssen", "silo"), ("rattlers", "packing")):
            browser.show("index.html?q=" + word, 1280)
            wait_until(results, f"results of a search for '{word}'")
            require(any(wanted in link for link in results()), f"'{word}' was found in {results()}, not in {wanted}")
        browser.show("index.html?q=xyzzyplugh", 1280)
        wait_until(lambda: "No matching" in told(), "the end of a search for nonsense")
        require(not results(), f"nonsense was found: {results()}")


main({"pages-fit": pages_fit, "search-finds": search_finds})
