#!/usr/bin/env python3
"""Links of the built site: site_links.py SITE

Every address in HTML pages and style sheets leads to a file of the site, every fragment to an id of it, and nothing is loaded from elsewhere. Fragments
of links between pages of Doxygen are left out: some of its own lead to members that it does not show. Prints what is wrong, and ends with 1 if
anything is.
"""
import html
import pathlib
import posixpath
import re
import sys
import urllib.parse

ADDRESS = re.compile(r"<(\w+)\b[^>]*?\s(href|src)=(?:\"([^\"]*)\"|'([^']*)')")
ID = re.compile(r"\b(?:id|name)=(?:\"([^\"]*)\"|'([^']*)')")
STYLE = re.compile(r"url\(['\"]?([^'\")]+)")


def main(site):
    files = {path.relative_to(site).as_posix() for path in site.rglob("*") if path.is_file()}
    texts = {name: (site / name).read_text(encoding="utf-8") for name in files if name.endswith((".html", ".css"))}
    ids = {name: {html.unescape(a or b) for a, b in ID.findall(text)} for name, text in texts.items() if name.endswith(".html")}
    wrong, count = [], 0
    for name, text in sorted(texts.items()):
        found = [("style", "src", address) for address in STYLE.findall(text)] if name.endswith(".css") else [
            (tag, attribute, html.unescape(a or b)) for tag, attribute, a, b in ADDRESS.findall(text)]
        for tag, attribute, address in set(found):
            if re.match(r"(data|mailto|javascript):", address) or (name == "404.html" and address.startswith("/")):
                continue
            count += 1
            if re.match(r"([a-z]+:)?//", address):
                if tag != "a":
                    wrong.append(f"{name}: loads {address}")
                continue
            path, _, fragment = address.partition("#")
            path = urllib.parse.unquote(path.partition("?")[0])
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name
            if target == "." or target + "/index.html" in files:
                target = posixpath.join(target, "index.html").removeprefix("./")
            if target not in files:
                wrong.append(f"{name}: {address} is not on the site")
            elif fragment and target in ids and not (name.startswith("cpp/") and target.startswith("cpp/")) and urllib.parse.unquote(fragment) not in ids[target]:
                wrong.append(f"{name}: {address}: no such place on that page")
    print("\n".join(wrong[:50]) if wrong else f"{len(texts)} pages and style sheets, {count} links: all lead somewhere")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
