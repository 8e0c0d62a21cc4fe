"""Files of the tree that pages link, as pages of their own: a scene, a header, a folder."""
import html
import posixpath

import pygments
import pygments.formatters
import pygments.lexers

PAGE = """<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>{title}</title>
<link rel="stylesheet" href="{root}site/source.css"></head>
<body><header><a href="{root}index.html">tack</a> / {path}</header>
<main>{content}</main></body>
</html>
"""


def pages(root, paths):
    """Returns {path on the site: HTML} of files and folders; of a folder also of the files in it."""
    every = set(paths)
    for path in paths:
        if (root / path).is_dir():
            every |= {f"{path}/{file.name}" for file in (root / path).iterdir() if file.is_file()}
    return {f"source/{path}.html": page(root, path, every) for path in sorted(every)}


def page(root, path, every):
    up = "../" * (path.count("/") + 1)
    crumbs = [html.escape(part) for part in path.split("/")]
    for i in range(1, len(crumbs)):
        folder = "/".join(path.split("/")[:i])
        if folder in every:
            crumbs[i - 1] = f'<a href="{up}source/{html.escape(folder)}.html">{crumbs[i - 1]}</a>'
    content = folder_list(root, path, every) if (root / path).is_dir() else code(root / path)
    return PAGE.format(title=html.escape(path), root=up, path=" / ".join(crumbs), content=content)


def folder_list(root, path, every):
    """Returns the list of what is in a folder, linked where the site has it."""
    items = []
    for entry in sorted((root / path).iterdir()):
        if entry.name.startswith(".") or entry.name == "results":
            continue
        name = html.escape(entry.name) + ("/" if entry.is_dir() else "")
        known = f"{path}/{entry.name}" in every
        items.append(f'<li><a href="{posixpath.basename(path)}/{html.escape(entry.name)}.html">{name}</a></li>' if known else f"<li>{name}</li>")
    return f'<ul>{"".join(items)}</ul>'


def code(file):
    """Returns a file as highlighted text."""
    try:
        text = file.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return "<p>no text</p>"
    if file.suffix == ".hpp":
        lexer = pygments.lexers.CppLexer()
    else:
        try:
            lexer = pygments.lexers.get_lexer_for_filename(file.name)
        except pygments.util.ClassNotFound:
            lexer = pygments.lexers.TextLexer()
    return pygments.highlight(text, lexer, pygments.formatters.HtmlFormatter(nowrap=False))
