"""The page of the Python API: what `import tack` offers, by its docstrings."""
import re

HEAD = """# Python API

`import tack`, from the docstrings of the package. A tour with examples: [python.md](python.md).
"""


def page(root):
    """Returns the page: a directive of mkdocstrings for every name that the package exports."""
    text = (root / "python/tack/__init__.py").read_text(encoding="utf-8")
    names = re.findall(r'"(\w+)"', re.search(r"^__all__ = \[(.*?)\]", text, re.M | re.S)[1])
    order = ["Simulation", "run", "read", "law"]
    names = [*[name for name in order if name in names], *[name for name in names if name not in order]]
    # A module of the same name would be taken for the function.
    paths = [f"{name}.{name}" if (root / f"python/tack/{name}.py").exists() else name for name in names]
    paths += ["scene_object.Object", "results.Table", "results.Frames", "frames.Frame"]  # what these return
    return HEAD + "".join(f"\n::: tack.{path}\n" for path in paths)
