#!/usr/bin/env python3
"""Links of the Markdown pages of the tree, as GitHub shows them, and the navigation of the site: links.py ROOT

Every link leads to a file and every fragment to a heading of it; mkdocs.yml has every page below docs/, and no other. Prints what is wrong, and ends
with 1 if anything is. First it has to find what is wrong with pages of its own.
"""
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs/site"))
import links  # noqa: E402

SITE_ONLY = {"index.md", "all_pages.md", "contributing.md", "changelog.md", "python_api.md", "cpp_api.md"}  # docs/site/hooks.py


def anchors(markdown):
    """Returns the fragments that a page has: its headings as GitHub names them, and ids of its HTML."""
    text = re.sub(r"^ *```.*?^ *```", "", markdown, flags=re.M | re.S)
    found, count = set(re.findall(r'\b(?:id|name)="([^"]+)"', text)), {}
    for heading in re.findall(r"^#+ +(.*?)\s*#*$", text, flags=re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        slug = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        count[slug] = count.get(slug, -1) + 1
        found.add(f"{slug}-{count[slug]}" if count[slug] else slug)
    return found


def wrong_links(root, pages):
    """Returns a line for every link of these pages that leads nowhere."""
    wrong = []
    for page in pages:
        markdown = (root / page).read_text(encoding="utf-8")
        for target in links.targets(markdown):
            if links.is_outer(target):
                continue
            path, fragment = links.in_tree(target, page)
            if path is None or not (root / path).exists():
                wrong.append(f"{page}: {target} is not in the tree")
            elif fragment and path.endswith(".md") and fragment not in anchors((root / path).read_text(encoding="utf-8")):
                wrong.append(f"{page}: {target}: {path} has no heading of that name")
    return wrong


def wrong_navigation(root):
    """Returns a line for every page below docs/ that the navigation of the site lacks, and for every one that it has and that is not there."""
    nav = (root / "mkdocs.yml").read_text(encoding="utf-8").split("\nnav:\n")[1]
    named = set(re.findall(r"[\w/*]+\.md", nav))
    pages = {path.relative_to(root / "docs").as_posix() for path in (root / "docs").rglob("*.md")} - {"README.md"}
    folders = tuple(name[: -len("*.md")] for name in named if name.endswith("/*.md"))
    wrong = [f"mkdocs.yml: the navigation lacks {page}" for page in sorted(pages - named) if not page.startswith(folders)]
    wrong += [f"mkdocs.yml: there is no page {name}" for name in sorted(named - pages - SITE_ONLY) if "*" not in name]
    return wrong


def check_itself():
    """Fails unless broken links are found."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs").mkdir()
        (root / "mkdocs.yml").write_text("a: b\nnav:\n  - a.md\n  - gone.md\n  - more/*.md\n")
        (root / "docs/a.md").write_text("# A `b`, c\n\n[in code](a.md) `[x](no.md)` [one](gone.md) [two](a.md#a-b-c) [three](b.md#none) ![four](no.png)\n\n```\n[x](no.md)\n```\n")
        (root / "docs/b.md").write_text("# B\n\n[up](../../x.md) [out](https://example.org/x.md) [twice](#b-1)\n\n## B\n")
        found = wrong_links(root, ["docs/a.md", "docs/b.md"]) + wrong_navigation(root)
    expected = ["docs/a.md: gone.md is not in the tree", "docs/a.md: b.md#none: docs/b.md has no heading of that name", "docs/a.md: no.png is not in the tree",
                "docs/b.md: ../../x.md is not in the tree", "mkdocs.yml: the navigation lacks b.md", "mkdocs.yml: there is no page gone.md"]
    assert found == expected, f"the check itself is broken: {found}"


def main(root):
    check_itself()
    pages = sorted([*(path.relative_to(root).as_posix() for path in (root / "docs").rglob("*.md")), *(path.name for path in root.glob("*.md"))])
    wrong = wrong_links(root, pages) + wrong_navigation(root)
    print("\n".join(wrong) if wrong else f"{len(pages)} pages: every link leads somewhere")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
