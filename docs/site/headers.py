#!/usr/bin/env python3
r"""Prepares headers for Doxygen: headers.py ROOT OUTPUT

Copies every installed header (geometry, framework, energies and solvers, without framework/app) below OUTPUT, and turns
comments into those that Doxygen reads:
    // before a declaration            ->  ///
    declaration;  // behind it         ->  declaration;  ///< behind it
    // at the beginning of a file      ->  /// \file
`///` lines are read alike. A comment that no declaration follows stays as it is. Text is plain: `<T>`, `#1`, `50%` mean themselves; \param, \return, \throws
and \file are the commands of Doxygen that are kept.
"""
import pathlib
import re
import sys

LAYERS = ("geometry", "framework", "energies", "solvers")
SPECIAL = re.compile(r"([<>#$%&`]|[\\@](?!(?:param|tparam|returns?|throws?|file|brief)\b))")
NO_DECLARATION = re.compile(r"\s*($|#|\}|static_assert|namespace|using namespace|extern)")
BEHIND = re.compile(r'^(?P<code>[^/"]*(?:"[^"]*"[^/"]*)*[;,}\w])\s+//(?:/<)? (?P<text>.*)$')


def escaped(text):
    """Returns plain text for Doxygen: nothing in it is a command, a tag or a link; code spans have two backticks, as one ends at a quote."""
    parts = re.split(r"`([^`]*)`", text)
    return "".join(f"``{part}``" if i % 2 else SPECIAL.sub(r"\\\1", part).replace("file:", "file&zwnj;:") for i, part in enumerate(parts))


def comment(lines):
    """Returns comment lines as `///` lines; lines that are indented below a colon or an empty line are code."""
    indent = re.match(r"\s*", lines[0])[0]
    out, text, before = [], [], ""

    def flush():
        if text:
            out.extend(escaped("\n".join(text)).split("\n"))
            text.clear()

    for line in [re.sub(r"^\s*///?", "", line) for line in lines]:
        code = line.startswith(" " * 4) and (before is None or before.rstrip().endswith(":") or not before.strip())
        if code and before is not None:
            flush()
            out.append(" \\verbatim")
        elif not code and before is None:
            out.append(" \\endverbatim")
        (out if code else text).append(line)
        before = None if code else line
    flush()
    if before is None:
        out.append(" \\endverbatim")
    return [f"{indent}///{line}" for line in out]


def runs_of(lines):
    """Yields (is a comment, lines): runs of comment lines together, every other line by itself."""
    run = []
    for line in lines:
        if re.match(r"\s*//(?!/[/<])", line):
            run.append(line)
            continue
        if run:
            yield True, run
            run = []
        yield False, [line]
    if run:
        yield True, run


def snake_case(name):
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def in_comment(lines):
    """Returns whether a declaration behind these lines has a comment already."""
    before = [line for line in lines[-2:] if not line.startswith("template")]
    return bool(before) and before[-1].startswith("///")


def converted(text, stem):
    """Returns the text of a header with comments for Doxygen; stem is the name of its file, whose first comment also describes the class of that name."""
    out, head = [], []
    runs = list(runs_of(text.split("\n")))
    for i, (is_comment, lines) in enumerate(runs):
        if not is_comment:
            behind = BEHIND.match(lines[0])
            named = re.match(r"(?:class|struct) (\w+)(?!.*;)", lines[0])
            if named and snake_case(named[1]) == stem and not in_comment(out):
                position = len(out) - 1 if out and out[-1].startswith("template") else len(out)
                out[position:position] = head
            out.append(f"{behind['code']}  ///< {escaped(behind['text'])}" if behind else lines[0])
        elif i == 0:
            head = comment(lines)
            out += ["/// \\file", *head]
        elif i + 1 < len(runs) and NO_DECLARATION.match(runs[i + 1][1][0]):
            out += lines
        else:
            out += comment(lines)
    return "\n".join(out)


def main(root, output):
    kept = set()
    for layer in LAYERS:
        for header in sorted((root / layer).rglob("*.hpp")):
            path = header.relative_to(root)
            if path.parts[:2] == ("framework", "app"):
                continue
            target = output / path
            kept.add(target)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(converted(header.read_text(encoding="utf-8"), header.stem), encoding="utf-8")
    for old in set(output.rglob("*.hpp")) - kept:
        old.unlink()


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
