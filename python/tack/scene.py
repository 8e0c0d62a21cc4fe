"""Converts scenes and overrides to the program's format, YAML (JSON is a subset)."""
import json
import os


def _plain(value):
    """Converts NumPy's numbers and arrays, paths and mappings for JSON."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "items"):
        return dict(value)
    raise TypeError(f"a scene cannot hold {type(value).__name__}: {value!r}")


def text_of(scene):
    return json.dumps(scene, indent=1, default=_plain, allow_nan=False, ensure_ascii=False)


def overrides_of(values):
    """Converts {"time.step": "2 ms"} to ["time.step=2 ms"]."""
    def one(value):
        return value if isinstance(value, str) else json.dumps(value, default=_plain, allow_nan=False, ensure_ascii=False)
    return [f"{key}={one(value)}" for key, value in (values or {}).items()]


def opened(scene):
    """Returns (path, "") for a file and ("scene", text) for a dictionary."""
    if isinstance(scene, (str, os.PathLike)):
        return os.fspath(scene), ""
    return "scene", text_of(scene)
