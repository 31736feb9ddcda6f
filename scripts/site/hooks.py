"""What the site has beyond docs/: the reference of the library, an index of decisions, and files of the repository that
pages link to, which are copied. Markdown is read as the repository's hosts read it. mkdocs.yml names this file."""

import os
import re
import shutil
import sys

from mkdocs.structure.files import File

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import api_reference  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LINK = re.compile(r"(\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
FENCE = re.compile(r"^\s*```")


def slug(heading: str, separator: str) -> str:
    """Anchors of headings, as GitHub and GitLab make them."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", separator)


def on_config(config):
    config["mdx_configs"].setdefault("toc", {})["slugify"] = slug
    return config


def outside_code(markdown: str):
    """Lines, and whether each is text; what is fenced or indented is code."""
    is_fenced = False
    for line in markdown.split("\n"):
        is_fence = bool(FENCE.match(line))
        yield line, not (is_fenced or is_fence or line.startswith("    "))
        is_fenced ^= is_fence


def page_on_site(path: str) -> str:
    """Where a file of the repository is on the site, as mkdocs names its source."""
    if path.startswith("docs/"):
        return path[len("docs/"):]
    return "repository/" + (path if path.endswith((".md", ".png")) else path + ".txt")


def path_in_repository(page: str) -> str:
    """The other way round."""
    return page[len("repository/"):] if page.startswith("repository/") else "docs/" + page


def linked_file(path: str, link: str) -> str | None:
    """The file of the repository that a link of the page `path` leads to; of a folder its README. None: no file."""
    if "://" in link or link.startswith(("mailto:", "/")):
        return None
    target = os.path.normpath(os.path.join(os.path.dirname(path), link))
    if os.path.isdir(os.path.join(ROOT, target)):
        target = os.path.join(target, "README.md")
    return target if os.path.isfile(os.path.join(ROOT, target)) else None


def text_of(path: str) -> str:
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def links_in(path: str) -> set[str]:
    links = set()
    for line, is_text in outside_code(text_of(path)):
        if is_text:
            links |= {target for match in LINK.finditer(line) if (target := linked_file(path, match.group(2)))}
    return links


def index_of_decisions(files) -> str:
    pages = sorted(f.src_path for f in files if re.match(r"decisions/\d", f.src_path))
    lines = ["# Decisions", "", "What was decided, why, and what it costs.", ""]
    for page in pages:
        title = text_of("docs/" + page).split("\n", 1)[0].lstrip("# ")
        title = re.sub(r"^0*(\d+)[.:] *", r"", title)
        lines.append(f"{int(os.path.basename(page)[:4])}. [{title}]({os.path.basename(page)})")
    return "\n".join(lines) + "\n"


def on_files(files, config):
    made = os.path.join(os.path.dirname(config["site_dir"]), "site-pages")
    shutil.rmtree(made, ignore_errors=True)

    def add(page: str, text: str) -> None:
        path = os.path.join(made, page)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        files.append(File(page, made, config["site_dir"], config["use_directory_urls"]))

    waiting = ["docs/" + f.src_path for f in files if f.src_path.endswith(".md")]
    add("api.md", api_reference.page(text_of("burin/burin.h"), text_of("burin/error.hpp") + text_of("burin/burin.hpp")))
    add("decisions/index.md", index_of_decisions(files))
    copied = set()
    while waiting:
        for target in sorted(links_in(waiting.pop()) - copied):
            if target.startswith("docs/"):
                continue
            copied.add(target)
            if target.endswith(".md"):
                waiting.append(target)
            add(page_on_site(target), text_of(target))
    return files


def on_page_markdown(markdown, page, config, files):
    """Lists and tables may follow a line of text at once; links lead to pages of the site."""
    here = page.file.src_path
    path = path_in_repository(here)

    def moved(match: re.Match) -> str:
        target = linked_file(path, match.group(2))
        if target is None:
            return match.group(0)
        on_site = os.path.relpath(page_on_site(target), os.path.dirname(here) or ".")
        return match.group(1) + on_site + match.group(3)

    lines: list[str] = []
    for line, is_text in outside_code(markdown):
        if not is_text:
            lines.append(line)
            continue
        before = lines[-1] if lines else ""
        for begins in (r"(- |\* |\d+\. )", r"\|"):
            if re.match(begins, line) and before and not re.match(begins, before) and not before.startswith(" "):
                lines.append("")
        lines.append(LINK.sub(moved, line))
    return "\n".join(lines)
