#!/usr/bin/env python3
"""Runs the cells of a notebook without Jupyter, and writes their outputs into it: `./tack python docs/site/notebook.py docs/tutorial.ipynb`.

A cell shows what it prints, the value of its last expression, and its figures, as Jupyter does. Of values it keeps the text alone: the page that a simulation
or a run shows in Jupyter has megabytes, and sites that show notebooks drop it.
"""
import ast
import base64
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile

dots_per_inch = 80  # of figures


def _figures():
    """Yields the open figures as PNG, and closes them."""
    import matplotlib.pyplot as plt

    for number in plt.get_fignums():
        content = io.BytesIO()
        plt.figure(number).savefig(content, format="png", dpi=dots_per_inch, bbox_inches="tight", metadata={"Software": None})
        yield base64.b64encode(content.getvalue()).decode("ascii")
    plt.close("all")


def _lines(text):
    return text.splitlines(keepends=True)


def run_cell(source, names, count):
    """Executes a cell in a namespace and returns its outputs, as nbformat 4 has them."""
    tree, outputs, value = ast.parse(source), [], None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"cell {count}", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), f"cell {count}", "eval"), names)
    if printed.getvalue():
        outputs.append({"output_type": "stream", "name": "stdout", "text": _lines(printed.getvalue())})
    if value is not None and not source.rstrip().endswith(";"):
        outputs.append({"output_type": "execute_result", "execution_count": count, "metadata": {}, "data": {"text/plain": _lines(repr(value))}})
    for picture in _figures():
        outputs.append({"output_type": "display_data", "metadata": {}, "data": {"image/png": picture, "text/plain": ["<figure>"]}})
    return outputs


@contextlib.contextmanager
def _copy_of_folder(folder):
    """Makes the working folder an empty one with the same neighbours, so that nothing is written beside the notebook."""
    before = pathlib.Path.cwd()
    with tempfile.TemporaryDirectory() as scratch:
        for neighbour in folder.parent.iterdir():
            if neighbour != folder:
                (pathlib.Path(scratch) / neighbour.name).symlink_to(neighbour)
        (pathlib.Path(scratch) / folder.name).mkdir()
        os.chdir(pathlib.Path(scratch) / folder.name)
        try:
            yield
        finally:
            os.chdir(before)


def run(path, names=None):
    """Runs a notebook and returns it, with new outputs; names: its namespace, to be filled."""
    import matplotlib

    matplotlib.use("Agg")
    path = pathlib.Path(path).resolve()
    notebook = json.loads(path.read_text(encoding="utf-8"))
    names = {} if names is None else names
    names["__name__"] = "__main__"
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    with _copy_of_folder(path.parent):
        for count, cell in enumerate(cells, start=1):
            cell["execution_count"], cell["outputs"] = count, run_cell("".join(cell["source"]), names, count)
    return notebook


def main():
    if len(sys.argv) != 2:
        sys.exit("notebook.py: give the path of a notebook")
    path = pathlib.Path(sys.argv[1])
    path.write_text(json.dumps(run(path), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
