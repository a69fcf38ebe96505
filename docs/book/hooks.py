"""What ./run book adds to MkDocs: the order of the chapters, a page for each source, and the formulas' program KaTeX."""

import html
import os
import posixpath
import sys
from pathlib import Path

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, InclusionLevel
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import TextLexer, get_lexer_by_name

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

import chapters  # noqa: E402
import sources  # noqa: E402

KATEX = Path(os.environ.get("PLUMBLINE_KATEX", "/usr/share/javascript/katex"))
LEXERS = {"py": "python", "sh": "bash", "cmake": "cmake", "dae": "xml", "md": "markdown", "toml": "toml"}
WIDE = {"map.md", "one-sample.md"}  # pages whose tables or code need the width of the table of contents

listed: set[str] = set()  # the sources and folders that have a page


def on_config(config):
    """Sets the navigation."""
    if not (KATEX / "katex.min.js").is_file():
        raise PluginError(f"{KATEX}: no KaTeX there, which draws the formulas (Debian: libjs-katex; or set PLUMBLINE_KATEX)")
    config.nav = chapters.navigation(Path(config.docs_dir))
    return config


def on_files(files, config):
    """Adds the pages of sources, KaTeX, and the style and scripts of the book."""
    listed.clear()
    for page in files.documentation_pages():
        listed.update(sources.referenced(ROOT, page.src_uri, page.content_string))
    for path in sorted(listed):
        text = f"---\nsearch:\n  exclude: true\nhide: [toc]\n---\n# {path}\n"
        # Sources are reached by links only, so MkDocs must not report that the navigation lacks them.
        files.append(File.generated(config, sources.page_of(path), content=text, inclusion=InclusionLevel.NOT_IN_NAV))
    for file in [*KATEX.glob("katex.min.*"), *KATEX.glob("fonts/*")]:
        name = f"katex/{file.relative_to(KATEX).as_posix()}"
        files.append(File.generated(config, name, abs_src_path=str(file.resolve())))
    for name in ("book.css", "formulas.js", "iframe-worker.js"):
        files.append(File.generated(config, f"assets/{name}", abs_src_path=str(HERE / name)))
    return files


def on_page_markdown(markdown, page, config, files):
    """Leads links to sources to their pages."""
    if page.file.src_uri in WIDE:
        page.meta["hide"] = ["toc"]
    return sources.with_links_to_pages(ROOT, page.file.src_uri, markdown)


def on_page_content(content, page, config, files):
    """Fills the page of a source, and links paths and names in code font in all others."""
    uri = page.file.src_uri
    if not uri.startswith("source/"):
        return sources.with_links_to_names(ROOT, listed, page.file.url, content)
    path = uri.removeprefix("source/").removesuffix(".md")
    return content + (folder(path) if (ROOT / path).is_dir() else listing(path))


def folder(path: str) -> str:
    """The files of a folder, as a list of links."""
    items = ""
    for name in sources.files_in(ROOT / path):
        shown = html.escape(name)
        known = f"{path}/{name}" in listed
        items += f'<li><a href="{posixpath.basename(path)}/{shown}.html">{shown}</a></li>' if known else f"<li>{shown}</li>"
    return f"<ul>{items}</ul>"


def listing(path: str) -> str:
    """A source with an anchor #L1, #L2, ... at each line."""
    suffix = path.rpartition(".")[2]
    name = LEXERS.get(suffix, "cpp" if suffix in ("h", "cpp", "cu", "cuh") else "")
    lexer = get_lexer_by_name(name, stripnl=False) if name else TextLexer(stripnl=False)
    lines = highlight((ROOT / path).read_text(encoding="utf-8", errors="replace"), lexer, HtmlFormatter(nowrap=True))
    numbered = "".join(f'<span class="line" id="L{number}"><a href="#L{number}">{number}</a>{line}\n</span>'
                       for number, line in enumerate(lines.splitlines(), 1))
    return f'<div class="highlight listing"><pre><code>{numbered}</code></pre></div>'
