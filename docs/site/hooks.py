"""Hooks of mkdocs (mkdocs.yml): pages that are made from other files, links that leave docs/, and the C++ API beside the pages."""
import os
import pathlib
import re
import shutil
import sys

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import cpp_api  # noqa: E402
import links  # noqa: E402
import python_api  # noqa: E402
import sources  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
KATEX = pathlib.Path("/usr/share/javascript/katex")
# Pages of the site that stand elsewhere in the tree.
MOVED = {"README.md": "index.md", "docs/README.md": "all_pages.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
FRONT = {"index.md": "---\nhide: [navigation]\n---\n\n"}


def output():
    """Returns the folder that docs/site/build.sh works in."""
    return pathlib.Path(os.environ.get("TACK_DOCS", ROOT / "build/docs"))


def on_files(files, config):
    """Adds generated pages, the sources that pages link and KaTeX; takes the tools of the site out; expands FOLDER/*.md of the navigation."""
    stage = output() / "pages"
    shutil.rmtree(stage, ignore_errors=True)

    def add(path, text):
        (stage / path).parent.mkdir(parents=True, exist_ok=True)
        (stage / path).write_text(text, encoding="utf-8")
        files.append(File(path, str(stage), config["site_dir"], config["use_directory_urls"]))

    for file in list(files):
        path = file.src_uri
        if not links.is_published(f"docs/{path}") or path in ("README.md", "site/cpp.css"):
            files.remove(file)
    for origin, page in MOVED.items():
        if (ROOT / origin).exists():
            add(page, FRONT.get(page, "") + (ROOT / origin).read_text(encoding="utf-8"))
    add("python_api.md", python_api.page(ROOT))
    add("cpp_api.md", cpp_api.page(output() / "xml"))
    for path, text in sources.pages(ROOT, links.outside(ROOT, MOVED)).items():
        add(path, text)
    for path in [*sorted(KATEX.glob("fonts/*")), KATEX / "katex.min.css", KATEX / "katex.min.js", KATEX / "contrib/auto-render.js"]:
        target = "site/katex/" + ("fonts/" if path.parent.name == "fonts" else "") + path.name
        (stage / target).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, stage / target)
        files.append(File(target, str(stage), config["site_dir"], config["use_directory_urls"]))
    for path in sorted((output() / "cpp").rglob("*")):
        if path.is_file():
            files.append(File(path.relative_to(output()).as_posix(), str(output()), config["site_dir"], config["use_directory_urls"]))
    config["nav"] = expanded(config["nav"], sorted(file.src_uri for file in files.documentation_pages()), named_pages(config["nav"]))
    return files


def named_pages(nav):
    """Returns the pages that a navigation names one by one."""
    if isinstance(nav, str):
        return [] if "*" in nav else [nav]
    if isinstance(nav, dict):
        nav = list(nav.values())
    return [page for entry in nav for page in named_pages(entry)]


def expanded(nav, pages, named):
    """Returns the navigation with FOLDER/*.md replaced by the pages of the folder that are not named, README.md first; sections without pages are left out."""
    out = []
    for entry in nav:
        if isinstance(entry, dict):
            title, inside = next(iter(entry.items()))
            inside = inside if isinstance(inside, str) else expanded(inside, pages, named)
            if inside:
                out.append({title: inside})
        elif entry.endswith("/*.md"):
            folder = entry[: -len("*.md")]
            found = [page for page in pages if page.startswith(folder) and page not in named]
            out += sorted(found, key=lambda page: (not page.endswith(("README.md", "index.md")), page))
        else:
            out.append(entry)
    return out


def on_page_markdown(markdown, page, **_):
    """Returns the page with links of the site instead of those of the tree, and with lists as GitHub reads them."""
    origin = next((path for path, moved in MOVED.items() if moved == page.file.src_uri), "docs/" + page.file.src_uri)
    return links.for_site(markdown, ROOT, origin, MOVED)



def on_page_content(html, **_):
    """Returns the page with keys in tables that may be broken behind their dots."""
    return re.sub(r"(<td><code>)([^<]+)(?=</code>)", lambda match: match[1] + match[2].replace(".", ".<wbr>"), html)
