"""check.py FOLDER: looks at each page of the book. Every link leads to a page that exists and to an anchor in it, no page
loads anything from a network, no formula has an error. Prints what is wrong; the exit status is 1 if anything is.

Formulas are drawn by a browser (chromium); without one they are not looked at, and a line says so."""

import re
import shutil
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlparse

LOADING = {"script": "src", "img": "src", "iframe": "src", "source": "src", "video": "src", "audio": "src", "object": "data"}
LOADING_LINKS = {"stylesheet", "icon", "preload", "prefetch", "preconnect", "modulepreload", "dns-prefetch", "manifest"}
STYLE_URL = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")


class Page(HTMLParser):
    """The anchors, links and loaded files of a page."""

    def __init__(self, text: str):
        super().__init__()
        self.anchors: set[str] = set()
        self.links: set[str] = set()  # where a reader can go
        self.loaded: set[str] = set()  # what the page needs by itself
        self.has_formulas = False
        self.in_style = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = {name: value or "" for name, value in attributes}
        self.in_style = tag == "style"
        self.anchors |= {values[name] for name in ("id", "name") if name in values and tag != "meta"}
        self.has_formulas |= "arithmatex" in values.get("class", "").split()
        self.loaded |= style_urls(values.get("style", ""))
        if tag == "a" and "href" in values:
            self.links.add(values["href"])
        if tag in LOADING and values.get(LOADING[tag]):
            self.loaded.add(values[LOADING[tag]])
        if tag == "link" and LOADING_LINKS & set(values.get("rel", "").split()):
            self.loaded.add(values["href"])

    def handle_endtag(self, tag):
        self.in_style = False

    def handle_data(self, data):
        if self.in_style:
            self.loaded |= style_urls(data)


def style_urls(text: str) -> set[str]:
    """What a style sheet loads."""
    return {first or second for first, second in STYLE_URL.findall(text)}


def is_network(url: str) -> bool:
    """Whether a browser would ask another machine for this address."""
    return bool(urlparse(url).netloc)


def faults_of(folder: Path) -> list[str]:
    """What is wrong with the pages and style sheets of a site."""
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))}
    faults = []
    for path, page in pages.items():
        where = path.relative_to(folder)
        if where.name == "404.html":  # served from any address, so its links begin with /
            continue
        faults += loading_faults(path, where, page.loaded)
        for link in sorted(page.links):
            url, anchor = urldefrag(link)
            if urlparse(url).scheme or is_network(url):
                continue
            target = (path.parent / unquote(url)).resolve() if url else path
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                faults.append(f"{where}: no file at the link {link}")
            elif anchor and target.suffix == ".html" and unquote(anchor) not in pages[target].anchors:
                faults.append(f"{where}: no anchor at the link {link}")
    for path in sorted(folder.rglob("*.css")):
        faults += loading_faults(path, path.relative_to(folder), style_urls(path.read_text(encoding="utf-8")))
    return faults


def loading_faults(path: Path, where: Path, loaded: set[str]) -> list[str]:
    """What a page or a style sheet loads and should not, or cannot."""
    faults = []
    for url in sorted(loaded):
        if url.startswith("data:") or url.startswith("#"):
            continue
        if is_network(url):
            faults.append(f"{where}: loads {url} from a network")
        elif not (path.parent / unquote(urldefrag(url)[0].partition("?")[0])).is_file():
            faults.append(f"{where}: loads {url}, which does not exist")
    return faults


def formula_faults(page: Path, browser: str) -> list[str]:
    """The formulas of a page that a browser cannot draw."""
    with tempfile.TemporaryDirectory() as profile:
        drawn = subprocess.run(
            ["timeout", "120", browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             f"--user-data-dir={profile}", "--virtual-time-budget=10000", "--dump-dom", page.resolve().as_uri()],
            capture_output=True, encoding="utf-8", check=False).stdout
    faults = [f"{page.name}: {error}" for error in re.findall(r'class="katex-error"[^>]*title="([^"]*)"', drawn)]
    formulas = len(re.findall(r'<(?:span|div) class="arithmatex"', drawn))
    drawings = len(re.findall(r'class="(?:katex|katex-error)"', drawn))
    if formulas == 0 or drawings != formulas:
        faults.append(f"{page.name}: {drawings} of {formulas} formulas are drawn")
    return faults


def main() -> int:
    folder = Path(sys.argv[1]).resolve()
    faults = faults_of(folder)
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        print("no chromium: formulas are not looked at", file=sys.stderr)
    else:
        for path in sorted(folder.rglob("*.html")):
            if Page(path.read_text(encoding="utf-8")).has_formulas:
                faults += formula_faults(path, browser)
    print("\n".join(faults) if faults else "every link and every formula is right, and nothing comes from a network")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
