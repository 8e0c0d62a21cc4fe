"""Links of Markdown pages: where they lead in the tree, and where on the site."""
import pathlib
import posixpath
import re

# A fenced block and a code span, which hold no links; the opening and the target of a link: `[page.md](target)`, `](target)`, an attribute of HTML.
PATTERN = re.compile(r"(?P<fence>^ *```.*?^ *```)|(?P<span>``.+?``|`[^`\n]+`)|(?P<open>(?:\[(?P<text>[\w./-]+\.md)\]|\])\(|\b(?:href|src)=\")(?P<target>[^)\s\"]+)", re.M | re.S)
LIST_ITEM = re.compile(r"^( *)([-*+]|\d+\.) ")


def targets(markdown):
    """Yields the targets of all links and pictures of a page."""
    for match in PATTERN.finditer(markdown):
        if match["target"]:
            yield match["target"]


def is_outer(target):
    """Returns whether a link leaves the tree: it has a scheme."""
    return re.match(r"[a-z][a-z0-9+.-]*:", target) is not None


def in_tree(target, origin):
    """Returns (path, fragment): where a link of the page origin leads, as a path of the tree; None if it leaves the tree."""
    path, _, fragment = target.partition("#")
    whole = posixpath.normpath(posixpath.join(posixpath.dirname(origin), path)) if path else origin
    return (None if whole.startswith("..") else whole), fragment


def is_published(path):
    """Returns whether a path of the tree is a file of the site as it is; all else that pages link has a page that shows it (sources.py)."""
    return path.startswith("docs/") and path.endswith((".md", ".png", ".svg", ".gif", ".mp4", ".webm", ".json", ".ipynb", ".csv", ".css", ".js"))


def on_site(path, moved):
    """Returns where a path of the tree is on the site."""
    if path in moved:
        return moved[path]
    if is_published(path):
        return path[len("docs/"):]
    return f"source/{path}.html"


def title(page):
    """Returns the first heading of a page."""
    return next((line[2:].strip() for line in page.read_text(encoding="utf-8").split("\n") if line.startswith("# ")), page.name)


def for_site(markdown, root, origin, moved):
    """Returns a page with the links of the site: origin is its path in the tree, moved the pages that stand elsewhere on the site.

    A link whose text is the name of a page is called by the title of that page.
    """
    here = posixpath.dirname(on_site(origin, moved))

    def replaced(match):
        target = match["target"]
        if not target or target.startswith("#") or is_outer(target):
            return match[0]
        path, fragment = in_tree(target, origin)
        if path is None or not (root / path).exists():
            return match[0]
        if path == "docs":
            path = "docs/README.md"
        new = posixpath.relpath(on_site(path, moved), here or ".")
        opening = f"[{title(root / path)}](" if match["text"] and path.endswith(".md") else match["open"]
        return opening + new + (f"#{fragment}" if fragment else "")

    return lists_as_on_github(PATTERN.sub(replaced, markdown))


def lists_as_on_github(markdown):
    """Returns a page whose lists Python-Markdown reads as GitHub does: an empty line before them, four spaces for each level."""
    out, fenced = [], False
    for line in markdown.split("\n"):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        item = None if fenced else LIST_ITEM.match(line)
        if item and out and out[-1].strip() and not LIST_ITEM.match(out[-1]) and not out[-1].startswith(" "):
            out.append("")
        if item and len(item[1]) % 4:
            line = " " * (2 * len(item[1])) + line.lstrip()
        out.append(line)
    return "\n".join(out)


def pages(root, moved):
    """Returns the Markdown pages of the site, as paths of the tree."""
    found = [path.relative_to(root).as_posix() for path in (root / "docs").rglob("*.md")]
    return sorted({path for path in [*found, *moved] if (root / path).exists()})


def outside(root, moved):
    """Returns the paths of the tree that pages of the site link and that are no pages of it."""
    found = set()
    for page in pages(root, moved):
        for target in targets((root / page).read_text(encoding="utf-8")):
            if target.startswith("#") or is_outer(target):
                continue
            path, _ = in_tree(target, page)
            if path and path != "docs" and path not in moved and not is_published(path) and (root / path).exists():
                found.add(path)
    return sorted(found)
